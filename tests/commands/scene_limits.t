Every command has a limit of wall time
======================================

It leaves all in order when it is reached. No time is compared: a limit that did not hold would leave this page without an end.

  $ export NLMECH_DATA="$TESTDIR/../scene/fixture/data"
  $ fixture spin --limit 0.1
  fixture: time_limit: spin: not done within --limit 0.1 s (it was computing); give a larger --limit, or ask for less
  [1]
  $ for command in list run check double spin heed; do fixture $command --help | grep -c -e --limit; done | sort -u
  1
  $ fixture spin --help | grep -o -e '--limit NUMBER=60'
  --limit NUMBER=60
  $ fixture run --help | grep -e =60
  [1]
  $ for limit in 0 -1 nan soon 1e999; do refused fixture spin --limit $limit; done
  fixture: --limit 0: must be positive
  fixture: --limit -1: must be positive
  fixture: --limit nan: not a finite number
  fixture: --limit soon: not a finite number
  fixture: --limit 1e999: not a finite number
  $ echo 1 | fixture double --limit 1e300
  x
  2

Standard input without an end:

  $ mkfifo never
  $ (exec 3<>never; fixture double --limit 1 <&3)
  fixture: time_limit: double: not done within --limit 1 s (it was reading standard input); give a larger --limit, or ask for less
  [1]

A command that heeds its limit has the last word, if it comes in time:

  $ fixture heed --limit 0.1
  fixture: time_limit: heed: at step 17 of 20; take longer steps
  [1]
  $ fixture heed deaf --limit 0.1
  fixture: time_limit: heed: not done within --limit 0.1 s (it was computing); give a larger --limit, or ask for less
  [1]

The reader of a result may take as long as it likes; what it gets is whole:

  $ { fixture flood --limit 0.1; echo $? > code.txt; } | { sleep 0.4; wc -c; }
  1000001
  $ cat code.txt
  0

Scenes that are done are kept, and nothing is half written:

  $ FIXTURE_FAULT=endless fixture run fig-1 fig-2 --no-plots --limit 3
  results/fixture/fig-1.csv
  results/fixture/fig-1.gp
  results/fixture/fig-1.json
  fixture: time_limit: run: not done within --limit 3 s (it was computing fig-2); give a larger --limit, or ask for less
  [1]
  $ find results -type f ! -name style.gp | wc -l
  3

gnuplot is ended too: SIGKILL was sent before the program ended.

  $ mkdir bin
  $ printf '#!/bin/sh\necho $$ > %s/child\nexec sleep 1000\n' "$PWD" > bin/gnuplot
  $ chmod +x bin/gnuplot
  $ PATH=$PWD/bin:$PATH fixture run fig-1 --limit 3
  fixture: time_limit: run: not done within --limit 3 s (it was *); give a larger --limit, or ask for less (glob)
  [1]
  $ sleep 0.1
  $ cat "/proc/$(cat child)/stat" 2> said.txt | grep -v ') Z'
  [1]

What ends in time has its own exit code:

  $ echo 1 | fixture double --limit 50
  x
  2
  $ echo -1 | fixture double --limit 50
  fixture: outside_validity: double: a negative number; give its magnitude
  [1]
  $ echo two | fixture double --limit 50
  fixture: standard input: line 1: there is no column x; the header must name x, separated by commas, and is 'two'
  [2]
  $ fixture list --limit 50 > list.txt
