"""The pages of tables/ and the tests of the printed numbers, from the files that the chapters' checks and `make bench` wrote.

  python3 scripts/tables check SOURCE OUT CHAPTER...     tables/REPRODUCTION.md, COMPLETENESS.md, CLAIMS.md and ERRATA.md of SOURCE, and
                                                         OUT/tables/<chapter>/errata.md; exit code 1 if a verdict is another than expected
                                                         or a figure or table incomplete
  python3 scripts/tables bench SOURCE                    tables/BENCH.md, RATIOS.md and ratios.json, of results/bench and results/ratios
  python3 scripts/tables tests SOURCE CHECK CHAPTER...   prints a test for each printed number, as ctest includes them; CHECK is the
                                                         folder to which the chapters' checks write their output

CHAPTER: those of this build. Exit code 2 if a list is wrong, with its file and line."""
import pathlib
import sys

import claims
import completeness
import errata
import lists
import speed
import values
from guide import Guide


def complain(sentence):
    print(sentence, file=sys.stderr)


def write_errata(source, out, guide):
    found = errata.read_errata(source)
    for chapter in {entry.chapter for entry in found}:
        lists.write(out / f"tables/{chapter}/errata.md", errata.chapter_table(found, chapter))
    lists.write(source / "tables/ERRATA.md", errata.page(found, guide))
    print(f"{len(found)} errata")


def check(source, out, *chapters):
    """Writes all pages, then reports failures."""
    places = lists.read_places(source)
    guide = Guide(source, places)
    printed = lists.read_values(source, places)
    lists.add_verdicts(printed, out, chapters)
    lists.write(source / "tables/REPRODUCTION.md", values.page(printed, guide))
    missed = [f"FAILS {v.name}: published {v.printed}, nominal {values.nominal(v)}: {values.verdict(v)}" for v in printed if v.fails]
    print(f"{len(printed)} published values, {len(missed)} fail")

    shown = completeness.collect(places, printed, out, chapters)
    lists.write(source / "tables/COMPLETENESS.md", completeness.page(shown, completeness.read_future(source, out, chapters)))
    lacking = [f"INCOMPLETE {s.place.source} {s.place.name}: {s.lacks()}" for s in shown if s.lacks()]
    print(f"{len(shown)} figures and tables, {len(lacking)} incomplete")

    claimed = claims.collect(places, printed, source, out, chapters)
    lists.write(source / "tables/CLAIMS.md", claims.page(claimed))
    failing = [claims.failure(claim) for claim in claimed if claim.fails]
    print(f"{len(claimed)} claims in prose, {len(failing)} fail")

    write_errata(source, out, guide)
    for sentence in missed + lacking + failing:
        complain(sentence)
    return 1 if missed or lacking or failing else 0


def bench(source):
    if runs := speed.read_all(source / "results/bench"):
        lists.write(source / "tables/BENCH.md", speed.speed_page(runs))
    if runs := speed.read_all(source / "results/ratios"):
        ratios = speed.Ratios(runs)
        lists.write(source / "tables/RATIOS.md", speed.ratios_page(ratios))
        lists.write(source / "tables/ratios.json", speed.quantities(ratios))
    return 0


def tests(source, folder, *chapters):
    """A test looks for the line that its chapter's check printed of its value. Names hold blanks, semicolons, quotes, parentheses and
    number signs: all goes through bracket arguments."""
    for value in lists.read_values(source, lists.read_places(source)):
        built = value.chapter in chapters
        said = f"grep [==[-F]==] [==[-e]==] [==[ {value.name}: published ]==] [==[{folder}/{value.chapter}.values]==]"
        expected = (f"FAIL_REGULAR_EXPRESSION [==[^FAILS ]==] FIXTURES_REQUIRED [==[check_{value.chapter}]==]" if built
                    else "SKIP_RETURN_CODE 1")
        print(f"add_test([==[{value.name}]==] {said if built else 'false'})\n"
              f"set_tests_properties([==[{value.name}]==] PROPERTIES LABELS reproduction {expected})")
    return 0


def main(command="", *arguments):
    fewest = {"check": 2, "bench": 1, "tests": 2}.get(command)
    if fewest is None or len(arguments) < fewest:
        complain(__doc__)
        return 2
    folders = [pathlib.Path(folder) for folder in arguments[:fewest]]
    try:
        return {"check": check, "bench": bench, "tests": tests}[command](*folders, *arguments[fewest:])
    except lists.Refused as refused:
        complain(f"tables: {refused}")
    except OSError as error:
        complain(f"tables: {error.filename}: {error.strerror}")
    return 2


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
