Many runs: a file of initial states
===================================

  $ integrate() { integrators integrate "$@"; }
  $ ln -s "$TESTDIR/../../chapters" chapters

A column is an unknown or a parameter; what has no column keeps the value of the equation, and a name is passed through. Rows are as
accurate as single runs: a tolerance of 1e-9 a step, some dozens of them.

  $ echo w,name,x > starts.csv
  $ seq 0 39 | awk '{printf "%.1f,\"run, %d\",%.1f\n", 1 + 0.1*$1, $1, 0.5 + $1}' >> starts.csv
  $ oscillator="x'' + w^2 x = 0; w = 1; x(0) = 1; x'(0) = 0"
  $ many() { integrators integrate --equation "$oscillator" --states starts.csv --until 3 --every 1.5 --method dop853 "$@"; }
  $ many > whole.csv
  $ sed -n '1p;5p' whole.csv | cut -d, -f 1,2,5-
  row,t,name,status
  2,0,"run, 1",success
  $ holds --each < whole.csv 'n = 120' 'k := i // 3' 'row = k + 1' 't = 1.5*(i % 3)' 'x/(0.5 + k) = cos((1 + 0.1*k)*t) +- 1e-6' \
  >   'name = f"run, {int(k)}"' 'status = "success"'

The bytes of one run, by one thread, by the row itself, and from parts cut by split:

  $ many --threads 1 | cmp - whole.csv
  $ integrate --equation "$oscillator" --set w=1.1 --initial x=1.5 --until 3 --method dop853 | tail -1 > row.txt
  $ sed -n 7p whole.csv | cut -d, -f 2-4 | cmp - row.txt
  $ tail -n +2 starts.csv > rows.csv
  $ for k in 1 2 3; do
  >   { head -n 1 starts.csv; split -n l/$k/3 rows.csv; } | integrate --equation "$oscillator" --states - --until 3 --every 1.5 --method dop853
  > done | awk -F, -v OFS=, '$1 == "row" { before = row } $1 != "row" { row = $1 += before } NR == 1 || $1 != "row"' | cmp - whole.csv

Series moves several rows at a time: each is what its own run prints, with events and ends of its own. The last row is infinite near t = 0.2:

  $ echo x,a,until > starts.csv
  $ seq 0 24 | awk '{printf "%.1f,%d,%.1f\n", 0.5 + 0.1*$1, 1 + $1%3, 1 + 0.4*$1}' >> starts.csv
  $ echo 3,-9,1 >> starts.csv
  $ cubic() { integrators integrate --equation "x'' + 0.1 x' + a x^3 = 0; a = 1; x(0) = 1; x'(0) = 0" --method series --event x=0 --no-verify "$@"; }
  $ cubic --states starts.csv --threads 1 > whole.csv
  integrators: 1 of the runs failed; the first is row 26: step_underflow: series: a step of * does not move t = 0.206304* the solution may be singular there, else loosen the tolerance, or take a longer step if it is given (glob)
  [1]
  $ cubic --states starts.csv --threads 3 2> said.txt | cmp - whole.csv
  $ tail -1 whole.csv
  26,,,,,step_underflow
  $ head -1 whole.csv > rows.csv
  $ row=0
  $ sed -n '2,26p' starts.csv | while IFS=, read -r x a until; do
  >   row=$((row + 1))
  >   cubic --initial x=$x --set a=$a --until $until | sed "1d; s/^/$row,/; s/$/,success/"
  > done >> rows.csv
  $ sed '$d' whole.csv | cmp - rows.csv

A pulse after a rest, which is met by no step that is much longer than it; its area is that of exp(-s^2) times a/2:

  $ printf 'a\n1\n2\n3\n' > starts.csv
  $ for method in series dop853; do
  >   integrate --equation "x' = a exp(-((t-50)/0.5)^2); a = 1; x(0) = 0" --states starts.csv --method $method --until 100 --largest-step 0.5 |
  >     holds --where t=100 'x = (i + 1)*sqrt(pi)/2 +- 4e-7'
  > done

Ends
----

They stand in the file or on the command line, not in both; a parameter of that name is a parameter:

  $ printf 'x,until\n1,1\n2,-1\n' > ends.csv
  $ integrate --equation "x' = -x" --initial x=1 --states ends.csv > rows.csv
  $ holds --where row=1 't = [0, 1]' 'x = [1, exp(-1)] +- 1e-8' < rows.csv
  $ holds --where row=2 't = [0, -1]' 'x = [2, 2*e] +- 1e-7' < rows.csv
  $ integrate --equation "x' = -until*x; until = 1" --initial x=1 --states ends.csv --until 3 | holds 't = 3'
  $ wrong() { refused integrators integrate --equation "x' = -x" --initial x=1 "$@"; }
  $ wrong --states ends.csv --until 2
  integrators: --until 2: ends.csv has a column until
  $ wrong --states ends.csv --every 1e-8
  integrators: ends.csv: line 2: --every 1e-08: more than 10 million rows
  $ printf 'x\n1\n2\n' > two.csv
  $ wrong --states two.csv
  integrators: two.csv: has no column until; add one, or give --until T for all rows
  $ wrong
  integrators: --until: missing; give the time at which the run ends, or t <= ... in the text

An initial state is asked for if an unknown has no column:

  $ printf 'v,x,a\n1,2,1\n0,1,3\n' > starts.csv
  $ integrate --equation "x' = -a*x; v' = 0; a = 2" --states starts.csv --until 1 | holds --where t=1 'x = [2*exp(-1), exp(-3)] +- 1e-8'
  $ printf 'x\n2\n' > starts.csv
  $ refused integrators integrate --equation "x' = -a*x; v' = 0; a = 2" --states starts.csv --until 1
  integrators: --equation:1:1: an initial value is missing: --initial x=..., v=...
    x' = -a*x; v' = 0; a = 2
    ^^

Changes of the state at the start are made in each row:

  $ printf 'x\n1\n2\n' > starts.csv
  $ integrate --equation "x' = -x" --states starts.csv --until 0.25 --event "dose: t = 0:0.5:1" --set-at "dose: x = x + 3" |
  >   holds --where t=0.25 'x = (4 + i)*exp(-0.25) +- 1e-8'

Without --method it is one for the farthest end, not for a run of no length:

  $ printf 'a,until\n1,0\n1,1000\n' > ends.csv
  $ printf 'a\n1\n' > starts.csv
  $ integrate --file chapters/integrators/examples/robertson.ode --states ends.csv | tail -1 | cut -d, -f 3 > own.txt
  $ integrate --file chapters/integrators/examples/robertson.ode --states starts.csv --until 1000 | tail -1 | cut -d, -f 3 | cmp - own.txt

Columns
-------

No column of the answer is there twice, and X is not x; a file of no rows, and one without a header:

  $ decay() { integrators integrate --equation "x' = -x" --states starts.csv --until 1; }
  $ printf 'row,"t",x,X,status,\n7,5,2,3,success,\n' > starts.csv
  $ decay > rows.csv
  $ head -2 rows.csv
  row,t,x,input_row,input_t,X,input_status,status
  1,0,2,7,5,3,success,success
  $ holds 'x = 2*exp(-1) +- 1e-8' < rows.csv
  $ echo x > starts.csv
  $ decay
  starts.csv: no row follows the header
  row,t,x,status
  $ printf '1\n2\n' > starts.csv
  $ refused integrators integrate --equation "x' = -x" --states starts.csv --until 1
  integrators: starts.csv: line 1: '1' does not name the columns; the first line must name some of x,until

Failures
--------

Each row has its own: x' = x^2 from 1 ends at t = 1, from 1/4 at 4.

  $ printf 'x,tag\n1,a\n0.25,b\n' > starts.csv
  $ integrate --equation "x' = x^2; x(0) = 1" --states starts.csv --until 2 --method ode45 > rows.csv
  integrators: 1 of the runs failed; the first is row 1: step_underflow: ode45: even the shortest step, *, from t = * misses the tolerance; the solution may be singular there, else loosen it (glob)
  [1]
  $ cut -d, -f 1,4,5 rows.csv
  row,tag,status
  1,a,step_underflow
  2,b,success
  2,b,success
  $ holds 't = 2' 'x = 0.5 +- 1e-7' < rows.csv

Where the method of all rows fails, others are tried for that row, as for a single run: here `series`, at the bottom of a tank that fills to 1:

  $ printf 'h\n1\n2\n' > starts.csv
  $ integrate --equation "h' = max(0, t - 5) - sqrt(h)" --states starts.csv --until 7 --method series 2> said.txt | cut -d, -f 1,4
  row,status
  1,non_finite
  2,non_finite
  $ integrate --equation "h' = max(0, t - 5) - sqrt(h)" --states starts.csv --until 7 | holds --where t=7 'n = 2' 'h = 1 +- 1e-6' 'status = "success"'

What is not done in time says so in its row, and runs for whose verification there is no time are no successes:

  $ { echo x; seq 0 49; } > starts.csv
  $ decay() { integrators integrate --equation "x' = -x" --initial x=1 --states starts.csv --until 2 --method ode45 "$@"; }
  $ decay --limit 1e-9 > rows.csv
  integrators: 50 of the runs failed; the first is row 1: time_limit: ode45: 0 s of wall time were used up at t = 0; allow more, or take a larger step or tolerance
  [1]
  $ holds --each 'n = 50' 'status = "time_limit"' < rows.csv
  $ { echo u; seq 1 0.01 3.99; } > starts.csv
  $ integrate --problem lorenz --states starts.csv --until 300 --method series --limit 0.05 2> said.txt > rows.csv
  [1]
  $ grep success rows.csv
  [1]

A row is verified as a single run is. Robertson's reactions by series come to 0.33687370, where four other methods agree on 0.3368745:

  $ printf 'a\n1\n' > starts.csv
  $ integrate --file chapters/integrators/examples/robertson.ode --until 1000 --method series --states starts.csv > rows.csv
  integrators: row 1: verified: 5.* digits at the end; a is off by *e-07 there, * tolerances; * (glob)
  $ holds 't = 1000' 'a = 0.3368745 +- 1e-6' < rows.csv

Mistakes
--------

  $ printf 'u,r\n1,2\n3,x\n' > bad.csv
  $ printf 'p,q\n1,2\n' > foreign.csv
  $ lorenz() { refused integrators integrate --problem lorenz --until 1 "$@"; }
  $ lorenz --states bad.csv
  integrators: bad.csv: line 3, column 2 (r): 'x' is not a finite number
  $ lorenz --states foreign.csv
  integrators: foreign.csv: none of its columns is an unknown or a parameter; choose from u, v, w, sigma, r, b
  $ lorenz --states bad.csv --plot a.svg
  integrators: --plot a.svg: runs of --states are not drawn; leave one of them out
  $ lorenz --states - < /dev/null
  integrators: standard input: is empty; the first line must name the columns some of u,v,w,sigma,r,b,until
  $ lorenz --threads 2
  integrators: --threads 2: applies to --states only; leave it out
