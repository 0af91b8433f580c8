What run leaves on disk
=======================

  $ cp -r "$TESTDIR/../scene/fixture/data" data
  $ export NLMECH_DATA="$PWD/data"
  $ written() { find "${1:-results}" -type f ! -name style.gp ! -name '.*' | sort; }

The files of the scenes alone, in the current folder or in --out; a dot in the name of a scene stays:

  $ fixture run fig-1 fig-3.14
  results/fixture/fig-1.csv
  results/fixture/fig-1.gp
  results/fixture/fig-1.json
  figures/fixture/fig-1.svg
  results/fixture/fig-3.14.csv
  results/fixture/fig-3.14.gp
  results/fixture/fig-3.14.json
  figures/fixture/fig-3.14.svg
  $ written figures
  figures/fixture/fig-1.svg
  figures/fixture/fig-3.14.svg
  $ fixture run table-1 --out table > log.txt
  $ written table
  table/results/fixture/table-1.json
  table/tables/fixture/table-1.csv
  table/tables/fixture/table-1.md
  $ fixture run both both --out both > log.txt
  $ written both
  both/figures/fixture/both.svg
  both/results/fixture/both.csv
  both/results/fixture/both.gp
  both/results/fixture/both.json
  both/tables/fixture/both.csv
  both/tables/fixture/both.md
  $ fixture run both --no-plots --out numbers > log.txt
  $ written numbers
  numbers/results/fixture/both.csv
  numbers/results/fixture/both.gp
  numbers/results/fixture/both.json
  numbers/tables/fixture/both.csv
  numbers/tables/fixture/both.md

The same byte for byte in a second run, whichever others ran, and of a check that draws:

  $ fixture run --all --out full > log.txt
  $ written full | wc -l
  21
  $ fixture run --all --out again > log.txt
  $ diff -r full again
  $ fixture check --draw --out again > log.txt
  $ diff -r full again
  Only in again/results/fixture: check.csv
  [1]
  $ fixture run fig-2 --out one > log.txt
  $ for file in $(written one); do cmp $file full/${file#one/}; done

They name exactly the results behind them, and no path of the machine:

  $ for scene in fig-1 fig-2 table-1 both fig-3.14; do
  >   python3 -c 'import json, sys; print(*sorted(run["name"] for run in json.load(open(sys.argv[1]))["runs"]))' full/results/fixture/$scene.json
  > done
  counted
  counted squared summed
  alone counted squared
  counted
  counted squared
  $ grep -r -l -F -e "$PWD" -e "$(cd "$TESTDIR/../.." && pwd)" -e "$(dirname "$(dirname "$(command -v fixture)")")" full
  [1]

A quantity that misses is written too, since `check` judges it:

  $ FIXTURE_FAULT=quantity fixture run fig-1 --out missed > log.txt
  $ grep -o '"passes": [a-z]*' missed/results/fixture/fig-1.json
  "passes": false

What goes wrong
---------------

Without gnuplot there are all but the four pictures, and no old picture beside new data:

  $ fixture=$(command -v fixture)
  $ PATH=/nowhere "$fixture" run --all --quick --quiet --out quick
  fixture: fig-1: figure fig-1.svg of fixture was not drawn: gnuplot: cannot be started: No such file or directory; its script is quick/results/fixture/fig-1.gp
  fixture: fig-2: figure fig-2.svg of fixture was not drawn: gnuplot: cannot be started: No such file or directory; its script is quick/results/fixture/fig-2.gp
  fixture: both: figure both.svg of fixture was not drawn: gnuplot: cannot be started: No such file or directory; its script is quick/results/fixture/both.gp
  fixture: fig-3.14: figure fig-3.14.svg of fixture was not drawn: gnuplot: cannot be started: No such file or directory; its script is quick/results/fixture/fig-3.14.gp
  [1]
  $ written quick | wc -l
  17
  $ fixture run fig-1 --quick --out old > log.txt
  $ PATH=/nowhere "$fixture" run fig-1 --quiet --out old 2> said.txt
  [1]
  $ ls old/figures/fixture

What is the same is not drawn again; another style or template is:

  $ for changed in figures/style.gp figures/templates/fixture-line.gp; do
  >   fixture run fig-1 --quiet --out same
  >   PATH=/nowhere "$fixture" run fig-1 --quiet --out same
  >   echo '# a remark' >> data/$changed
  >   PATH=/nowhere "$fixture" run fig-1 --quiet --out same || echo "exit code $?"
  > done
  fixture: fig-1: figure fig-1.svg of fixture was not drawn: gnuplot: cannot be started: No such file or directory; its script is same/results/fixture/fig-1.gp
  exit code 1
  fixture: fig-1: figure fig-1.svg of fixture was not drawn: gnuplot: cannot be started: No such file or directory; its script is same/results/fixture/fig-1.gp
  exit code 1

A picture as PNG that fails leaves that as SVG; a template that is missing leaves the tables:

  $ cp data/figures/style.gp style.gp
  $ sed -i "1i if (exists('png')) { exit status 2 }" data/figures/style.gp
  $ fixture run fig-1 --png --quiet --out png
  fixture: fig-1: figure fig-1.png of fixture was not drawn: gnuplot ended with 2: ; its script is png/results/fixture/fig-1.gp
  [1]
  $ ls png/figures/fixture
  fig-1.svg
  $ cp style.gp data/figures/style.gp
  $ mv data/figures/templates/fixture-line.gp .
  $ fixture run fig-1 table-1 --quiet --out none
  fixture: fig-1: */data/figures/templates/fixture-line.gp: no such template (glob)
  [1]
  $ written none/tables
  none/tables/fixture/table-1.csv
  none/tables/fixture/table-1.md
  $ mv fixture-line.gp data/figures/templates

A scene that fails leaves the others alone:

  $ FIXTURE_FAULT=run fixture run --all --quick --quiet --out fails
  fixture: fig-2: not_converged: summed stalled at term 3; start nearer
  [1]
  $ written fails | wc -l
  17

Places where nothing can be written; no temporary files stay behind:

  $ echo 'in the way' > file
  $ mkdir -p occupied/results/fixture/fig-1.csv occupied/results/fixture/check.csv
  $ for out in file occupied /proc/nowhere /dev/null; do
  >   for command in "run fig-1" check; do fixture $command --out $out || echo "exit code $?"; done
  > done
  fixture: fig-1: file/results/fixture: Not a directory
  exit code 1
  fixture: file/results/fixture: Not a directory
  exit code 1
  fixture: fig-1: occupied/results/fixture/fig-1.csv: cannot be written: Is a directory
  exit code 1
  fixture: occupied/results/fixture/check.csv: cannot be written: Is a directory
  exit code 1
  fixture: fig-1: /proc/nowhere/results/fixture: No such file or directory
  exit code 1
  fixture: /proc/nowhere/results/fixture: No such file or directory
  exit code 1
  fixture: fig-1: /dev/null/results/fixture: Not a directory
  exit code 1
  fixture: /dev/null/results/fixture: Not a directory
  exit code 1
  $ find occupied -type f ! -name style.gp

Runs that are killed at any moment leave whole files, of this run or the one before; the next run repairs all. Quick and full runs write different
bytes:

  $ fixture run --all --quick --quiet --out quick
  $ cmp -s quick/results/fixture/fig-1.csv full/results/fixture/fig-1.csv
  [1]
  $ rm -r full
  $ start=$(date +%s%N); fixture run --all --quiet --out full; time=$(($(date +%s%N) - start))
  $ for i in $(seq 20); do
  >   seconds=$(awk -v i=$i -v t=$time 'BEGIN {srand(i); print 0.001 + 0.9e-9*t*rand()}')
  >   (timeout -s KILL $seconds fixture run --all --quiet --out out $([ $((i % 2)) -eq 1 ] || echo --quick)) || echo killed >> killed.txt
  >   [ ! -d out ] || for file in $(written out); do cmp -s $file full/${file#out/} || cmp -s $file quick/${file#out/} || echo "$file is torn"; done
  > done 2> said.txt
  $ sort -u killed.txt
  killed
  $ fixture run --all --quiet --out out
  $ for file in $(written full); do cmp $file out/${file#full/}; done
