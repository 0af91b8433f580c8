The command line that all chapters share
========================================

`fixture` is a small program of made-up scenes, in tests/scene/fixture.

  $ cp -r "$TESTDIR/../scene/fixture/data" data
  $ export NLMECH_DATA="$PWD/data"

Scenes, help, version
---------------------

  $ fixture list --csv
  scene,place,title,runs
  fig-1,our own,The values of counted,counted
  fig-2,our own,The values of summed,summed
  table-1,Table 1,"Two runs in one table, ""quoted"", with a comma",alone squared
  both,our own,A figure and its table,counted
  fig-3.14,our own,The values of squared,squared
  $ fixture list
  A chapter about nothing
  
  | scene | place | title | runs |
  | :--- | :--- | :--- | :--- |
  | fig-1 | our own | The values of counted | counted |
  | fig-2 | our own | The values of summed | summed |
  | table-1 | Table 1 | Two runs in one table, "quoted", with a comma | alone squared |
  | both | our own | A figure and its table | counted |
  | fig-3.14 | our own | The values of squared | squared |
  $ fixture run --help | grep Usage
  Usage: fixture run [OPTIONS] [scenes...]
  $ for words in --help "run --help" "check --help"; do fixture $words | grep -c 'Usage: '; done
  1
  1
  1
  $ fixture --version | cut -d ' ' -f 1
  nlmech
  $ fixture --manual | head -1 | cut -d ' ' -f 1-3
  .TH FIXTURE 1
  $ fixture --completion | tail -1 | grep -o '[^ ]*$'
  fixture
  $ fixture double --help | grep -e 'file TEXT' -e '--limit'
    file TEXT=-                 CSV file; - is standard input
    --limit NUMBER=60           stop after this much wall time, s
  $ ls
  data

On a terminal a list has aligned columns and fits:

  $ for columns in 50 80 200; do COLUMNS=$columns script -qec 'fixture list' /dev/null | tr -d '\r' | awk -v n=$columns '/\|/ || length > n'; done

Wrong use
---------

  $ refused fixture
  A subcommand is required
  Run with --help for more information.
  $ refused fixture sing
  A subcommand is required
  Run with --help for more information.
  $ refused fixture run
  fixture: run: no scene is named; give names, or --all; 'list' prints the names
  $ refused fixture run fig-9
  fixture: fixture has no scene 'fig-9'; it has fig-1, fig-2, table-1, both, fig-3.14
  $ refused fixture run fig-1 fig-9
  fixture: fixture has no scene 'fig-9'; it has fig-1, fig-2, table-1, both, fig-3.14
  $ refused fixture run --fast fig-1
  The following argument was not expected: --fast
  Run with --help for more information.
  $ refused fixture run fig-1 --out
  --out: 1 required TEXT missing
  Run with --help for more information.
  $ refused fixture list fig-1
  The following argument was not expected: fig-1
  Run with --help for more information.
  $ refused fixture check --png
  The following argument was not expected: --png
  Run with --help for more information.
  $ refused fixture run fig-1 --no-plots --png
  fixture: run: --png and --no-plots exclude each other; give one of them
  $ refused fixture run fig-1 --out a --out b
  --out: At Most 1 required but received 2
  Run with --help for more information.
  $ refused fixture run fig-1 --quick --quick
  --quick: At Most 1 required but received 2
  Run with --help for more information.
  $ refused fixture run fig-1 --out ''
  fixture: --out: an empty text
  $ refused fixture run ''
  fixture: scenes: an empty text
  $ refused fixture run fig-1 --no-plots=maybe
  Could not convert: --no-plots = maybe
  Run with --help for more information.
  $ refused fixture double none.csv
  fixture: none.csv: No such file or directory
  $ refused fixture double .
  fixture: .: is a folder, not a file
  $ ls
  data

Messages repeat little of what was typed, and no control character:

  $ long() { head -c 100000 /dev/zero | tr '\0' a; }
  $ clear=$(printf '\033[2J')
  $ head -c 10000000 /dev/zero | tr '\0' 1 | refused fixture double
  fixture: standard input: line 1: there is no column x; the header must name x, separated by commas, and is '111111111111111111111111111111111111111111111111111111111111... (10000000 bytes)'
  $ refused fixture run "$(long)"
  fixture: fixture has no scene 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa... (100000 bytes)'; it has fig-1, fig-2, table-1, both, fig-3.14
  $ refused fixture run fig-1 --$(long)
  The following argument was not expected: --aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa... (100002 bytes)
  Run with --help for more information.
  $ refused fixture double "$(long)"
  fixture: aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa... (403 bytes) (100000 bytes): File name too long
  $ refused fixture list $(seq 1 20000)
  The following arguments were not expected: 1 2 3 4 5 6 and 19994 more
  Run with --help for more information.
  $ refused fixture run fig-1 --quick=$(long)
  Could not convert: --quick = aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa... (100000 bytes)
  Run with --help for more information.
  $ printf '\033[2J\033]0;title\007\n' | refused fixture double
  fixture: standard input: line 1: there is no column x; the header must name x, separated by commas, and is '\x1b[2J\x1b]0;title\x07'; separate cells by commas and write numbers with a decimal point
  $ refused fixture run "$clear"
  fixture: fixture has no scene '\x1b[2J'; it has fig-1, fig-2, table-1, both, fig-3.14
  $ refused fixture "$clear"
  A subcommand is required
  Run with --help for more information.
  $ refused fixture double "$clear"
  fixture: \x1b[2J: No such file or directory
  $ refused fixture spin --limit "$clear"
  fixture: --limit \x1b[2J: not a finite number

The environment may hold kernels to a smaller instruction set; an unknown one ends each command:

  $ set_of() { NLMECH_INSTRUCTION_SET=$1 fixture run fig-1 --quiet --out out && sed -n 's/.*"instruction_set": "\([^"]*\)".*/\1/p' out/results/fixture/fig-1.json; }
  $ set_of baseline
  baseline
  $ largest=$(set_of '')
  $ [ "$(set_of $largest)" = $largest ]
  $ for wrong in sse9 AVX2 'avx2 ' "$(printf '\033[31m')"; do NLMECH_INSTRUCTION_SET=$wrong refused fixture list | sed "s/one of .*$largest\$/one of .../"; done
  fixture: NLMECH_INSTRUCTION_SET=sse9: is not an instruction set of this processor; choose one of ...
  fixture: NLMECH_INSTRUCTION_SET=AVX2: is not an instruction set of this processor; choose one of ...
  fixture: NLMECH_INSTRUCTION_SET=avx2 : is not an instruction set of this processor; choose one of ...
  fixture: NLMECH_INSTRUCTION_SET=\x1b[31m: is not an instruction set of this processor; choose one of ...
  $ rm -r out

A user's own numbers
--------------------

  $ printf 'x\n0.1\n+2\n' | fixture double -
  x
  0.20000000000000001
  4
  $ printf '1\n\ntwo\n' | refused fixture double
  fixture: standard input: line 3, column 1 (x): 'two' is not a finite number
  $ printf '1\n-1\n' | fixture double
  fixture: outside_validity: double: a negative number; give its magnitude
  [1]
  $ refused fixture double < .
  fixture: standard input: cannot be read to its end: Is a directory

A full disk behind standard output, and closed streams; gnuplot draws with all three closed:

  $ for words in list "list --csv" check double --help "run --help" --version; do echo 1 | fixture $words > /dev/full || echo "exit code $?"; done
  fixture: standard output: cannot be written: No space left on device
  exit code 1
  fixture: standard output: cannot be written: No space left on device
  exit code 1
  fixture: standard output: cannot be written: No space left on device
  exit code 1
  fixture: standard output: cannot be written: No space left on device
  exit code 1
  fixture: standard output: cannot be written: No space left on device
  exit code 1
  fixture: standard output: cannot be written: No space left on device
  exit code 1
  fixture: standard output: cannot be written: No space left on device
  exit code 1
  $ rm -r results
  $ fixture list >&-
  fixture: standard output: cannot be written: Bad file descriptor
  [1]
  $ fixture run fig-1 --quiet --out a >&- 2>&- <&-
  $ find a -type f | sort
  a/figures/fixture/fig-1.svg
  a/figures/style.gp
  a/results/fixture/fig-1.csv
  a/results/fixture/fig-1.gp
  a/results/fixture/fig-1.json
  $ fixture run both --out b >&- 2>&- <&-
  [1]
  $ find b -type f | wc -l
  7
  $ rm -r a b

Runs
----

  $ fixture run --all --quick --quiet --out a
  $ fixture run --all --quick --out a | sort > named.txt
  $ (cd a && find . -type f ! -name style.gp | cut -c 3- | sort) | cmp - named.txt
  $ fixture run --all --quick --out a | sort | cmp - named.txt
  $ fixture run fig-1 --out b > flags.txt
  $ fixture run fig-1 --out b --no-plots=false --quiet=false | cmp - flags.txt
  $ rm -r a b

Checks
------

  $ fixture check
         made-up/table-1/nominal/reproduced: published 2, nominal 2: reproduced
         made-up/table-1/inferred/reproduced (inferred): published 3, nominal 5, inferred 3.2: reproduced, inferred reading [twice the load (3 tried; explains 1 of 1 rows)]
         made-up/table-1/smaller/better: published 1e-3, nominal 1.2e-6: better
         made-up/table-1/other/differs: published 1.0, nominal 4: differs [a misprint]
         made-up/table-1/start; guess, "seed" #1/not stated: published 7: not stated [the start is not stated]
         made-up/table-1/old machine/context: published 0.23: context [measured elsewhere]
         made-up/table-1/load/input: published 9.81, nominal 9.81: input
  5 quantities of 5 scenes: 5 pass, 0 fail
  $ find results -type f
  results/fixture/check.csv

Values that are missed:

  $ cp "$TESTDIR/../scene/fixture/missed.csv" data/tables/published/made-up.csv
  $ rm -r results
  $ fixture check
  FAILS made-up/table-1/nominal/reproduced: published 20, nominal 2: differs (FAILS: expected reproduced)
  FAILS made-up/table-1/inferred/reproduced (inferred): published 3, nominal 5, inferred 3.2: differs (FAILS: expected reproduced, inferred reading) [twice the load (3 tried; explains 1 of 1 rows)]
  FAILS made-up/table-1/smaller/better: published 1e-9, nominal 1.2e-6: differs (FAILS: expected better)
  FAILS made-up/table-1/other/differs: published 4, nominal 4: reproduced (FAILS: expected differs) [a misprint]
         made-up/table-1/start; guess, "seed" #1/not stated: published 7: not stated [the start is not stated]
         made-up/table-1/old machine/context: published 0.23: context [measured elsewhere]
  FAILS made-up/table-1/load/input: published 9.8, nominal 9.81: reproduced (FAILS: expected input)
  5 quantities of 5 scenes: 5 pass, 0 fail
  [1]
  $ ls results/fixture/check.csv
  results/fixture/check.csv
  $ cp "$TESTDIR/../scene/fixture/data/tables/published/made-up.csv" data/tables/published
  $ rm results/fixture/check.csv
  $ FIXTURE_FAULT=quantity fixture check | tail -1
  FAILS fig-1: first value = 2 1, allowed 1 to 1 (counted by hand)
  FAILS fig-2: first value = 2 1, allowed 1 to 1 (counted by hand)
  FAILS table-1: first value = 3 1, allowed 2 to 2 (counted by hand)
  FAILS both: first value = 2 1, allowed 1 to 1 (counted by hand)
  FAILS fig-3.14: first value = 2 1, allowed 1 to 1 (counted by hand)
  5 quantities of 5 scenes: 0 pass, 5 fail
  $ ls results/fixture/check.csv
  results/fixture/check.csv
  $ printf 'place,row\n1,2\n' > data/tables/published/made-up.csv
  $ refused fixture check
  fixture: */data/tables/published/made-up.csv: line 2: 2 of 15 cells (glob)
  $ NLMECH_DATA=/nowhere/at/all refused fixture check
  fixture: /nowhere/at/all/tables/places.csv: No such file or directory
