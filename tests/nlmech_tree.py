"""What the Python tests share: where sources and build are, and how a program is run.

`pytest-3 tests/pages` tests ./build; the environment variable NLMECH_BUILD names another build."""
import csv
import os
import pathlib
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("NLMECH_BUILD", SOURCE / "build")).absolute()


def text_of(file):
    """A text file; its path is absolute or starts at the top of the sources."""
    return (SOURCE / file).read_text(encoding="utf-8")


def chapters():
    """The chapters of the build."""
    if not (BUILD / "chapters.txt").exists():
        raise RuntimeError(f"{BUILD} is not a build: run make build, or set NLMECH_BUILD")
    return text_of(BUILD / "chapters.txt").split()


def run(*command, code=0, **options):
    """Runs a program without standard input; its exit code must be @p code (None: any)."""
    options = {"stdin": subprocess.DEVNULL, "encoding": "utf-8"} | options
    done = subprocess.run([str(word) for word in command], capture_output=True, check=False, **options)
    assert code in (None, done.returncode), f"{command} ends with {done.returncode}\n{done.stdout}{done.stderr}"
    return done


def program(name):
    """The path of a program of the build."""
    return BUILD / "bin" / name


def scenes(chapter):
    """The rows of `list --csv`: dictionaries with scene and runs."""
    return list(csv.DictReader(run(program(chapter), "list", "--csv").stdout.splitlines()))


def write(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")


def sources_under(*folders, ends=(".hpp", ".cpp", ".cmake", ".txt")):
    """Paths of our own sources, in the order of the folders."""
    return [file for folder in folders for file in sorted((SOURCE / folder).rglob("*")) if file.suffix in ends and file.is_file()]
