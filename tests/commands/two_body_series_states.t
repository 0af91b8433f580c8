Many orbits: a file of initial states
=====================================

test_orbits.py compares rows with Kepler's problem.

  $ propagate() { two_body_series propagate --states "$@"; }

Ellipses about mu = 1, with a name that has a comma, columns in an order of their own, and a comment:

  $ ellipses() {
  >   printf '# a comment\n\nname,vx,vy,vz,until,x,y,z,mu\n\n'
  >   seq 0 $(($1 - 1)) | awk -v n=$1 '{e = 0.8*$1/n; printf "\"body, %d\",0,%.17g,0,%.17g,%.17g,0,0,1\n", $1, sqrt((1 + e)/(1 - e)), 20 + 0.01*$1, 1 - e}'
  > }

The bytes of one run, with any number of threads:

  $ ellipses 300 | sed '/^#/d; /^$/d' > orbits.csv
  $ for words in "" "--every 3" "--zonal 1e-3 --radius 0.1" "--method kepler"; do
  >   propagate orbits.csv $words > whole.csv
  >   propagate orbits.csv $words --threads 3 | cmp - whole.csv
  > done

Parts, cut by split or by GNU parallel, have their own row numbers; with continued ones they are the bytes of one run:

  $ join_rows() { awk -F, -v OFS=, '$1 == "row" { before = row } $1 != "row" { row = $1 += before } NR == 1 || $1 != "row"' "$@"; }
  $ tail -n +2 orbits.csv > rows.csv
  $ for words in "" "--every 3" "--zonal 1e-3 --radius 0.1" "--method kepler"; do
  >   propagate orbits.csv $words > whole.csv
  >   for k in $(seq 7); do
  >     { head -n 1 orbits.csv; split -n l/$k/7 rows.csv; } | propagate - $words > part-$k.csv
  >   done
  >   join_rows part-*.csv | cmp - whole.csv
  >   parallel --keep-order --pipe --header : --block 10k "two_body_series propagate --states - $words" < orbits.csv 2> said.txt |
  >     join_rows | cmp - whole.csv
  > done

--every gives rows between, here of a circle backwards, for each method:

  $ printf 'x,y,z,vx,vy,vz\n1,0,0,0,1,0\n1,0,0,0,1.2,0\n' > circle.csv
  $ for method in series kepler; do
  >   propagate circle.csv --mu 1 --until -5 --every 2 --method $method > rows.csv
  >   holds --where row=1 't = [0, -2, -4, -5]' 'x = cos(t) +- 1e-13' 'y = sin(t) +- 1e-13' < rows.csv
  >   holds --where row=2 'n = 4' < rows.csv
  > done

The answer is a file of states itself: its columns come back once, those of the first run under other names. A header may be missing, and
rows too:

  $ printf 'X,Y,Z,VX,VY,VZ,\n1,0,0,0,1,0,\n' > orbit.csv
  $ propagate orbit.csv --mu 1 --until 1 > first.csv
  $ head -1 first.csv
  row,t,x,y,z,vx,vy,vz,status
  $ propagate first.csv --mu 1 --until 1 > second.csv
  $ head -1 second.csv
  row,t,x,y,z,vx,vy,vz,input_row,input_t,input_status,status
  $ holds 'input_row = 1' 'x = cos(2) +- 1e-13' < second.csv
  $ echo 1,0,0,0,1,0 > orbit.csv
  $ propagate orbit.csv --mu 1 --until 1 | cmp - first.csv
  $ echo x,y,z,vx,vy,vz > orbit.csv
  $ propagate orbit.csv --mu 1 --until 1
  orbit.csv: no row follows the header
  row,t,x,y,z,vx,vy,vz,status

Elements
--------

Of each state, in order; here of ellipses at their periapsis, with a = 1 and e = 0, 0.16, ...

  $ ellipses 5 | two_body_series elements --states - > elements.csv
  $ head -1 elements.csv
  row,a,e,i,raan,argp,nu,period,p,q,eccentric_anomaly,mean_anomaly,time_since_periapsis,name,until,status
  $ holds --each 'n = 5' 'a = 1 +- 1e-15' 'e = 0.16*(row - 1) +- 1e-15' 'q = 1 - e +- 1e-15' 'nu = 0' 'status = "success"' < elements.csv

From a mean anomaly and back, for an ellipse, a hyperbola and a parabola, where its limit is 0:

  $ state() { two_body_series state "$@" | tail -1; }
  $ { state --a 7e6 --e 0.3 --mean-anomaly -40; state --a -7e6 --e 1.5 --mean-anomaly 200; state --q 7e6 --e 1 --time-since-periapsis 900; } > conics.csv
  $ two_body_series elements --states conics.csv | cut -d, -f 12,13 | holds --each 'mean_anomaly = [-40, 200, 0] +- 1e-11'
  $ two_body_series elements --states conics.csv | holds 'time_since_periapsis = 900 +- 1e-11' 'e = 1 +- 1e-14'

A state without elements, on a line through the centre, has empty cells; the others have theirs:

  $ printf 'x,y,z,vx,vy,vz\n1,0,0,1,0,0\n1,0,0,0,1,0\n' | two_body_series elements --states - --mu 1 | cut -d, -f 1-4,14
  two_body_series: 1 of the states have no elements; the first is row 1: elements_of: the body moves on a straight line through the centre, which has no classical elements
  row,a,e,i,status
  1,,,,outside_validity
  2,1,0,0,success
  $ printf 'x,y,z,vx,vy,vz,mu\n1,0,0,1,0,0,1\n' | two_body_series elements --states - > lines.csv
  two_body_series: 1 of the states have no elements; * (glob)
  [1]
  $ printf 'x,y,z,vx,vy,vz\n0,0,0,1,0,0\n' | refused two_body_series elements --states -
  two_body_series: standard input: line 2: x,y,z = 0,0,0 is the centre of attraction

Failures
--------

A fall into the centre ends where it does, at pi/sqrt(8), and the rest goes on:

  $ printf 'x,y,z,vx,vy,vz\n1,0,0,0,1,0\n1,0,0,0,0,0\n1,0,0,0,1.1,0\n' > fall.csv
  $ propagate fall.csv --mu 1 --until 5 > whole.csv
  two_body_series: 1 of the orbits failed; the first is row 2: collision: taylor-ensemble: the body falls into the centre of attraction at t = 1.11072*; Kepler's solution (method kepler) goes through, a series cannot (glob)
  [1]
  $ cut -d, -f 1,9 whole.csv
  row,status
  1,success
  2,collision
  3,success
  $ holds --where row=2 't = pi/sqrt(8) +- 1e-6' < whole.csv

Rows of few digits say so: of the data after 1e5 revolutions and more, of steps that are too long, which Kepler's solution tells:

  $ printf 'x,y,z,vx,vy,vz\n1,0,0,0,1.1,0\n1,0,0,0,1.2,0.1\n' > orbits.csv
  $ status() { two_body_series propagate --states orbits.csv --mu 1 "$@" > rows.csv || echo "exit code $?"; cut -d, -f 9 rows.csv; }
  $ status --until 1e12 --method kepler
  two_body_series: 2 of the orbits have rows with the status low_accuracy; the first is row 1: the data, rounded to doubles, determine the position at t = 1e+12 to * of the distance (glob)
  status
  low_accuracy
  low_accuracy
  $ status --until 30 --tolerance 1e-4
  two_body_series: 2 of the orbits have rows with the status low_accuracy; the first is row 1: the position at t = 30 differs from Kepler's solution by * of the distance: the tolerance 0.0001 of a step is too large for it; take a smaller one, or --method kepler (glob)
  status
  low_accuracy
  low_accuracy
  $ status --until 300 --tolerance 0.1
  two_body_series: 2 of the orbits failed; the first is row 1: outside_validity: series: the position at t = 300 differs from Kepler's solution by * of the distance: the tolerance 0.1 of a step is too large for it; take a smaller one, or --method kepler (glob)
  exit code 1
  status
  outside_validity
  outside_validity
  $ status --until 30
  status
  success
  success

So many revolutions that no digit is left end the closed form, at the last row that had one:

  $ printf 'x,y,z,vx,vy,vz\n1,0,0,0,1,0\n' > circle.csv
  $ for sign in '' -; do
  >   propagate circle.csv --mu 1 --until ${sign}1e14 --every 1e12 --method kepler 2> said.txt > rows.csv || echo "exit code $?"
  >   tail -2 rows.csv | cut -d, -f 9
  >   tail -2 rows.csv | cut -d, -f 1-8 | uniq | wc -l
  >   holds 'abs(t) > 1e12' < rows.csv
  >   [ $(wc -l < rows.csv) -lt 90 ]
  > done
  exit code 1
  low_accuracy
  outside_validity
  1
  exit code 1
  low_accuracy
  outside_validity
  1

What is not done in time says so in its row; a file has no limit by default:

  $ ellipses 2000 > orbits.csv
  $ for method in series kepler; do
  >   propagate orbits.csv --method $method --limit 1e-9 > rows.csv
  >   holds --each 'n = 2000' 'status = "time_limit"' < rows.csv
  > done
  two_body_series: 2000 of the orbits failed; the first is row 1: time_limit: taylor-ensemble: 0 seconds were used up; allow more
  two_body_series: 2000 of the orbits failed; the first is row 1: time_limit: kepler: 1e-09 seconds were used up; allow more
  $ { echo x,y,z,vx,vy,vz; yes 1,0,0,0,1.1,0.1 | head -400; } > forever.csv
  $ propagate forever.csv --mu 1 --until 1e9 --zonal 1e-3 --radius 0.1 --limit 0.3 --threads 1 2> said.txt > rows.csv
  [1]
  $ holds --each 'n = 400' 'status = "time_limit"' < rows.csv
  $ two_body_series propagate --help | grep -c 'none with'
  1

Mistakes
--------

Nothing is printed of a file with a mistake, wherever it stands:

  $ bad() { cat > bad.csv; refused two_body_series propagate --states bad.csv --mu 1 "$@"; }
  $ head=x,y,z,vx,vy,vz,until
  $ row=1,0,0,0,1,0,5
  $ { echo $head; yes $row | head -20000; echo 1,0,0,0,one,0,5; } | bad
  two_body_series: bad.csv: line 20002, column 5 (vy): 'one' is not a finite number
  $ printf "$head\n$row\n0,0,0,0,1,0,5\n" | bad
  two_body_series: bad.csv: line 3: x,y,z = 0,0,0 is the centre of attraction
  $ printf "$head\n1,0,0,0,inf,0,5\n" | bad
  two_body_series: bad.csv: line 2, column 5 (vy): 'inf' is not a finite number
  $ printf "$head\n1,0,0,0,1,0\n" | bad
  two_body_series: bad.csv: line 2: 6 of 7 cells
  $ printf "$head\n1,0,0,0,1,0,5,7\n" | bad
  two_body_series: bad.csv: line 2, column 8: '7' is beyond the 7 columns x,y,z,vx,vy,vz,until
  $ printf "x,y,z,vx,vy,until\n$row\n" | bad
  two_body_series: bad.csv: line 1: there is no column vz; the header must name x,y,z,vx,vy,vz, separated by commas, and is 'x,y,z,vx,vy,until'
  $ printf 'JDTDB;X;Y;Z;VX;VY;VZ\n1;1;0;0;0;1;0\n' | bad
  two_body_series: bad.csv: line 1: there is no column x; the header must name x,y,z,vx,vy,vz, separated by commas, and is 'JDTDB;X;Y;Z;VX;VY;VZ'; separate cells by commas and write numbers with a decimal point
  $ echo $row | bad
  two_body_series: bad.csv: line 1: '1,0,0,0,1,0,5' does not name the columns; the first line must name x,y,z,vx,vy,vz
  $ echo x,y,z,vx,vy,vz,x,until | bad
  two_body_series: bad.csv: line 1: two columns are called x: 'x,y,z,vx,vy,vz,x,until'
  $ printf '' | bad
  two_body_series: bad.csv: is empty; the first line must name the columns x,y,z,vx,vy,vz
  $ printf "name,$head\na,$row\n# a comment, late\n" | bad
  two_body_series: bad.csv: line 3, column 2 (x): 'late' is not a finite number; put comments before the header
  $ printf 'x,y,z,vx,vy,vz\n1,0,0,0,1,0\n' | bad
  two_body_series: bad.csv: has no column until; add the column, or give --until T for all rows
  $ printf "$head\n$row\n" | bad --until 3
  two_body_series: --until 3: bad.csv has a column until; leave out one of the two
  $ printf "$head\n$row\n" | bad --every 1e-9
  two_body_series: bad.csv: line 2: until = 5: more than 10 million rows at --every 1e-09
  $ printf "$head\n\"1,0,0\n" | bad
  two_body_series: bad.csv: line 2: a quote is never closed
  $ head -c 3145728 /dev/zero | tr '\0' x | bad
  two_body_series: bad.csv: line 1: more than 1048576 bytes; a line of a table is shorter
  $ printf "$head\n7000,0,0,0,7.5,0,5\n" > km.csv
  $ refused two_body_series propagate --states km.csv
  two_body_series: km.csv: line 2: x,y,z = 7000,0,0: without --mu lengths are metres about the Earth, and this orbit stays within 7000 m of its centre; give --mu in your units (398600.4418 for kilometres and seconds)
  $ printf "$head,mu\n$row,0\n" > mu.csv
  $ refused two_body_series propagate --states mu.csv
  two_body_series: mu.csv: line 2: mu = 0: must be positive
  $ refused two_body_series propagate --states none.csv
  two_body_series: none.csv: No such file or directory
  $ refused two_body_series propagate --position 1,0,0 --velocity 0,1,0 --until 1 --threads 2
  two_body_series: --threads 2: needs --states
  $ printf "$head\n$row\n" > good.csv
  $ good() { refused two_body_series propagate --states good.csv --mu 1 "$@"; }
  $ good --position 1,0,0
  two_body_series: --position 1,0,0: --states good.csv contains the states; give only one of the two
  $ good --events nodes
  two_body_series: --events nodes: needs one --position; --states takes --every
  $ good --at 1,2
  two_body_series: --at 1,2: needs one --position; --states takes --every
  $ refused two_body_series elements --states good.csv --velocity 1,0,0
  two_body_series: --velocity 1,0,0: --states good.csv contains the states; give only one of the two
  $ good --method rkn1210
  two_body_series: --method rkn1210: --states takes series or kepler; rkn1210 takes one --position
  $ good --method kepler --zonal 1e-3 --radius 1
  two_body_series: --zonal 0.001: --method kepler is for a point mass; use series or rkn1210
  $ good --threads 0
  two_body_series: --threads 0: must be a whole number from 1 to 1024
