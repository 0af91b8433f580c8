"""tables/BENCH.md, tables/RATIOS.md and tables/ratios.json, from the results and verdicts that the programs of `make bench` wrote to
results/bench and results/ratios."""
import json

from lists import read_json
from markdown import table

SPEED = """# Speed

Ratios of medians to a peer in the same process: time of the peer over time of the nlmech method. *From* and *to* are the smallest and the largest \
ratio of single repetitions. Integrators of other libraries run as in their manuals: in their own loop over steps, on their own \
state, without nlmech code. Behind the nlmech interface, which adds a status, observers and checks, they take longer: lines *in \
our loop* show by how much. Lines *multiply-adds alone* are the lower bound for SIMD lanes: as many multiply-adds as the series need, \
with all numbers in registers. Written by `make bench`.
"""
RATIOS = """# Ratios of run times

The dissertation prints seconds of MATLAB on an unknown machine. Absolute times cannot be compared, but ratios can. A ratio is the \
time of a row's method over that of the *reference* of its table: the series (Analytic-Cont) over as \
many orbits in Tables 3.2 and 3.3, collocation with 35 nodes (RBF-Coll-2) in Tables 4.2, 4.4 and 4.6. Above 1 the reference, the \
source's own method, is the faster one. Each run has the setting of its row and is the one whose error is in the table of that \
name here; all run in one process and one thread, repeated in random order after a run that warms up. *Reproduced* is the ratio of medians; *from* \
and *to* are the ratios of opposite quartiles.

A printed ratio *holds* if the same of the two methods is the faster one here, and the two ratios are at most a factor of {:g} apart: \
ratios of compiled programs moved by up to a half between the machines that we tried, and printed digits leave a tenth or two more. \
Larger differences are due to the programs, and to MATLAB's interpreter, where a step costs the same whatever it computes, rather \
than to the methods. Of {} ratios {} hold; with factors of 2, 5 and 10 it would be {}, {} and {}. No test asserts a time. Written by \
`make bench`.
"""
PROSE = """
## Claims in prose

The text says "on average", and the mean of the printed rows over 5, 10 and 20 orbits gives its numbers; the reproduced number is the same mean.

"""
LOST = "The reference is faster in print and slower here than the method of the row; largest difference first.\n\n"
RATIO = ["printed", "reproduced", "from", "to", "apart"]


def read_all(folder):
    """Measurements of each program, by its name."""
    return {file.stem: read_json(file) for file in sorted(folder.glob("*.json"))}


def machine(run):
    """Machine and build."""
    return f"{run['processor']}, {run['compiler']}, commit {run['commit']}{' with changes' if run['dirty'] else ''}.\n"


def speed_page(runs):
    text = SPEED
    for name, run in runs.items():
        claims = [[c["claim"], c["promised"], c["ratio"], c["low"], c["high"], "yes" if c["held"] else "NO"] for c in run.get("claims", [])]
        times = [[s["name"], s["median"], min(s["repetitions"]), max(s["repetitions"]), s["unit"]] for s in run.get("series", [])]
        text += (f"\n## {name}\n\n{machine(run)}\n{table(['claim', 'promised', 'measured', 'from', 'to', 'held'], claims)}\n"
                 + table(["work", "median", "from", "to", "unit"], times))
    return text


class Ratios:
    """Printed and measured ratios: rows by their places, and claims."""

    def __init__(self, runs):
        self.runs = runs
        self.rows = sorted((row for run in runs.values() for row in run["rows"]), key=lambda row: row["place"])
        self.claims = [claim for run in runs.values() for claim in run["claims"]]
        self.compared = [row for row in self.rows if row["row"] != row["reference"]]  # whose ratio is not 1
        self.lost = sorted((row for row in self.compared if row["verdict"]["lost"]), key=lambda row: -row["verdict"]["apart"])
        self.factor = next(iter(runs.values()))["allowed_factor"]

    def held(self, factor):
        """Ratios that would hold with another factor."""
        return sum(row["verdict"]["same_faster"] and row["verdict"]["apart"] <= factor for row in self.compared)


def verdict(row):
    return "holds" if row["verdict"]["holds"] else "does not hold"


def ratio(row):
    """The cells of RATIO."""
    return [row["verdict"][key] for key in ("printed", "reproduced", "low", "high", "apart")]


def ratios_page(ratios):
    lost = table(["table", "method", "over", *RATIO], [[r["place"][6:], r["row"], r["reference"], *ratio(r)] for r in ratios.lost])
    text = RATIOS.format(ratios.factor, len(ratios.compared), *map(ratios.held, (ratios.factor, 2, 5, 10)))
    text += "\n## Faster in print, slower here\n\n" + (LOST + lost if ratios.lost else "In no row.\n")
    text += PROSE + table(["claim", "orbit", "of", *RATIO, "verdict"], [
        [c["place"][6:], c["row"], c["quantity"], *ratio(c), verdict(c)] for c in ratios.claims])
    for place in dict.fromkeys(row["place"] for row in ratios.rows):
        text += f"\n## {place.replace('-', ' ').capitalize()}\n\n" + table(
            ["method", "printed (s)", "measured (s)", "printed ratio", *RATIO[1:], "verdict"],
            [[r["row"], r["printed_seconds"], r["seconds"], *ratio(r), "reference" if r["row"] == r["reference"] else verdict(r)]
             for r in ratios.rows if r["place"] == place], digits={"printed (s)": 6})
    return text + "\n## Measured on\n\n" + "".join(f"- {name}: {machine(run)}" for name, run in ratios.runs.items())


def quantities(ratios):
    """What pages may quote, as JSON."""
    found = [(f"{r['place']}, {r['row']}, printed over measured seconds", r["printed_seconds"] / r["seconds"]) for r in ratios.rows]
    found += [("ratios", len(ratios.compared)), ("ratios that hold", ratios.held(ratios.factor)),
              ("faster in print, slower here", len(ratios.lost))]
    for name, row in ([(f"{r['place']}, {r['row']}", r) for r in ratios.compared]
                      + [(f"{c['place']}, {c['row']}, {c['quantity']}", c) for c in ratios.claims]):
        found += [(f"{name}, {key}", row["verdict"][key]) for key in ("printed", "reproduced")] + [(f"{name}, verdict", verdict(row))]
    listed = [{"name": name, "value": value, "unit": "" if isinstance(value, str) else "1"} for name, value in found]
    return json.dumps({"quantities": listed}, indent=2, ensure_ascii=False) + "\n"
