Grids of transfers
==================

  $ ln -s "$TESTDIR/../../chapters" chapters
  $ mkdir build && ln -s "$(dirname "$(command -v rbf_inverse)")" build/bin
  $ orbits=chapters/rbf_inverse/earth-mars.toml
  $ porkchop() { rbf_inverse porkchop "$@"; }

Any number of threads writes the same bytes:

  $ porkchop $orbits --grid 23x31 --threads 1 > whole.csv
  $ head -1 whole.csv
  departure,arrival,v_departure,v_arrival,revolutions
  $ for threads in 0 2 7; do porkchop $orbits --grid 23x31 --threads $threads | cmp - whole.csv; done

Summer of 2003, recorded over continuous times by other code: 5669.373 m/s in all, leaving 1253.40 days and arriving 1457.10 days after J2000. The grid
has steps of 5 days and is above by less than two thousandths, since the cost is flat there:

  $ porkchop $orbits --grid 51x81 > grid.csv
  $ holds --each 'arrival >= departure' 'v_departure + v_arrival >= 5669.373' < grid.csv
  $ awk -F, 'NR == 1 || NR == 2 || $3 + $4 < least {least = $3 + $4; line = $0} END {print "departure,arrival,a,b,n"; print line}' grid.csv |
  >   holds 'a + b <= 5669.373*(1 + 2e-3)' 'departure/86400 = 1253.40 +- 5' 'arrival/86400 = 1457.10 +- 5'

Pictures
--------

In the current folder, when the numbers are written, over an older picture of this command and nothing else:

  $ cat > two.toml <<END
  > mu = 1
  > [from]
  > a = 1
  > e = 0
  > [to]
  > position = [0, 2, 0]
  > velocity = [-0.7, 0, 0.1]
  > [departures]
  > first = 0
  > last = 6
  > [arrivals]
  > first = 4
  > last = 16
  > END
  $ porkchop two.toml --grid 20x20 > plain.csv
  $ for k in 1 2; do porkchop two.toml --grid 20x20 --plot | cmp - plain.csv; done
  $ tail -1 two.svg
  <!-- drawn by a command of nlmech -->
  $ cp two.toml input.svg
  $ refused rbf_inverse porkchop input.svg --grid 5x5 --plot
  rbf_inverse: --plot input.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  $ cmp two.toml input.svg
  $ echo '<svg>of somebody else</svg>' > two.svg
  $ refused rbf_inverse porkchop two.toml --grid 5x5 --plot
  rbf_inverse: --plot two.svg: exists and was not drawn by nlmech, so it is not overwritten; give another name, or move it
  $ rm two.svg
  $ refused rbf_inverse porkchop two.toml --grid 3x9 --plot
  rbf_inverse: --grid 3x9: --plot needs 4x4 or more

Without gnuplot there are numbers:

  $ program=$(command -v rbf_inverse)
  $ PATH=/nowhere "$program" porkchop two.toml --grid 20x20 --plot > numbers.csv
  rbf_inverse: all numbers are written, but two.svg is not drawn: gnuplot: cannot be started: No such file or directory
  [1]
  $ cmp numbers.csv plain.csv

The command of the chapter's page
---------------------------------

It draws:

  $ block() { awk -v first="$1" 'index($0, first) == 1 {inside = 1} /^```/ && inside {exit} inside' chapters/rbf_inverse/rbf_inverse.md; }
  $ block 'build/bin/rbf_inverse porkchop' > page.sh
  $ sh -e page.sh
  $ tail -1 earth-mars.svg
  <!-- drawn by a command of nlmech -->

Mistakes
--------

  $ wrong() { refused rbf_inverse porkchop "$@"; }
  $ for grid in 5 x 0x5 5x-1 5x2.5 5x 1e9x2 nanx3; do wrong $orbits --grid $grid; done
  rbf_inverse: --grid 5: needs two whole numbers from 1 to 1000000, separated by x
  rbf_inverse: --grid x: needs two whole numbers from 1 to 1000000, separated by x
  rbf_inverse: --grid 0x5: needs two whole numbers from 1 to 1000000, separated by x
  rbf_inverse: --grid 5x-1: needs two whole numbers from 1 to 1000000, separated by x
  rbf_inverse: --grid 5x2.5: needs two whole numbers from 1 to 1000000, separated by x
  rbf_inverse: --grid 5x: needs two whole numbers from 1 to 1000000, separated by x
  rbf_inverse: --grid 1e9x2: needs two whole numbers from 1 to 1000000, separated by x
  rbf_inverse: --grid nanx3: needs two whole numbers from 1 to 1000000, separated by x
  $ wrong $orbits --grid 4x4 --threads -2
  rbf_inverse: --threads -2: must be a whole number from 0 to 1024
  $ wrong $orbits --grid 50000x50000
  rbf_inverse: chapters/rbf_inverse/earth-mars.toml: porkchop: 50000 x 50000 cells are too many
  $ wrong absent.toml --grid 4x4
  rbf_inverse: absent.toml: No such file or directory

In a file, with line and value:

  $ cat > good.toml <<END
  > mu = 1
  > [from]
  > a = 1
  > e = 0.1
  > [to]
  > a = 2
  > e = 0
  > [departures]
  > first = 0
  > last = 6
  > [arrivals]
  > first = 4
  > last = 16
  > END
  $ bad() { sed "$@" good.toml > bad.toml; refused rbf_inverse porkchop bad.toml --grid 4x4; }
  $ porkchop good.toml --grid 4x4 | wc -l
  15
  $ bad '1s/.*/mu = = 1/'
  rbf_inverse: bad.toml, line 1, column 6: Error while parsing value: could not determine value type
  $ bad '2,4d'
  rbf_inverse: bad.toml, line 1: the table [from] is missing
  $ bad 1,4d
  rbf_inverse: bad.toml, line 1: mu is missing
  $ bad '1s/.*/mu = -1/'
  rbf_inverse: bad.toml, line 1: mu = -1 must be positive
  $ bad '1s/.*/mu = "one"/'
  rbf_inverse: bad.toml, line 1: mu = 'one': not a number
  $ bad '1s/.*/mu = nan/'
  rbf_inverse: bad.toml, line 1: mu = nan: not a finite number
  $ bad '1s/.*/mu = 1e-200/'
  rbf_inverse: bad.toml, line 1: mu makes a size of 1e-200; it must be from 1e-100 to 1e+100, so choose other units
  $ bad '4s/.*/e = -0.5/'
  rbf_inverse: bad.toml, line 4: from.e = -0.5 must be 0 or more
  $ bad '3s/.*/a = -1/; 4s/.*/e = 0.5/'
  rbf_inverse: bad.toml, line 3: from.a = -1: from_axis: a = -1 and e = 0.5 make no conic (p = a (1 - e^2) must be positive and finite); a is positive for e < 1 and negative for e > 1
  $ bad '4s/.*/e = 1/'
  rbf_inverse: bad.toml, line 3: from.a = 1: from_axis: a = 1 and e = 1 make no conic (p = a (1 - e^2) must be positive and finite); a is positive for e < 1 and negative for e > 1
  $ bad '3s/.*/a = 1\np = 1/'
  rbf_inverse: bad.toml, line 4: give one of from.a and from.p
  $ bad '3s/.*/p = -1/'
  rbf_inverse: bad.toml, line 3: from.p = -1 must be positive
  $ bad '6s/.*/position = [1, 2]/; 7s/.*/velocity = [0, 1, 0]/'
  rbf_inverse: bad.toml, line 6: to.position must be three numbers
  $ bad '6s/.*/position = [0, 0, 0]/; 7s/.*/velocity = [0, 1, 0]/'
  rbf_inverse: bad.toml, line 6: to.position is the centre
  $ bad '6s/.*/position = [1, 0, inf]/; 7s/.*/velocity = [0, 1, 0]/'
  rbf_inverse: bad.toml, line 6: to.position = inf: not a finite number
  $ bad '6s/.*/position = [1e150, 0, 0]/; 7s/.*/velocity = [0, 1, 0]/'
  rbf_inverse: bad.toml, line 6: to.position makes a size of 1e+150; it must be from 1e-100 to 1e+100, so choose other units
  $ bad '6s/.*/position = [1, 0, 0]/; 7d'
  rbf_inverse: bad.toml, line 5: to.velocity is missing
  $ bad '6s/.*/a = 1e200/'
  rbf_inverse: bad.toml, line 6: to.a makes a size of 1e+200; it must be from 1e-100 to 1e+100, so choose other units
  $ bad '7s/.*/&\nincl = 3/'
  rbf_inverse: bad.toml, line 8: to.incl: no such key; the keys are a, p, e, i, raan, argp, nu, epoch
  $ bad '7s/.*/&\ni = 400/'
  rbf_inverse: bad.toml, line 8: to.i = 400 must be from 0 to 180 degrees
  $ bad '7s/.*/&\ni = -1/'
  rbf_inverse: bad.toml, line 8: to.i = -1 must be from 0 to 180 degrees
  $ for key in raan argp nu; do bad "7s/.*/&\n$key = 1e6/"; done
  rbf_inverse: bad.toml, line 8: to.raan = 1000000 must be from -360 to 360 degrees
  rbf_inverse: bad.toml, line 8: to.argp = 1000000 must be from -360 to 360 degrees
  rbf_inverse: bad.toml, line 8: to.nu = 1000000 must be from -360 to 360 degrees
  $ bad '9s/.*/first = 6/; 10s/.*/last = 0/'
  rbf_inverse: bad.toml, line 10: departures.last = 0 is before the first, 6
  $ bad 10d
  rbf_inverse: bad.toml, line 8: departures.last is missing
  $ bad '$s/.*/&\n[other]/'
  rbf_inverse: bad.toml, line 14: other: no such key; the keys are mu, from, to, departures, arrivals, revolutions
  $ bad '1s/.*/revolutions = 1.5\n&/'
  rbf_inverse: bad.toml, line 1: revolutions = 1.5 must be a whole number from 0 to 1000
  $ bad '1s/.*/revolutions = -1\n&/'
  rbf_inverse: bad.toml, line 1: revolutions = -1 must be a whole number from 0 to 1000
