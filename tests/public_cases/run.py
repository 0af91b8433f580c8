#!/usr/bin/env python3
"""Cases that others published, or that were found by trying: each runs a command and compares what it prints.

    run.py FOLDER_OF_PROGRAMS FILE.toml [ID ...]

A file holds [[case]] tables:

    id        name, unique in the file
    source    who published the case, or how the reference value was computed
    run       the command; its first word is a program of the folder, which runs in a folder of its own
    input     standard input (optional)
    files     table: name = text, written into the working folder (optional)
    files_of  id of an earlier case with the same files, in place of `files` (optional)
    exit      expected exit code (default 0)
    says      list of words that standard error holds (optional); silent = true: it is empty
    where     table: column = text; only rows of the output with this text count (optional)
    rows      number of rows that are left (optional)
    expect    table: column = list of values, a row each, compared from the first row on; from the last if last = true
    within    bound on |value - expected| / max(|expected|, scale), with its reason in `because`
    scale     see `within` (default 0: relative to each value)

Ends with 1 if a case fails and names it with both numbers.
"""
import csv
import io
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import tomllib

KEYS = {"id", "source", "run", "input", "files", "files_of", "exit", "says", "silent", "where", "rows", "expect",
        "last", "within", "because", "scale"}


def check_table(case):
    """What is wrong with the table itself."""
    unknown = set(case) - KEYS
    if unknown:
        yield f"unknown keys {sorted(unknown)}"
    for key in ("id", "source", "run"):
        if not case.get(key):
            yield f"no {key}"
    if "expect" in case and not ("within" in case and case.get("because")):
        yield "a comparison needs `within` and its reason, `because`"
    if not any(key in case for key in ("expect", "says", "rows", "silent")):
        yield "nothing is compared"


def compare(case, rows):
    """Differences between the rows of the output and the expected values."""
    if "rows" in case and len(rows) != case["rows"]:
        yield f"{len(rows)} rows, expected {case['rows']}"
    for column, expected in case.get("expect", {}).items():
        if len(rows) < len(expected):
            yield f"{column}: {len(rows)} rows, expected at least {len(expected)}"
            continue
        chosen = rows[-len(expected):] if case.get("last") else rows
        for number, (row, value) in enumerate(zip(chosen, expected), 1):
            got = row.get(column)
            if got is None:
                yield f"no column {column}"
                break
            if isinstance(value, str):
                if got != value:
                    yield f"{column}, row {number}: {got!r}, expected {value!r}"
                continue
            try:
                error = abs(float(got) - value) / max(abs(value), case.get("scale", 0.0))
            except (ValueError, ZeroDivisionError):
                error = 0.0 if got and float(got) == value else float("nan")
            if not error <= case["within"]:
                yield f"{column}, row {number}: {got}, expected {value!r}: off by {error:.3g}, bound {case['within']:g}"


def run(case, programs):
    """Failures of one case."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in case.get("files", {}).items():
            pathlib.Path(folder, name).write_text(text)
        words = shlex.split(case["run"])
        done = subprocess.run([str(programs / words[0]), *words[1:]], input=case.get("input", ""), text=True,
                              capture_output=True, cwd=folder, timeout=120, check=False)
    if done.returncode != case.get("exit", 0):
        yield f"exit code {done.returncode}, expected {case.get('exit', 0)}"
    for word in case.get("says", []):
        if word not in done.stderr:
            yield f"standard error does not say {word!r}"
    if case.get("silent") and done.stderr:
        yield "standard error is not empty"
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    for column, text in case.get("where", {}).items():
        rows = [row for row in rows if row.get(column) == text]
    failed = list(compare(case, rows))
    yield from failed
    if failed or done.returncode != case.get("exit", 0):
        yield f"standard output: {done.stdout[:400]!r}"
        yield f"standard error: {done.stderr[:400]!r}"


def main(programs, file, *chosen):
    programs = pathlib.Path(programs).resolve()
    cases = tomllib.loads(pathlib.Path(file).read_text())["case"]
    ids = [case.get("id") for case in cases]
    for case in cases:
        if "files_of" in case:
            case["files"] = cases[ids.index(case["files_of"])]["files"]
    failures = 0
    for case in cases:
        if chosen and case.get("id") not in chosen:
            continue
        problems = list(check_table(case)) or list(run(case, programs))
        if ids.count(case.get("id")) > 1:
            problems.append("id is not unique")
        if problems:
            failures += 1
            print(f"{file}: case {case.get('id')} ({case.get('source')})\n  {case.get('run')}")
            for problem in problems:
                print(f"  {problem}")
    print(f"{len(chosen or cases) - failures} passed, {failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    os.environ["LC_ALL"] = "C"
    sys.exit(main(*sys.argv[1:]))
