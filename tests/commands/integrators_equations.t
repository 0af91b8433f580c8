Integrating an equation as one types it
=======================================

  $ integrate() { integrators integrate --equation "$@"; }

Columns have the names of the equation, here in the order of --initial. The tolerance is 1e-9, here over two units of time:

  $ integrate "x'' = -x; y' = x" --initial "x=1, x'=0, y=0" --until 2 > rows.csv
  $ head -2 rows.csv
  t,x,x',y
  0,1,0,0
  $ holds 'x = cos(2) +- 4e-9' 'y = sin(2) +- 4e-9' "x' = -sin(2) +- 4e-9" < rows.csv

Definitions can be set anew, and initial values be expressions of them:

  $ decay() { integrate "x' = -a x; a = 3; x(0) = 1" --until 1 "$@"; }
  $ decay | holds 'x = exp(-3) +- 2e-9'
  $ decay --set a=1 | holds 'x = exp(-1) +- 2e-9'
  $ decay --initial 'x=2 a' | holds 'x = 6*exp(-3) +- 6e-9'
  $ decay --initial 2 | holds 'x = 2*exp(-3) +- 2e-9'

sqrt(1 - t) ends at t = 1, and the first trial step at this tolerance crosses it. The time is that of the run, to its tolerance:

  $ for method in series ode45; do
  >   integrate "y' = -1/(2 y)" --initial 1 --until 2 --tolerance 1e-3 --method $method || echo "exit code $?"
  > done
  integrators: outside_validity: a denominator of the equations becomes zero at t = 1.00*: the solution ends there; end the run before (glob)
  exit code 1
  integrators: outside_validity: a denominator of the equations becomes zero at t = 1.00 +- 0.0?: the solution ends there; end the run before (glob)
  exit code 1

Discontinuities
---------------

x'' + x + mu sign(x' - V) = 0 sticks at x' = V until x = mu, and then slips: x = mu + V sin(t - mu/V):

  $ friction="x'' + x + mu sign(x' - V) = 0; mu = 0.6; V = 0.5; x(0) = 0; x'(0) = 0.5"
  $ for method in series ode45 adaptive-collocation; do
  >   integrate "$friction" --tolerance 1e-12 --until 1 --method $method | holds 'n = 1' 'x = 0.5 +- 1e-11' "x' = 0.5 +- 1e-11"
  >   integrate "$friction" --tolerance 1e-12 --until 3 --method $method | holds 'x = 0.6 + 0.5*sin(3 - 1.2) +- 1e-8'
  > done

x'' = -sign(x) moves on arcs of parabolas with a period of 4 sqrt(2 x0), here three of them:

  $ integrate "x'' = -sign(x); x(0) = 0.5; x'(0) = 0" --until 12 --tolerance 1e-13 | holds 'x = 0.5 +- 1e-11' "x' = 0 +- 1e-11"

The example of the chapter's page, a pendulum of amplitude 1, against another method:

  $ integrators_example | sed 's/success: a = \([^,]*\),.*/a\n\1/' > example.csv
  $ integrate "a'' + (g/l) sin(a) = 0; g = 9.81; l = 2; a(0) = 1; a'(0) = 0" --until 10 --tolerance 1e-13 --method adaptive-collocation |
  >   cut -d, -f 2 | holds --like example.csv 2e-11
