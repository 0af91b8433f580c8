"""The fenced blocks of pages, and outputs as pages print them beside what programs write today."""
import dataclasses
import math
import re

NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@dataclasses.dataclass
class Block:
    language: str  # after the opening fence: "sh"
    line: int  # number of the opening fence, from 1
    lines: list  # between the fences

    @property
    def end(self):
        """The number of the closing fence."""
        return self.line + len(self.lines) + 1


def blocks_of(page):
    """The blocks of a page's text, in its order."""
    blocks, inside = [], False
    for at, line in enumerate(page.splitlines(), 1):
        if line.startswith("```"):
            if not inside:
                blocks.append(Block(line[3:], at, []))
            inside = not inside
        elif inside:
            blocks[-1].lines.append(line)
    return blocks


def without_numbers(text):
    """The text with # in place of each number, and the numbers as they are written. A sign counts to the number."""
    return NUMBER.sub("#", text), NUMBER.findall(text)


def same_number(written, printed):
    """Are two numbers of outputs equal up to differences between machines? Noise: zero up to rounding. Numbers that are printed with ten
    digits and more are results and agree to 1e-5, because the problems of the pages multiply rounding by 1e9 at most. Others are errors,
    counts and digits, which agree within a factor of two."""
    a, b = float(written), float(printed)
    if max(abs(a), abs(b)) < 1e-7:
        return True
    if sum(c.isdigit() for c in printed.partition("e")[0]) >= 10:
        return math.isclose(a, b, rel_tol=1e-5)
    return a * b > 0 and 0.5 <= a / b <= 2


def same_line(written, printed):
    """Are two lines equal up to differences between machines? A line that ends with " ..." on the page is continued in the output."""
    goes_on = printed.endswith(" ...")
    words, numbers = without_numbers(printed.removesuffix(" ..."))
    words_now, numbers_now = without_numbers(written)
    return ((words_now.startswith(words) if goes_on else words_now == words) and len(numbers_now) >= len(numbers)
            and all(map(same_number, numbers_now, numbers)))


def without_field(line, column):
    """A line of CSV without one of its fields, counted from 0; none before it is quoted."""
    fields = line.split(",")
    return ",".join(fields[:column] + fields[column + 1:])


def differs_from(output, printed):
    """The first line of a printed output that is not in what a program writes, in its order; empty if all are. A line "..." stands for lines
    that are left out; what follows it as the last line is the last of both. Seconds, a column of that name, are not compared."""
    written = output.splitlines()
    heading = written[0].split(",") if written else []
    if "seconds" in heading:
        written, printed = ([without_field(line, heading.index("seconds")) for line in lines] for lines in (written, printed))
    next_line, left_out = 0, False
    for at, line in enumerate(printed):
        if line == "...":
            left_out = True
            continue
        if left_out and at == len(printed) - 1:
            next_line = max(next_line, len(written) - 1)
        while left_out and next_line < len(written) and not same_line(written[next_line], line):
            next_line += 1
        if next_line == len(written) or not same_line(written[next_line], line):
            return line
        next_line, left_out = next_line + 1, False
    return "" if left_out or next_line == len(written) else f"the output has further lines: {written[next_line]}"
