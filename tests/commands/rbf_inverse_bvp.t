Boundary value problems as one types them
=========================================

test_boundary_values.py solves random linear problems.

  $ bvp() { rbf_inverse bvp --equation "$@"; }

Bratu's problem has two solutions, x = -2 log(cosh(c (t - 1/2)) / cosh(c/2)) with the roots of sqrt(2) c = cosh(c/2). The tolerance is 1e-9 of the
residual, times what a solution moves by a unit of it, some tens at the most:

  $ root() { echo "c := findroot(lambda c: sqrt(2)*c - cosh(c/2), $1)"; }
  $ bvp "x'' + exp(x) = 0; x(0) = 0; x(1) = 0" --every 0.25 |
  >   holds --each "$(root 0.7)" 't = [0, 0.25, 0.5, 0.75, 1]' 'x = -2*log(cosh(c*(t - 0.5))/cosh(c/2)) +- 1e-8'
  $ bvp "x'' + exp(x) = 0; x(0) = 0; x(1) = 0" --every 0.25 --guess "x = 16 t*(1 - t)" |
  >   holds --each "$(root 6)" 'n = 5' 'x = -2*log(cosh(c*(t - 0.5))/cosh(c/2)) +- 4e-8'

A constant that is not known: eigenvalues (n pi)^2, and that of a column that is held elastically, tan(a) = -a:

  $ eigenvalue() { rbf_inverse bvp --equation "x'' + k x = 0; x(0) = 0; x'(0) = 1" --unknown k --every 1 --conditions "$1" --guess "$2"; }
  $ eigenvalue "x(1) = 0" "x = t*(1 - t), k = 8" | holds 'k = pi^2 +- 1e-8'
  $ eigenvalue "x(1) = 0" "x = sin(6.3 t)/6.3, k = 38" | holds 'k = 4*pi^2 +- 4e-8'
  $ eigenvalue "x(1) + x'(1) = 0" "x = t, k = 4" | holds 'a := findroot(lambda a: sin(a) + a*cos(a), 2)' 'k = a^2 +- 1e-8'

Boundary layers of exp(-t/sqrt(e)) at both ends, through which nothing can be integrated: verified by pieces, which is said. Errors are absolute, as
the tolerance is:

  $ bvp "e x'' = x; e = 1e-4; x(0) = 1; x(1) = 2" > layers.csv
  rbf_inverse: verified by integration over each of * intervals; an integration from the start alone leaves it (* off), because rounding errors grow: the solution is determined by both ends (glob)
  $ holds --each 'n > 20' 'x = exp(-100*t) + 2*exp(100*(t - 1)) +- 1e-8' < layers.csv

Neighbours part by exp(1000 t), so that intervals on which the residual is small are still too long to be verified. The solution is k/(k + 1) sin(t)
up to its end:

  $ bvp "x'' = k*(x - sin(t)); k = 1e6; x(0) = 0; x(10) = 0" --every 1 2> said.txt |
  >   holds --each 'n = 11' 'x = (1e6/(1e6 + 1)*sin(t) if t < 10 else 0) +- 1e-12*(t < 10)'

Troesch's problem with the constant 5 (Roberts and Shipman 1972, to the digits printed there):

  $ bvp "x'' = n sinh(n x); n = 5; x(0) = 0; x(1) = 1" --every 1 > rows.csv
  $ sed -n 1,2p rows.csv | holds "x' = 0.0457504614 +- 1.05e-9"
  $ holds "x' = 12.1004954 +- 6e-8" < rows.csv

A beam under its own weight, clamped at 1 and free at 3, deflects by q l^4/8:

  $ bvp "w'''' = 3" --conditions "w(1) = 0, w'(1) = 0, w''(3) = 0, w'''(3) = 0" --every 2 | holds 'n = 1' 't = 3' 'w = 6 +- 1e-9'

A load that begins at 0.3, x = -0.245 t + max(t - 0.3, 0)^2/2, and pulses of the area sqrt(pi) at 50.3, narrower than any first mesh. The defect is 1e-9 of
the greatest slope, 1/w, over some 4 w, so that x' is off by 4e-9, and x by 4e-7:

  $ bvp "x'' = if(t < 0.3, 0, 1); x(0) = 0; x(1) = 0" --every 0.1 | holds --each 'n = 11' 'x = -0.245*t + max(t - 0.3, 0)**2/2 +- 1e-13'
  $ for w in 1e-2 1e-4; do
  >   bvp "x'' = exp(-((t - 50.3)/w)^2)/w; w = $w; x(0) = 0; x(100) = 0" --every 50 |
  >     holds --each 'n = 3' 'x = sqrt(pi)*(max(t - 50.3, 0) - 0.497*t) +- 5e-7'
  > done

A solution of 0, from a guess of another size; one that is small beside its guess; a component that is 0:

  $ for f in "x''-x=0" "x''=sinh(x)" "x''=x^3" "x''''=0*t; x'(0)=0; x'(1)=0" "x''+x'+sin(x)=0"; do
  >   bvp "$f; x(0) = 0; x(1) = 0" --guess "x = t" | holds --each 'x = 0'
  > done
  $ bvp "x'' - x = 0; x(0) = 1e-30; x(1) = 0" --guess "x = 1 - t" --every 0.5 | holds --each 'n = 3' 'x = 1e-30*sinh(1 - t)/sinh(1) +- 1e-39'
  $ bvp "x'' = 1e4*x; x(0) = 1e-30; x(1) = 0" --guess "x = 1 - t" --every 0.01 2> said.txt | holds --each 'n = 101' 'x = 1e-30*exp(-100*t) +- 1e-38'
  $ for guess in "x = t, y = t" "y = 0"; do
  >   bvp "x'' = y; y'' = 0; x(0) = 0; x(1) = 1; y(0) = 0; y(1) = 0" --guess "$guess" --every 0.5 | holds --each 'n = 3' 'x = t +- 1e-14' 'y = 0 +- 1e-30'
  > done

Equilibria, where the slopes are rounding:

  $ bvp "x'' = -sin(x); x(0) = pi; x(1) = pi" | holds --each 'n < 100' 'x = pi +- 1e-14'
  $ bvp "x'' = x^2 - 2; x(0) = sqrt(2); x(1) = sqrt(2)" --guess "x = sqrt(2)" | holds --each 'n < 100' 'x = sqrt(2) +- 1e-14'

Where there is no solution it says so: half a period from 0 to another value, and a load that is too large:

  $ bvp "x'' + pi^2 x = 0; x(0) = 0; x(1) = 0.5"
  rbf_inverse: singular_matrix: bvp: Newton's matrix is singular (pivots 1 to *, iteration *): with these equations the conditions do not determine the solution or admit none, or a layer of it is too thin for the mesh; change the conditions, start elsewhere, or follow the solution from a parameter with a wider layer; no solution from 20 random cubics either; give a --guess (glob)
  [1]
  $ bvp "x'' + 4 exp(x) = 0; x(0) = 0; x(1) = 0.5"
  rbf_inverse: newton_diverged: bvp: * no solution from 20 random cubics either; give a --guess (glob)
  [1]

Conditions of every kind
------------------------

Conditions on both ends at once: x'' + x = cos(2 t) of period 1 has x = -cos(2 t)/3 + a cos(t) + b sin(t). A point between, and an integral of the square,
by which an eigenfunction is normalised:

  $ bvp "x'' + x = cos(2 t)" --conditions "x(0) = x(1), x'(0) = x'(1)" --every 0.5 > periodic.csv
  $ holds --each 'n = 3' "A := matrix([[cos(1) - 1, sin(1)], [-sin(1), cos(1) - 1]])" 'a := lu_solve(A, matrix([(cos(2) - 1)/3, -2*sin(2)/3]))' \
  >   'x = -cos(2*t)/3 + a[0]*cos(t) + a[1]*sin(t) +- 1e-9' < periodic.csv
  $ bvp "x'' = -9.81" --conditions "x(0.6) = 3.5; x(0.3) = 7" --from 0 --until 1 --every 0.5 |
  >   holds --each 'n = 3' 'x = 7 + (t - 0.3)*(-3.5/0.3 + 9.81*0.15) - 9.81/2*(t - 0.3)^2 +- 1e-12'
  $ bvp "x'' + k x = 0; x(0) = 0; x(1) = 0; integral(x^2) = 1" --unknown k --guess "x = t*(1 - t), k = 8" --every 0.5 |
  >   holds --each 'n = 3' 'k = pi^2 +- 1e-8' 'x = sqrt(2)*sin(pi*t) +- 1e-8'

An integral may be long:

  $ bvp "x'' + k x = 0; x(0) = 0; x(1) = 0; integral(x^2/4 + x^2/4 + x^2/8 + x^2/8 + x^2/8 + x^2/16 + x^2/16) = 1" --unknown k --guess "x = t*(1 - t), k = 8" \
  >   --every 1 | holds 'k = pi^2 +- 1e-8'

A guess gives its derivatives of every order. The buckling load of a column is pi^2:

  $ bvp "w'''' + p w'' = 0; w(0) = 0; w''(0) = 0; w(1) = 0; w''(1) = 0; w(0.5) = 1" --unknown p --guess "w = sin(pi t), p = 9" --every 0.5 |
  >   holds --each 'n = 3' 'p = pi^2 +- 1e-8' 'w = sin(pi*t) +- 1e-8'

The size of a normalisation changes nothing: `x'' + k x + x/(1 + t) = 0` has the eigenvalue 9.1926669827908, from a root of the series solution by mpmath:

  $ for size in 1e-14 1e-9 1 1e9; do
  >   bvp "x'' + k x + x/(1 + t) = 0; x(0) = 0; x(1) = 0; x'(0) = $size" --unknown k --guess "x = sin(pi t), k = 8" --every 1 | holds 'k = 9.1926669827908 +- 1e-8'
  > done

The period T of van der Pol's oscillator is unknown, and known to 20 digits (mu = 1, Andersen and Geer 1982). From a small guess it comes to rest, where T is
anything:

  $ period() { bvp "x'' - mu (1 - x^2) x' + x = 0" --set "mu=$1" --conditions "x(0) = x(T), x'(0) = x'(T), x'(0) = 0" --until T --guess "$2" --every 10; }
  $ period 1 "x = 2 cos(t), T = 6.3" | holds 'T = 6.6632868593231301 +- 1e-8' 't = T +- 1e-14'
  $ period 5 "x = 0.1 cos(t), T = 9"
  rbf_inverse: singular_matrix: bvp: nothing determines T: at the result, where all states are 0, neither the equations nor the conditions depend on it; change the conditions, or start elsewhere; give another --guess
  [1]

Ends
----

Regular singular ends. Lane and Emden's equation of order 5 has 1/sqrt(1 + t^2/3), a disk under a load (1 - t^2)/4:

  $ bvp "x'' + 2 x'/t + x^5 = 0; x'(0) = 0; x(1) = sqrt(3)/2" --every 0.25 | holds --each 'n = 5' 'x = 1/sqrt(1 + t^2/3) +- 1e-9'
  $ bvp "x'' + x'/t = -1; x'(0) = 0; x(1) = 0" --every 0.25 | holds --each 'n = 5' 'x = (1 - t^2)/4 +- 1e-12'

Legendre's equation is singular at both ends. Where solutions are series in sqrt(t), as t^1.5 or Thomas and Fermi's atom (-1.5880710226113753, Boyd 2013):

  $ bvp "(1 - t^2) x'' = 2 t x' - k x; x(1) = 1; 2 x'(1) = k x(1); 2 x'(-1) = -k x(-1)" --unknown k --guess "x = 1.4 t^2 - 0.4, k = 5.5" --every 0.5 |
  >   holds --each 'n = 5' 'k = 6 +- 1e-9' 'x = 1.5*t^2 - 0.5 +- 1e-9'
  $ bvp "x'' = 0.75/sqrt(t); x(0) = 0; x(1) = 1" --every 0.25 | holds --each 'n = 5' 'x = t^1.5 +- 1e-12'
  $ bvp "x'' = max(x, 0)^1.5/sqrt(t); x(0) = 1; x(inf) = 0" --until inf 2> said.txt | sed -n 1,2p | holds "x' = -1.5880710226113753 +- 1e-8"

Infinite ends: Blasius' boundary layer (0.332057336215196, Boyd 1999), and a decay, x = exp(-2 t):

  $ bvp "f''' + f f''/2 = 0; f(0) = 0; f'(0) = 0; f'(inf) = 1" --until inf | sed -n 1,2p | holds "f'' = 0.332057336215196 +- 1e-9"
  $ bvp "x'' = 4 x; x(0) = 1; x(inf) = 0" --until inf 2> said.txt | holds --each 'x = exp(-2*t) +- 1e-8'
  $ bvp "x'' = -x; x(0) = 1; x(inf) = 0" --until inf --guess "x = cos(t)"
  rbf_inverse: not_converged: the solution does not approach its values at infinity: up to t = * they still change by * of their size over the last half; give another --guess (glob)
  [1]

A pulse late in time: x(100) = sqrt(pi) e erfc(1), the integral of exp(-|t - 100|)/2 times the pulse; an integral of x that gives k; a load from 100 to 101:

  $ pulses() { bvp "x'' = x - k*exp(-(t - 4)^2) - exp(-((t - 100)/2)^2); x(0) = 0; x(inf) = 0" --conditions "$1" --until inf --every 100 --unknown k 2> said.txt; }
  $ pulses "k = 1" | holds --where t=100 'x = sqrt(pi)*e*erfc(1) +- 1e-8'
  $ pulses "integral(x) = 5" |
  >   holds 'area := quad(lambda s: (1 - exp(-s))*exp(-(s - 4)**2), [0, 2, 4, 6, 20])' 'k = (5 - 2*sqrt(pi))/area +- 1e-8'
  $ bvp "x'' = x - if(t > 100 and t < 101, 1, 0); x(0) = 0; x(inf) = 0" --until inf --every 0.5 2> said.txt |
  >   holds --where t=100.5 'x = 1 - exp(-0.5) +- 1e-8'

Several solutions, guesses from files, continuation
---------------------------------------------------

  $ bvp "x'' + exp(x) = 0; x(0) = 0; x(1) = 0" --every 0.5 --starts 20 > both.csv
  rbf_inverse: 2 different solutions from 20 starts; there may be more
  $ cut -d, -f1 both.csv | uniq -c | sed 's/^ *//'
  1 solution
  3 1
  3 2
  $ bvp "x'' + exp(x) = 0; x(0) = 0; x(1) = 0" --guess "x = 16 t*(1 - t)" > upper.csv
  $ bvp "x'' + exp(x) = 0; x(0) = 0; x(1) = 0" --guess upper.csv --every 0.5 | holds --each "$(root 6)" 'x = -2*log(cosh(c*(t - 0.5))/cosh(c/2)) +- 4e-8'
  $ bvp "x'' = n sinh(n x); n = 1; x(0) = 0; x(1) = 1" --from-parameter "n = 1 : 10" 2> said.txt > rows.csv
  $ sed -n 1,2p rows.csv | holds "x' = 3.583377846308e-4 +- 1e-9"

Beyond the fold of Bratu's branch at 3.513830719125 (theta tanh(theta/4) = 4) there is no solution, and below it there are two, with the roots of
theta/cosh(theta/4) = sqrt(2 a):

  $ bvp "x'' + a exp(x) = 0; x(0) = 0; x(1) = 0" --from-parameter "a = 1 : 4"
  rbf_inverse: outside_validity: a = * was reached in * steps; the branch turns back at 3.51383071*; the branch returns beyond 1 (glob)
  [1]
  $ bvp "x'' + a exp(x) = 0; x(0) = 0; x(1) = 0" --from-parameter "a = 0 : 3" --all-solutions --every 0.5 > both.csv
  rbf_inverse: 2 different solutions at a = 3 on the branch; a = * was reached in * steps; the branch turns back at 3.51383071*; * (glob)
  $ theta() { echo "c := findroot(lambda c: c/cosh(c/4) - sqrt(6), $1)"; }
  $ for n in 1 2; do grep "^solution\|^$n," both.csv > $n.csv; done
  $ holds --each "$(theta 3)" 'n = 3' 'x = -2*log(cosh((t - 0.5)*c/2)/cosh(c/4)) +- 1e-8' < 1.csv
  $ holds --each "$(theta 7)" 'n = 3' 'x = -2*log(cosh((t - 0.5)*c/2)/cosh(c/4)) +- 4e-8' < 2.csv

Mistakes
--------

  $ wrong() { refused rbf_inverse bvp --equation "x'' = a x; a = 1" "$@"; }
  $ wrong --conditions 'x(0)=1'
  rbf_inverse: --conditions: 1 conditions, but 2 are needed, one for each of x, x'
  $ wrong --conditions 'x(0)=1, q(1)=2'
  rbf_inverse: --conditions:1:1: q is not defined: it has neither a derivative (q') nor a definition (q = ...)
    q
    ^
  $ wrong --conditions "x(0)=1, x(1)=q"
  rbf_inverse: --conditions:1:6: q is not defined: it has neither a derivative (q') nor a definition (q = ...)
    x(1)=q
         ^
  $ wrong --conditions 'x(0)=1, x(1)'
  rbf_inverse: --conditions x(1): is no condition; give an equation, such as x(0) = 0
  $ wrong --conditions 'x(0)=1, x=2'
  rbf_inverse: --conditions:1:1: a value needs its time, as in x(0)
    x=2
    ^
  $ wrong --conditions 'x(0)=1, x(1)=t'
  rbf_inverse: --conditions:1:6: a condition holds at points of time: it cannot contain t
    x(1)=t
         ^
  $ wrong --conditions 'x(0)=1, a=2'
  rbf_inverse: --conditions a=2: contains no value of the solution, such as x(0), and no unknown constant
  $ wrong --conditions 'x(0)=1, x(t)=2'
  rbf_inverse: --conditions:1:1: a time must be a number, or an expression of constants
    t
    ^
  $ wrong --conditions 'x(0)=1, x(inf)=2'
  rbf_inverse: --conditions:1:3: a value at infinity needs --until inf
    x(inf)=2
      ^^^
  $ wrong --conditions 'x(0)=1, integral(x(0))=2'
  rbf_inverse: --conditions:1:1: a value cannot be in an integral; for a product write *
    x(0)
    ^^^^
  $ wrong --conditions 'x(0)=1, x(2)=2' --until 1
  rbf_inverse: --conditions: the time 2 is outside the interval from 0 to 1
  $ ends() { wrong --conditions 'x(0)=1, x(1)=0' "$@"; }
  $ ends --unknown a
  rbf_inverse: --equation:1:12: defined here, and given by --unknown; remove one of both
    x'' = a x; a = 1
               ^
  $ ends --unknown k
  rbf_inverse: --unknown k: stands in no equation and in no condition, so nothing determines it
  $ ends --unknown k=6
  rbf_inverse: --unknown k=6: is no name, such as k
  $ ends --unknown sin
  rbf_inverse: --unknown sin: is the name of a function; choose another
  $ ends --until step
  rbf_inverse: --until step: is the name of a function; choose another
  $ ends --until t
  rbf_inverse: --until t: is the time; choose another name
  $ ends --guess y=1
  rbf_inverse: --guess y=1: must begin with a component and =; the components are x, x'
  $ ends --guess x=x+1
  rbf_inverse: --guess x=x+1: must be a function of the time t only
  $ ends --guess x=t,x=2
  rbf_inverse: --guess x=2: x is given twice
  $ ends --from 1
  rbf_inverse: --until 1: must be later than 1, the start; the conditions have no later time
  $ ends --every 1e-9
  rbf_inverse: --every 1e-09: more than a million rows
  $ ends --tolerance 0
  rbf_inverse: --tolerance 0: must be from 1e-13 to 0.1
  $ ends --set b=2
  rbf_inverse: --set b: the equation has no such definition; choose one of a
  $ ends --all-solutions
  rbf_inverse: --all-solutions: needs --from-parameter
  $ ends --from-parameter "a: 1"
  rbf_inverse: --from-parameter a: 1: must be NAME = FIRST : LAST
  $ printf 't,x\n0,1\n0,2\n' > rows.csv
  $ ends --guess rows.csv
  rbf_inverse: --guess rows.csv:3: t = 0 is not after the row before
  $ text() { refused rbf_inverse bvp --equation "$1; x(0) = 1; x(1) = 0"; }
  $ text "x'' = x; t <= 2"
  rbf_inverse: --equation: end, bounds and conserved quantities are for initial value problems; give the end by --until
  $ text "x'' = x; x >= 0"
  rbf_inverse: --equation: end, bounds and conserved quantities are for initial value problems; give the end by --until
  $ text "x'' = x; conserved x"
  rbf_inverse: --equation: end, bounds and conserved quantities are for initial value problems; give the end by --until
  $ refused rbf_inverse bvp --until 1
  rbf_inverse: give one of --equation TEXT and --file NAME.ode
