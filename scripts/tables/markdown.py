"""Tables of GitHub's Markdown, and numbers as they stand in them. The chapters' own tables are written by common/nlmech/scene/table.cpp
in the same form."""
import re


def number(value, digits=3):
    """With so many significant digits, without needless zeros: 1.508e-3."""
    return re.sub(r"e([+-])0*(\d+)", lambda e: f"e{e[1].strip('+')}{e[2]}", f"{value:.{digits}g}")


def nominal(value):
    """What the text as it stands gives for a printed number: four digits, the range that the list states in their place, or why it cannot
    be run."""
    if value.nominal is None:
        return value.found if value.found.startswith("cannot be run") else ""
    return number(value.nominal, 4) if value.fails else value.range_by_rounding() or number(value.nominal, 4)


def escaped(text):
    r"""A pipe is part of the text behind an odd number of backslashes; those that stood before it are doubled."""
    return re.sub(r"(\\*)\|", r"\1\1\\|", text).replace("\n", " ").replace("\r", " ")


def table(columns, rows, digits=None):
    """Rows of texts, whole and real numbers, or None for nothing. A column without a text is one of numbers, aligned on the right.
    @param digits significant digits of real numbers, by column, where they are not 3"""
    def cell(value, column):
        if isinstance(value, float):
            return number(value, (digits or {}).get(column, 3))
        return escaped(value) if isinstance(value, str) else "" if value is None else str(value)

    aligned = [":---" if any(isinstance(row[i], str) for row in rows) else "---:" for i in range(len(columns))]
    lines = [columns, aligned, *([cell(value, column) for value, column in zip(row, columns)] for row in rows)]
    return "".join("|" + "".join(f" {text} |" for text in line) + "\n" for line in lines)
