"""coverage.py SOURCE BUILD: the share of lines of common/nlmech that ran, by component; each line that did not is in
BUILD/coverage.txt. Exit 1 below 95 %. Kernels are left out: a machine runs one of the instruction sets they are for."""
import collections
import json
import pathlib
import subprocess
import sys

source, build = sys.argv[1:]
counts = collections.defaultdict(lambda: collections.defaultdict(int))  # [file][line]
for data in sorted(pathlib.Path(build).resolve().rglob("*.gcda")):
    gcov = ["gcov", "--relative-only", "--source-prefix", source, "--json-format", "--stdout", data]
    for part in subprocess.run(gcov, check=True, capture_output=True, text=True).stdout.splitlines():
        for file in json.loads(part)["files"] if part else []:
            name = file["file"].removeprefix(source + "/")
            if name.startswith("common/nlmech/") and "/kernels/" not in name:
                for line in file["lines"]:
                    counts[name][line["line_number"]] += line["count"]

lines, run = collections.Counter(), collections.Counter()
with open(pathlib.Path(build) / "coverage.txt", "w") as missed:
    for name, of_file in sorted(counts.items()):
        for component in (name.split("/")[2], "all"):
            lines[component] += len(of_file)
            run[component] += sum(count > 0 for count in of_file.values())
        missed.writelines(f"{name}:{line}\n" for line, count in sorted(of_file.items()) if count == 0)
for component in [*sorted(lines.keys() - {"all"}), "all"]:
    print(f"{component:14} {100 * run[component] / lines[component]:5.1f} % of {lines[component]:5} lines")
sys.exit(run["all"] < 0.95 * lines["all"])
