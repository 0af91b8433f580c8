Where equations end, rest, or begin at a singular point
=======================================================

  $ integrate() { integrators integrate --equation "$@"; }

Singular points at the start
----------------------------

A power series begins these solutions; then every method goes on. sin(t)/t, Bessel's J0, and Lane and Emden's star of index 5, 1/sqrt(1 + t^2/3):

  $ for method in series dop853 ode45 adaptive-collocation; do
  >   integrate "x'' + 2 x'/t + x = 0" --initial "x=1, x'=0" --until 10 --method $method |
  >     holds 'x = sin(10)/10 +- 1e-8' "x' = cos(10)/10 - sin(10)/100 +- 1e-8"
  >   integrate "t x'' + x' + t x = 0" --initial "x=1, x'=0" --until 10 --method $method | holds 'x = besselj(0, 10) +- 1e-8'
  >   integrate "x'' + 2 x'/t + x^5 = 0" --initial "x=1, x'=0" --until 10 --method $method | holds 'x = 1/sqrt(1 + 100/3) +- 1e-8'
  > done
  $ integrate "x'' + 2 x'/t + x = 0" --initial "x=1, x'=0" --until 1 --every 0.01 | holds --each 'n = 101' 'x = (sin(t)/t if t > 0 else 1) +- 1e-9'
  $ integrate "x'' + 2 x'/t + x = 0" --initial "x=1, x'=0" --until -10 | holds 'x = sin(10)/10 +- 1e-8'
  $ integrate "x' = sin(t)/t" --initial x=0 --until 1 | holds 'x = si(1) +- 1e-9'

Where no series begins, the reason:

  $ integrate "x'' + 2 x'/t + x = 0" --initial "x=1, x'=1" --until 1
  integrators: outside_validity: the equations are singular at the start t = 0, where a denominator is zero: these initial values have no smooth solution: the numerator must be zero there too (x' = 0 in x'' + 2 x'/t = 0)
  [1]
  $ integrate "x' = x/t" --initial x=0 --until 1
  integrators: outside_validity: the equations are singular at the start t = 0, where a denominator is zero: these initial values have several solutions; start at another time
  [1]
  $ integrate "x' = x/t^2" --initial x=0 --until 1
  integrators: outside_validity: the equations are singular at the start t = 0, where a denominator is zero: the equations of first order grow faster than the reciprocal of the distance from it, for which no power series is implemented; start at another time
  [1]

Denominators that become zero
-----------------------------

C sin(t) for every C beyond pi; but sin(t)/t is regular at 0, and a run may end at the point or before it:

  $ for method in series ode45 "rk4 --step 0.01"; do
  >   integrate "sin(t) x' = cos(t) x" --from 1 --initial x=1 --until 4 --method $method
  > done
  integrators: outside_validity: a denominator of the equations becomes zero at t = 3.14159265: the solution beyond is not unique; end the run before
  integrators: outside_validity: a denominator of the equations becomes zero at t = 3.14159265: the solution beyond is not unique; end the run before
  integrators: outside_validity: a denominator of the equations becomes zero at t = 3.14159265: the solution beyond is not unique; end the run before
  [1]
  $ for method in series dop853 ode45; do
  >   integrate "x' = 1; y' = y/x" --initial "x=-1, y=1" --until 2 --method $method 2> said.txt; grep -c 't = 1.0* +- .*: the solution beyond' said.txt
  >   integrate "x'' = -x; y' = x'/x*y" --initial "x=1, x'=0, y=1" --until 3 --method $method 2> said.txt; grep -c 't = 1.5707963.*: the solution beyond' said.txt
  > done | sort | uniq -c | tr -s ' '
   6 1
  $ integrate "x'' = -x; y' = sin(x)/x" --initial "x=1, x'=0, y=0" --until 3 | holds 'y = quad(lambda s: sin(cos(s))/cos(s), [0, 3]) +- 1e-8'
  $ integrate "sin(t) x' = cos(t) x" --from 1 --initial x=1 --until 3 | holds 'x = sin(3)/sin(1) +- 1e-8'
  $ integrate "x' = sin(t)/t" --from -1 --initial x=0 --until 1 | holds 'x = 2*si(1) +- 1e-8'

The solution ends where it becomes infinite, or its slope does; here sqrt(1 - 2 t):

  $ integrate "x' = 1/(t - 1)" --initial x=1 --until 3 --method rk4 --step 0.3
  integrators: outside_validity: a denominator of the equations becomes zero at t = 1: the solution ends there; end the run before
  [1]
  $ integrate "x' = -1/x" --initial x=1 --until 4 --method ode45
  integrators: outside_validity: a denominator of the equations, or the argument of a logarithm, becomes zero at t = 0.5* +- *, where the solution ends; end the run before (glob)
  [1]

Denominators that touch zero without a change of their sign: y = C x beyond x = 0, a regular quotient, and ends at 1/3, pi/2 and e E1(1):

  $ for method in series dop853 ode45 adaptive-collocation; do
  >   integrate "x' = 1; y' = x*y/x^2" --initial "x=-1, y=1" --until 2 --method $method 2> said.txt; grep -c 't = 1.0* +- .*: the solution beyond' said.txt
  >   integrate "x' = 1; y' = x sin(x)/x^2" --initial "x=-1, y=0" --until 2 --method $method | holds 'y = 2*si(1) +- 1e-7'
  > done | sort | uniq -c | tr -s ' '
   4 1
  $ for equation in "x' = 1/(x - 1)^2; x(0) = 0" "x' = tan(t); x(0) = 0" "x' = log(x) - 1; x(0) = 1"; do integrate "$equation" --until 3; done
  integrators: outside_validity: * becomes zero at t = 0.333333* +- *, where the solution ends; end the run before (glob)
  integrators: outside_validity: * becomes zero at t = 1.57079633* (glob)
  integrators: outside_validity: * becomes zero at t = 0.5963473* +- *, where the solution ends; end the run before (glob)
  [1]

Denominators that are sums: two bodies that fall towards each other meet at pi/(2 sqrt(2)) and r = 1 - t in the plane at 1; the run names
time and place by every method, and integrates near misses:

  $ fall="x'' = -x/(x^2 + y^2)^1.5; y'' = -y/(x^2 + y^2)^1.5"
  $ for method in "" "--method series" "--method ode45" "--method dop853 --tolerance 1e-4" "--method adaptive-collocation"; do
  >   integrate "$fall" --initial "x=1, x'=0, y=0, y'=0" --until 3 $method 2> said.txt; grep -c 't = 1.11[01].*, x = 0, y = 0, where' said.txt
  >   integrate "x' = -x/sqrt(x^2 + y^2); y' = -y/sqrt(x^2 + y^2)" --initial "x=0.6, y=0.8" --until 3 $method 2> said.txt; grep -c 't = \(1\.\|0\.99\|1 \)' said.txt
  > done | sort | uniq -c | tr -s ' '
   10 1
  $ integrate "$fall" --initial "x=1, x'=0, y=0, y'=0" --until 3 --method rk4 --step 0.01
  integrators: outside_validity: a denominator of the equations becomes zero at t = 1.1*: the solution ends there; end the run before (glob)
  [1]
  $ integrate "$fall" --initial "x=1, x'=0, y=0, y'=0.01" --until "2*pi/(2 - 0.01^2)^1.5" 2> said.txt | holds 'x = 1 +- 1e-5' 'y = 0 +- 1e-5'

With every bound on the steps:

  $ for step in 0.0390625 0.1 0.5 2; do integrate "x' = x/(t - 2)" --initial x=1 --until 5 --largest-step $step --method dop853; done 2>&1 | grep -c 't = 2: '
  4

Roots
-----

A tank from 1 is (1 - t/2)^2 until it is empty at 2, and stays empty, at every tolerance:

  $ for tolerance in 1e-3 1e-6 1e-9 1e-12; do
  >   integrate "h' = -sqrt(h)" --initial h=1 --until 3 --every 1 --tolerance $tolerance | holds --each "h = max(1 - t/2, 0)**2 +- 20*$tolerance"
  > done

With an inflow it fills again, here to (t - 5)^2/4, or has a level that is never empty:

  $ integrate "h' = max(0, t - 5) - sqrt(h)" --initial h=1 --until 7 | holds 'h = 1 +- 1e-6'
  integrators: the equations change at t = 5: steps end there
  $ integrate "h' = 0.5 - sqrt(h)" --initial h=1 --until 60 | holds 'h = 0.25 +- 1e-8'

An argument that touches zero, 1 - sin(t)^2, and one that would become negative:

  $ integrate "x' = cos(t); y' = sqrt(1 - x^2)" --initial "x=0, y=0" --until 3 | holds 'y = 2 - sin(3) +- 1e-6'
  $ integrate "y' = sqrt(1 - x); x' = 1" --initial "x=0, y=0" --until 3
  integrators: outside_validity: the argument of a square root, a power with a fraction, an arc or a logarithm leaves its domain at t = 1.00000000 +- 4e-08, and the equations do not define the solution beyond; end the run before
  [1]

One that is outside of it at the start is named, unless the equations are defined there all the same, as 1/log(0) = 0 is:

  $ for f in "log(t)" "sqrt(x - 1)" "x^-0.5"; do integrate "x' = $f" --initial x=0 --until 1; done 2>&1 | grep -o 'logarithm, or a denominator, is [-0-9]* at the start t = 0,'
  logarithm, or a denominator, is 0 at the start t = 0,
  logarithm, or a denominator, is -1 at the start t = 0,
  logarithm, or a denominator, is 0 at the start t = 0,

One that leaves its domain in time, or at the end of a run: asin(t), sqrt(sin(t)), asin(x) + 1 from 0, which is 1 at the integral of 1/(1 + asin(x)):

  $ for f in "asin(t)" "log(1 - t)" "x*(1 - t)^1.5" "sqrt(sin(t))" "1/log(t)"; do integrate "x' = $f" --initial x=0 --until 4; done 2>&1 | grep -o 'leaves its domain at t = [^,]*\|becomes zero at t = [^,]*'
  leaves its domain at t = 1
  leaves its domain at t = 1
  leaves its domain at t = 1
  leaves its domain at t = 3.14159265
  becomes zero at t = 1
  $ integrate "x' = asin(x) + 1" --initial x=0 --until 4 2>&1 | grep -o 'leaves its domain at t = [0-9.]*'
  leaves its domain at t = 0.67362110
  $ for f in "if(t < 1, sqrt(1 - t), 0)" "sqrt(max(1 - t, 0))"; do integrate "x' = $f" --initial x=0 --until 2 --tolerance 1e-12 2> /dev/null | holds 'x = 2/3 +- 1e-8'; done

The time has the digits that the tolerance leaves. This tank is empty at 2 - log(11)/5 = 1.5204209454:

  $ for tolerance in 1e-3 1e-6 1e-9; do integrate "h' = -0.1 - sqrt(h)" --initial h=1 --until 3 --tolerance $tolerance; done 2>&1 | grep -o 't = [^,]*'
  t = 1.5 +- 0.2
  t = 1.5204 +- 0.0002
  t = 1.5204209 +- 2e-07

With max(h, 0) or `if` the equations are defined beyond the zero, and the level goes on:

  $ for tolerance in 1e-3 1e-6 1e-9; do for method in series dop853 ode45 adaptive-collocation; do
  >   integrate "h' = -sqrt(max(h, 0))" --initial h=1 --until 3 --every 0.1 --tolerance $tolerance --method $method | holds --each "h = max(1 - t/2, 0)**2 +- 100*$tolerance"
  >   integrate "h' = -0.1 - if(h > 0, sqrt(h), 0)" --initial h=1 --until 3 --tolerance $tolerance --method $method | holds "h = -0.1*(1 + log(11)/5) +- 100*$tolerance"
  > done; done

Two tanks in series empty into a third, which has all in the end:

  $ for tolerance in 1e-3 1e-6 1e-9; do for root in "sqrt(a)" "sqrt(max(a, 0))"; do
  >   integrate "a' = -$root; b' = $root - $(echo "$root" | tr a b | sed s/mbx/max/); c' = $(echo "$root" | tr a b | sed s/mbx/max/)" --initial "a=1, b=0, c=0" --until 9 --tolerance $tolerance |
  >     holds "a = 0 +- 100*$tolerance" "b = 0 +- 100*$tolerance" "c = 1 +- 100*$tolerance"
  > done; done

An inflow as a step, beside a root that is emptied before: from 4 on z = sqrt(h) solves 2 z z' = 1/2 - z:

  $ for tolerance in 1e-3 1e-6 1e-9; do
  >   integrate "h' = 0.5*step(t - 4) - sqrt(max(h, 0))" --initial h=1 --until 7 --tolerance $tolerance 2> said.txt |
  >     holds "Z := findroot(lambda z: -2*z - log(1 - 2*z) - 3, 0.49)" "h = Z**2 +- 100*$tolerance"
  >   grep -v 'steps end there' said.txt
  > done
  [1]

abs under a root is passed by every method:

  $ for method in series dop853 ode45 adaptive-collocation; do
  >   integrate "x' = 1; y' = sqrt(abs(x))" --initial "x=-1, y=0" --until 2 --tolerance 1e-8 --method $method | holds 'y = 4/3 +- 1e-6'
  > done

Starts with several solutions
-----------------------------

  $ integrate "x' = sign(x)" --initial x=0 --until 1
  integrators: the solution from t = 0 is not unique: it may go to either side of a switching surface; this run takes the side where the switching function is greater
  t,x
  0,0
  1,1
  $ integrate "x' = sqrt(x)" --initial x=0 --until 1
  integrators: the solution from t = 0 is not unique: the argument of a root is zero there and may stay zero or not; this run takes the solution for which it stays zero
  t,x
  0,0
  1,0
  $ integrate "x' = -sqrt(x)" --initial x=0 --until 1
  t,x
  0,0
  1,0

  $ integrate "x' = 3 abs(x)^(2/3)" --initial x=0 --until 1 2>&1 | head -1
  integrators: the solution from t = 0 is not unique: the argument of a root is zero there and may stay zero or not; this run takes the solution for which it stays zero

A run that comes to such a point later ends there, here at 2:

  $ integrate "x' = sqrt(abs(x))" --initial x=-1 --until 5
  integrators: outside_validity: the argument of a root becomes zero at t = 2.0* +- *: the solution beyond is not unique; end the run before (glob)
  [1]

Comparisons
-----------

  $ integrators compare --equation "h' = -sqrt(h)" --initial h=1 --until 3 --methods dop853,ode45 2> said.txt | cut -d, -f 1-3
  method,setting,status
  dop853,tolerance 1e-09,success
  ode45,tolerance 1e-09,success
