Integrating the problems of the library
=======================================

  $ integrators integrate --problem linear --until 0.2 --step 0.1 --every 0.1 --method rk4
  t,x,x'
  0,1,0
  0.10000000000000001,0.995004166666666*,-0.09983333333333* (glob)
  0.20000000000000001,0.980066597239583*,-0.1986691652777* (glob)
  $ ln -s "$TESTDIR/../../chapters" chapters
  $ integrate() { integrators integrate "$@"; }
  $ duffing() { integrators integrate --problem duffing "$@"; }

The motion of x'' + x + x^3 = 0 from rest at 1 is an elliptic function:

  $ X='X := ellipfun("cn", sqrt(2)*t, m=0.25)'
  $ V='V := -sqrt(2)*ellipfun("sn", sqrt(2)*t, m=0.25)*ellipfun("dn", sqrt(2)*t, m=0.25)'

Ends and rows
-------------

Without --every the first and the last row. The error is 0.1^12 in each of 200 steps, times ten for what the motion makes of them:

  $ duffing --until 20 --method radau-coll --step 0.1 > rows.csv
  $ head -2 rows.csv
  t,x,x'
  0,1,0
  $ holds 'n = 1' 't = 20' "$X" "$V" 'x = X +- 2e-9' "x' = V +- 2e-9" < rows.csv

With --every rows between, by dense output: within a step a polynomial of degree 6 through values that are right to 1e-9:

  $ duffing --until 2.25 --method radau-coll --step 0.2 --every 0.5 |
  >   holds --each 't = [0, 0.5, 1, 1.5, 2, 2.25]' "$X" "$V" 'x = X +- 1e-6' "x' = V +- 1e-6"

A distance that divides the time repeats no row, although 0.1 ten times is not 1 in binary; a distance beyond the end leaves two rows, and so
does an end that is the start:

  $ duffing --until 1 --method rk4 --step 0.3 --every 0.1 | cut -d, -f 1 | sed -n '1p;2p;$p'
  t
  0
  1
  $ duffing --until 1 --method rk4 --step 0.3 --every 0.1 | wc -l
  12
  $ duffing --until 1 --method rk4 --step 0.3 --every 7 | cut -d, -f 1
  t
  0
  1
  $ duffing --from 3 --until 3 --method rk4 --step 0.1
  t,x,x'
  3,1,0
  3,1,0

The end is from the command line, else from the text of the problem. Kepler's equation gives the end of the text's orbit; the tolerance is
1e-9, and the condition of errors of one tolerance 914 (tables/reference):

  $ integrate --problem kepler > orbit.csv
  $ head -1 orbit.csv
  t,x,y,x',y'
  $ holds 't = 16' 'E := findroot(lambda E: E - 0.7*sin(E) - 16, 16)' 'x = cos(E) - 0.7 +- 1e-6' < orbit.csv
  $ integrate --problem kepler --until 1 | holds 't = 1'
  $ integrate --equation "x' = -x; x(0) = 1; t <= 2" | holds 't = 2'
  $ refused integrators integrate --equation "x' = -x; x(0) = 1; t <= 10" --from 12
  integrators: --until: the text ends at t = 10, before the start at 12; give --until to run backwards

Backwards; 0.01^6 a unit of time, times the motion's rates. There and back, from a state with a negative component:

  $ duffing --until -5 --method rk6 --step 0.01 --every 2 > back.csv
  $ holds --each 't = [0, -2, -4, -5]' < back.csv
  $ holds "$X" "$V" 'x = X +- 1e-10' "x' = V +- 1e-10" < back.csv
  $ there=$(duffing --initial -1,-0.5 --from -1 --until 2.5 --method radau-coll --step 0.1 | tail -1 | cut -d, -f 2-)
  $ duffing --from 2.5 --until -1 --method radau-coll --step 0.1 --initial "$there" | holds 'x = -1 +- 1e-8' "x' = -0.5 +- 1e-8"

Parameters. Without hardening the oscillator is harmonic; (0.01 2)^6 is 6e-11:

  $ duffing --set hardening=0 --set natural_frequency=2 --until 3 --method rk6 --step 0.01 |
  >   holds 'x = cos(6) +- 1e-10' "x' = -2*sin(6) +- 1e-10"

Columns have the names of the problem:

  $ integrate --problem three-dof --until 1 --method rk4 --step 0.1 | sed -n 1p
  t,x1,x2,x3,x1',x2',x3'
  $ integrate --problem van-der-pol --until 1 --method ode45 | cut -d, -f 1
  t
  0
  1
  $ integrate --problem impact --until 2 --method hht --step 0.1 | cut -d, -f 1
  integrators: the equations change at t = 0.5 and 1 more time: steps end there
  t
  0
  2
  $ integrate --problem blow-up --until 0.25 --method rk6 --step 0.001 | holds 'y = sqrt(2) +- 1e-12'

Methods
-------

Every method reaches the end exactly; each here with a step at which its order leaves some digits. The error of Newmark's method, the least
accurate one of order 2, is 4e-4 at a step of 1/500 of the period (recorded: 3e-3 at t = 500); those of order 1 are three digits worse:

  $ while read -r bound method; do
  >   duffing --until 5 --method $method | holds 't = 5' "$X" "$V" "x = X +- $bound" "x' = V +- $bound"
  > done <<END
  > 1e-2 euler --step 1e-4
  > 1e-2 backward-euler --step 1e-4
  > 1e-3 explicit --step 0.01
  > 1e-7 rk4 --step 0.01
  > 1e-9 rk6 --step 0.02
  > 1e-6 ode45 --tolerance 1e-9
  > 1e-3 newmark --step 0.01
  > 1e-3 hht --step 0.01
  > 1e-3 generalized-alpha --step 0.01
  > 1e-5 mcpi --step 0.5
  > 1e-5 rbf-coll --step 0.4768 --shape 0.77
  > 1e-6 lgl-coll --step 0.2
  > 1e-6 radau-coll --step 0.5
  > END

The digits of the test set for stiff problems. The second species is 8e-14, so that it needs an absolute tolerance of its own; asked are two
digits less than the tolerance has:

  $ integrate --problem robertson --until 1e11 --method adaptive-collocation --tolerance 1e-9 --absolute-tolerance 1e-17 |
  >   holds 'y1/0.2083340149701255e-7 = 1 +- 1e-7' 'y2/0.8333360770334713e-13 = 1 +- 1e-7' 'y3/0.9999999791665050 = 1 +- 1e-7'

Laier's operator has a phase error of z^4/720 a radian, Newmark's of z^2/12:

  $ integrate --problem linear --until 2 --step 0.1 --every 0.5 --method laier |
  >   holds --each 't = [0, 0.5, 1, 1.5, 2]' 'x = cos(t) +- 2e-4/720' "x' = -sin(t) +- 2e-4/720"
  $ integrate --problem linear --until 2 --step 0.1 --method newmark | holds 'x = cos(2) + sin(2)*2*0.01/12 +- 1e-5'

All Hermitian operators on all of Laier's problems, order 4 closely and order 2 roughly:

  $ while read -r problem; do
  >   integrate --problem $problem --tolerance 1e-10 --method laier > exact.csv
  >   head -1 exact.csv
  >   while read -r method bound; do
  >     integrate --problem $problem --step 0.01 --method $method < /dev/null | holds --like exact.csv $bound
  >   done <<METHODS
  > laier 1e-7
  > argyris 1e-7
  > newmark 2e-3
  > hoff 2e-3
  > bazzi 2e-3
  > METHODS
  > done <<END
  > laier-duffing --until 10
  > laier-duffing --set damping=0 --set force=0 --initial 1,0 --until 5
  > laier-van-der-pol --until 5
  > laier-van-der-pol --set mu=3 --initial 2,0 --until 2
  > two-dof --until 10
  > END
  t,x,x'
  t,x,x'
  integrators: verified: 6.* digits at the end; x' is off by *e-08 there, * tolerances; the problem multiplies errors by up to 66* (glob)
  t,x,x'
  t,x,x'
  t,x1,x2,x1',x2'

The transversal method is exact for linear problems, whatever the step; two masses move as one with cos(sqrt(1.5) t) for k = 1.5
without the cubic terms:

  $ mtl() { integrators integrate --method mtl --problem "$@"; }
# oracle: transversal_motions driven Duffing *, van der Pol *
  $ mtl driven-duffing --until 50 --step 0.005 --points 5 | holds 't = 50' 'x = 1.203734404401093 +- 1e-9'
  $ mtl van-der-pol --until 40 --step 0.002 | holds 't = 40' 'x = 1.872808279858090 +- 1e-6'
  $ mtl linear --until 30 --step 3 --points 2 | holds 't = 30' 'x = cos(30) +- 1e-13'
  $ mtl linear --until 1 --step 0.4 --points 2 --every 0.25 | holds --each 't = [0, 0.25, 0.5, 0.75, 1]' 'x = cos(t) +- 1e-14'
  $ mtl two-dof --set damping=0 --set hardening=0 --set force=0 --set stiffness=1.5 --initial 1,1,0,0 --until 4 --step 0.5 --points 8 |
  >   holds 't = 4' 'x1 = cos(sqrt(1.5)*4) +- 1e-13'

Taylor series; the bounds leave what each motion amplifies:

  $ series() { integrators integrate --method series --problem "$@"; }
# oracle: algebraic_series_motions Lorenz u(20), Duffing u(50), oscillator x, projectile x, projectile lands at, bodies y of 4
  $ series lorenz --until 20 --tolerance 1e-14 | holds 't = 20' 'u = -1.356348984580380 +- 1e-5'
  integrators: verified: 10.* digits at the end; u is off by *e-11 there, * tolerances; the problem multiplies errors by up to 2*e+03 (glob)
  $ series forced-duffing --until 50 | holds 't = 50' 'u = 1.221946638567542 +- 1e-6'
  $ series oscillator --until 378.14159265358979 | holds 't = 378.14159265358979' 'x = -0.302938936512582 +- 1e-6'
  integrators: verified: 5.* digits at the end; x is off by *e-07 there, * tolerances; the problem multiplies errors by up to 2.7e+03 (glob)
  $ series projectile --until 9.84601516944855 | holds 't = 9.84601516944855' 'x = 38476.6981780052 +- 1e-4'
  $ series bodies --until 3000 --tolerance 1e-13 | holds 't = 3000' 'y4 = 3.071464269641001 +- 1e-6'
  $ series bodies --until 1 | sed -n 1p
  integrators: z1, z2, z3, z1', z2', z3' stay below the absolute tolerance 1e-09: none of their digits is certain; take a smaller --absolute-tolerance
  t,x1,y1,z1,x2,y2,z2,x3,y3,z3,x4,y4,z4,x1',y1',z1',x2',y2',z2',x3',y3',z3',x4',y4',z4'

With the published step and order, 20, Lorenz's end is another one than that of the solution:

# oracle: algebraic_series_motions Lorenz T = 0.1: u(20)
  $ series lorenz --until 20 --step 0.1 --order 20 > published.csv
  $ holds 'u = -4.78 +- 0.005' < published.csv
  $ series lorenz --until 20 --step 0.1 | cmp - published.csv

The energy u'^2/2 + u^4/4 stays:

  $ series forced-duffing --set damping=0 --set force=0 --initial 1,0 --until 1 --every 0.25 |
  >   holds --each 't = [0, 0.25, 0.5, 0.75, 1]' "u'^2/2 + u^4/4 = 0.25 +- 1e-8"

Failures
--------

They end with 1, print nothing, and say the method, where it stopped and what to change:

  $ integrate --problem blow-up --until 1 --method rk4 --step 0.01 --every 0.1
  integrators: non_finite: rk4: the step of 0.01 from t = 0.5* leads to a state that is not finite; the solution may blow up there, else take a smaller step or tolerance (glob)
  [1]
  $ duffing --until 1e6 --method euler --step 1e-6 --limit 0.05
  integrators: time_limit: * (glob)
  [1]
  $ integrate --problem laier-van-der-pol --set mu=1000 --initial 2,0 --until 2000 --step 0.125 --method laier
  integrators: wrong_branch: laier: Newton's iteration of the step of 0.125 from t = 807* converged, but the error estimate is * of the displacement: its root need not continue the solution; take a smaller step, or a tolerance instead (glob)
  [1]
  $ mtl van-der-pol --set mu=1000 --until 10 --step 1
  integrators: non_finite: mtl: the exponential of the linear part overflows over 3 steps of 1 from t = 0; take a smaller step or tolerance (a program can choose another linear part)
  [1]
  $ series forced-duffing --until 100 --step 0.7 --order 80
  integrators: non_finite: series: the Taylor coefficients to order 80 at t = * are not finite; the solution may be singular there, else take a lower order, or a smaller step or tolerance (glob)
  [1]

A run has to keep what the text of the equation says is conserved, and to stay in its bounds:

  $ kept() { integrators integrate --equation "$@" > /dev/null; }
  $ kept "x'' = -x; x(0) = 1; x'(0) = 0; t <= 9; conserved x^2 + x'^2"
  $ kept "x' = -x; x(0) = 1; t <= 1; conserved x"
  integrators: spurious_root: series: quantity 1 that this problem conserves is 0.3678794412 at t = 1 and was 1 at the start, and the tolerances do not explain it; take smaller tolerances, if it is conserved
  [1]
  $ kept "x' = -1; x(0) = 1; t <= 2; x >= 0"
  integrators: spurious_root: series: component 1 of the state is -1 at t = 2, but solutions of this problem stay above 0, and the tolerances do not explain it; take a smaller absolute tolerance, well below that component
  [1]
  $ kept "x' = -x; x(0) = 1; t <= 1; conserved x; conserved 1/(1 - x)"
  integrators: spurious_root: series: quantity 1 that this problem conserves is 0.3678794412 at t = 1 and was 1 at the start, and the tolerances do not explain it; take smaller tolerances, if it is conserved
  [1]

Where the right-hand side switches too, and with trial steps that cross a bound before an event or a stiff spring ends them:

  $ kept "x'' = -sign(x) - 1e-3 x'; x(0) = 1; x'(0) = 0; t <= 20; conserved x'^2/2 + abs(x)"
  integrators: spurious_root: series: quantity 1 that this problem conserves is 0.98692* at t = 20 and was 1 at the start, and the tolerances do not explain it; take smaller tolerances, if it is conserved (glob)
  [1]
  $ kept "x'' = -sign(x); x(0) = 1; x'(0) = 0; t <= 20; conserved x'^2/2 + abs(x)"
  $ kept "h'' = -9.81; h(0) = 1; h'(0) = 0; h >= 0; t <= 2" --event "h = 0 falling end"
  $ kept "x'' = -1 + 100 max(0,0.2-x); x(0) = 1; x'(0) = 0; t <= 5; x >= 0"

The help of both commands names problems, their parameters, and methods:

  $ for command in integrate compare; do
  >   integrators $command --help | grep -c -e '^  kepler: ' -e '^  arenstorf: ' -e '^  spring-pendulum: '
  >   for word in three-dof hardening=1 van-der-pol radau-coll gsl-rk8pd --tolerance "x'' = mu ((1 - x^2) x') - x"; do
  >     integrators $command --help | grep -q -F -e "$word" || echo "$command: no $word"
  >   done
  > done
  3
  3
