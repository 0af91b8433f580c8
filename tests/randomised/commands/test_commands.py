"""Whatever is typed after a program's name: it ends, within its limit, with 0 and finite numbers, or with 1 or 2, nothing on standard output
and a few printable words. Texts hold one character for each byte."""
import re
import subprocess
import tempfile
import unicodedata

import pytest
from cases import randomised_test, judged, refused, wrong

from nlmech_tree import chapters, program, text_of

NUMBERS = ["0", "-0", "1e308", "1e309", "-1e-324", "4.9e-324", "nan", "inf", "-inf", "0x1p3", "1e", "+", "+-1", "1_000", "1e-400", "00012", ".5",
           "5.", "1,5", "true", "1979-05-27", "1e+05", "--1", "1d5", "1e99999", "2147483648", "-2147483649", "9223372036854775808", '"1"',
           "0b101", "0o17", "1e5.5", "1/0", "[1]", "{}", "''", "99999999999999999999999999"]
PIECES = ['"', "'''", '"""', "[", "]]", "[[", "{", "=", "\\u0000", "\\UFFFFFFFF", "#", ",", "\n", "\r\n", "\r", "\t", "\xef\xbb\xbf", "\xff",
          "\xc0\xaf", "\x1b[2J", "=,=", ":", "-", "--", "/", "\xe2\x80\xae", ".", " ", "a.b.c.d = 1\n", "[a.b]\n", "@"]
LONGEST_WORD = 120_000  # bytes; the system hands on no more


def printed_commands():
    """What the pages of the chapters print, without "build/bin/": commands on a user's own numbers, with nothing for a shell to do, of programs
    that are built."""
    found = []
    for chapter in chapters():
        for line in text_of(f"chapters/{chapter}/{chapter}.md").splitlines():
            command = line.removeprefix("build/bin/")
            words = command.split(" ")
            if (command != line and len(words) > 1 and words[1] not in ("list", "run", "check") and not re.search(r"[><|*\\$#]", command) and
                    program(words[0]).exists()):
                found.append(command.encode().decode("latin-1"))
    return sorted(found)  # the same cases on every machine


COMMANDS = printed_commands()


def length(draw):
    """Mostly short, sometimes very long."""
    return int(draw.log_uniform(1, 1e5 if draw.chance(0.02) else 300))


def with_another_number(draw, text, at):
    """A run of the characters of which numbers consist, replaced."""
    match = re.compile(r"[0-9.e+-]+").search(text, at)
    begin, end = match.span() if match else (len(text), len(text))
    return text[:begin] + draw.one_of(NUMBERS) + text[end:]


def damage(draw, text):
    """Bits turned over, parts lost, doubled, moved in from other commands; other numbers; long words, deep brackets, NUL, byte order marks, line
    ends of other systems, bytes that are no UTF-8."""
    at = draw.whole(0, len(text))
    count = min(length(draw), len(text) - at)
    kind = draw.whole(0, 11)
    if kind == 0:
        return text[:at] + "".join(chr(ord(c) ^ (1 << draw.whole(0, 7))) for c in text[at:at + 1]) + text[at + 1:]
    if kind == 1:
        return text[:at] + text[at + count:]
    if kind == 2:
        return text[:at] + text[at:at + count] + text[at:]
    if kind == 3:
        other = draw.one_of(COMMANDS)
        begin = draw.whole(0, len(other))
        return text[:at] + other[begin:begin + length(draw)] + text[at:]
    if kind == 4:
        return text[:at]
    if kind in (5, 6):
        return with_another_number(draw, text, at)
    if kind == 7:
        return text[:at] + draw.one_of("1a.-,\" 0e") * length(draw) + text[at:]
    if kind == 8:
        return text[:at] + "\0" + text[at:]
    if kind == 9:
        return text[:at] + draw.one_of(PIECES) + text[at:]
    if kind == 10:
        return text.replace("\n", "\r\n") if draw.chance(0.5) else "\xef\xbb\xbf" + text
    return text[:at] + draw.one_of(["[", "{a=", "a.", '"', "(", "[[", "-", "'"]) * length(draw) + text[at:]


def damaged(draw, text):
    """After one to six damages; one text in fifty is left whole."""
    if not draw.chance(0.02):
        for _ in range(draw.whole(1, 6)):
            text = damage(draw, text)
    return text


def changed(draw):
    """A printed command with other numbers, far or near; or with any damage."""
    command = draw.one_of(COMMANDS)
    name, *words = command.split(" ")
    if len(words) == 1 or draw.chance(0.3):
        return name + " " + damaged(draw, command.removeprefix(name + " "))
    for _ in range(draw.whole(1, 3)):
        at = draw.whole(1, len(words) - 1)
        parts = words[at].split(",")
        which = draw.whole(0, len(parts) - 1)
        if not re.search("[0-9]", parts[which]):
            continue
        x = draw.any_finite() if draw.chance(0.3) else draw.log_uniform(1e-12, 1e12) if draw.chance(0.5) else draw.whole(-3, 40)
        before, sign, _ = parts[which].rpartition("=")
        parts[which] = before + sign + repr(x)
        words[at] = ",".join(parts)
    return " ".join([name, *words])


def shown(data):
    return f"{len(data)} bytes: {ascii(data[:300])}"


def is_printable(errors):
    """Few lines, none endless, UTF-8, and nothing that a terminal obeys or that changes what other characters look like."""
    try:
        lines = errors.decode().split("\n")
    except UnicodeDecodeError:
        return False
    return len(errors) < 20_000 and all(len(line.encode()) <= 4100 and not any(unicodedata.category(c) in ("Cc", "Cf", "Zl", "Zp") for c in line)
                                        for line in lines)


def has_nan(output, is_of_a_conic):
    """Is there a cell that is no finite number and no word? The period of a hyperbola and the axis of a parabola are infinite."""
    cells = set(re.split(b"[,\n]", output))
    return bool(cells & {b"nan", b"-nan"}) or (not is_of_a_conic and bool(cells & {b"inf", b"-inf"}))


def run(command, folder):
    """Runs it where it may write what it likes; None if it does not end in 20 s."""
    name, *words = [word.partition("\0")[0].encode("latin-1")[:LONGEST_WORD] for word in command.split(" ")]
    words[1:1] = [b"--limit", b"1"]
    try:
        return subprocess.run([bytes(program(name.decode())), *words], stdin=subprocess.DEVNULL, capture_output=True, cwd=folder, timeout=20,
                              check=False)
    except subprocess.TimeoutExpired:
        return None


def says_which_failed(output):
    """Is it a table whose last column is the status of each row, of which some are failures?"""
    header, *rows = output.decode(errors="replace").splitlines()
    return header.endswith(",status") and any(not row.endswith(",success") for row in rows)


def verdict_on(command, done):
    if done is None:
        return wrong("went on beyond its limit: " + shown(command))
    what = f"{shown(command)}: exit code {done.returncode}, printed {shown(done.stdout)}, said {shown(done.stderr)}"
    if not is_printable(done.stderr):
        return wrong("no message for a terminal: " + what)
    if done.returncode == 0:
        if not done.stdout:
            return wrong("nothing: " + what)
        return wrong("no finite numbers: " + what) if has_nan(done.stdout, command.startswith("two_body_series elements")) else judged(0, 1, what)
    if done.returncode not in (1, 2):
        return wrong("crashed: " + what)
    if done.stdout and not says_which_failed(done.stdout):
        return wrong("a result with a failure: " + what)
    return refused(what) if done.stderr else wrong("silent: " + what)


@pytest.mark.skipif(not COMMANDS, reason="no program is built")
@randomised_test(quick=20, full=10_000, least_right=0.02)
def test_end_in_time_with_numbers_or_a_sentence(draw):
    command = changed(draw)
    with tempfile.TemporaryDirectory(prefix="nlmech-test-") as folder:
        return verdict_on(command, run(command, folder))
