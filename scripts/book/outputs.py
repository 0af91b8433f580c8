"""python3 scripts/book/outputs.py BUILD PAGE...: puts below each command of a page's ```sh blocks, and below the code of each example,
what the program of BUILD prints, as a ```text block. tests/pages compares them with the programs' output.

A block has one command. Long outputs are shown by their start and their last line, long lines by their start; of a run that is not
verified the end is left out, because it differs between machines."""
import pathlib
import re
import subprocess
import sys
import tempfile

COMMANDS = re.compile(r"^```sh\n(.*?)^```\n(?:\n```text\n.*?^```\n)?", re.MULTILINE | re.DOTALL)
EXAMPLE = re.compile(r"^(\\snippet (?:chapters/(\w+)/example|examples/(\w+))\.cpp example)\n(?:\n```text\n.*?^```\n)?",
                     re.MULTILINE | re.DOTALL)
MOST_LINES, FIRST, WIDTH = 7, 4, 110


def printed(command, folder):
    done = subprocess.run(["sh", "-c", command], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{command}: {done.stderr}")
    return done.stdout


def shortened(line):
    cut = line[:WIDTH].rpartition(" ")[0]
    return line if len(line) <= WIDTH or not cut else f"{cut} ..."


def block(output, verified=True):
    """The output as a block of a page; nothing for none."""
    lines = output.rstrip("\n").split("\n")
    if len(lines) > MOST_LINES:
        lines = lines[:FIRST] + ["..."] + (lines[-1:] if verified else [])
    return "\n```text\n" + "".join(f"{shortened(line)}\n" for line in lines) + "```\n" if output else ""


def with_output(text, build, folder):
    def commands(found):
        blocks = []
        for command in re.findall(r"(?:[^\n]*\\\n)*[^\n]+", found[1]):
            if "build/bin/" not in command:
                return found[0]
            blocks.append(f"```sh\n{command}\n```\n" + block(printed(command, folder), "--no-verify" not in command))
        return "\n".join(blocks)

    def example(found):
        program = f"{found[2]}_example" if found[2] else found[3]
        return f"{found[1]}\n" + block(printed(str(build / "bin" / program), folder))

    return EXAMPLE.sub(example, COMMANDS.sub(commands, text))


def main(build, *pages):
    build = pathlib.Path(build).absolute()
    for page in map(pathlib.Path, pages):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "build").symlink_to(build)
            (pathlib.Path(folder) / "chapters").symlink_to(page.absolute().parent.parent)
            text = page.read_text(encoding="utf-8")
            page.write_text(with_output(text, build, folder), encoding="utf-8")


if len(sys.argv) < 3:
    sys.exit(__doc__)
main(*sys.argv[1:])
