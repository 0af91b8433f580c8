Boundary value problems as one types them
=========================================

test_boundary_values.py solves random linear problems.

  $ bvp() { rbf_inverse bvp --equation "$@"; }

Bratu's problem has two solutions, x = -2 log(cosh(c (t - 1/2)) / cosh(c/2)) with the roots of sqrt(2) c = cosh(c/2). The tolerance is 1e-9 of the
residual, times what a solution moves by a unit of it, some tens at the most:

  $ root() { echo "c := findroot(lambda c: sqrt(2)*c - cosh(c/2), $1)"; }
  $ bvp "x'' + exp(x) = 0" --begin "x = 0" --end "x=0" --until 1 --every 0.25 |
  >   holds --each "$(root 0.7)" 't = [0, 0.25, 0.5, 0.75, 1]' 'x = -2*log(cosh(c*(t - 0.5))/cosh(c/2)) +- 1e-8'
  $ bvp "x'' + exp(x) = 0" --begin "x = 0" --end "x=0" --until 1 --every 0.25 --guess "x = 16 t*(1 - t)" |
  >   holds --each "$(root 6)" 'n = 5' 'x = -2*log(cosh(c*(t - 0.5))/cosh(c/2)) +- 4e-8'

A constant that is not known: eigenvalues (n pi)^2, and that of a column that is held elastically, tan(a) = -a:

  $ eigenvalue() { rbf_inverse bvp --equation "x'' + k x = 0; k' = 0" --begin "x = 0, x' = 1" --until 1 --every 1 --end "$1" --guess "$2"; }
  $ eigenvalue "x = 0" "x = t*(1 - t), k = 8" | holds 'k = pi^2 +- 1e-8'
  $ eigenvalue "x = 0" "x = sin(6.3 t)/6.3, k = 38" | holds 'k = 4*pi^2 +- 4e-8'
  $ eigenvalue "x + x' = 0" "x = t, k = 4" | holds 'a := findroot(lambda a: sin(a) + a*cos(a), 2)' 'k = a^2 +- 1e-8'

Boundary layers of exp(-t/sqrt(e)) at both ends, through which nothing can be integrated: verified by pieces, which is said. Errors are absolute, as
the tolerance is:

  $ bvp "e x'' = x; e = 1e-4" --begin x=1 --end x=2 --until 1 > layers.csv
  rbf_inverse: verified by integration over each of * intervals; an integration from the start alone leaves it (* off), because rounding errors grow: the solution is determined by both ends (glob)
  $ holds --each 'n > 20' 'x = exp(-100*t) + 2*exp(100*(t - 1)) +- 1e-8' < layers.csv

Neighbours part by exp(1000 t), so that intervals on which the residual is small are still too long to be verified. The solution is k/(k + 1) sin(t)
up to its end:

  $ bvp "x'' = k*(x - sin(t)); k = 1e6" --begin x=0 --end x=0 --until 10 --every 1 2> said.txt |
  >   holds --each 'n = 11' 'x = (1e6/(1e6 + 1)*sin(t) if t < 10 else 0) +- 1e-12*(t < 10)'

Troesch's problem with the constant 5 (Roberts and Shipman 1972, to the digits printed there):

  $ bvp "x'' = n sinh(n x); n = 5" --begin x=0 --end x=1 --until 1 --every 1 > rows.csv
  $ sed -n 1,2p rows.csv | holds "x' = 0.0457504614 +- 1.05e-9"
  $ holds "x' = 12.1004954 +- 6e-8" < rows.csv

A beam under its own weight, clamped at 1 and free at 3, deflects by q l^4/8:

  $ bvp "w'''' = 3" --begin "w = 0, w' = 0" --end "w'' = 0; w''' = 0" --from 1 --until 3 --every 2 | holds 'n = 1' 't = 3' 'w = 6 +- 1e-9'

A load that begins at 0.3, x = -0.245 t + max(t - 0.3, 0)^2/2, and pulses of the area sqrt(pi) at 50.3, narrower than any first mesh. The defect is 1e-9 of
the greatest slope, 1/w, over some 4 w, so that x' is off by 4e-9, and x by 4e-7:

  $ bvp "x'' = if(t < 0.3, 0, 1)" --begin x=0 --end x=0 --until 1 --every 0.1 | holds --each 'n = 11' 'x = -0.245*t + max(t - 0.3, 0)**2/2 +- 1e-13'
  $ for w in 1e-2 1e-4; do
  >   bvp "x'' = exp(-((t - 50.3)/w)^2)/w; w = $w" --begin x=0 --end x=0 --until 100 --every 50 |
  >     holds --each 'n = 3' 'x = sqrt(pi)*(max(t - 50.3, 0) - 0.497*t) +- 5e-7'
  > done

Where there is no solution it says so: half a period from 0 to another value, and a load that is too large:

  $ bvp "x'' + pi^2 x = 0" --begin x=0 --end x=0.5 --until 1
  rbf_inverse: singular_matrix: bvp: Newton's matrix is singular (pivots 1 to *, iteration *): with these equations the conditions do not determine the solution or admit none; change the conditions, or start elsewhere; no solution from 20 random cubics either; give a --guess (glob)
  [1]
  $ bvp "x'' + 4 exp(x) = 0" --begin x=0 --end x=0.5 --until 1
  rbf_inverse: newton_diverged: bvp: * no solution from 20 random cubics either; give a --guess (glob)
  [1]

Mistakes
--------

  $ wrong() { refused rbf_inverse bvp --equation "x'' = a x; a = 1" --until 1 "$@"; }
  $ wrong --begin x=1
  rbf_inverse: --begin, --end: 1 conditions, but the state has 2 components, x, x'; give one condition for each
  $ wrong --begin 'x=1, q=2'
  rbf_inverse: --begin:1:1: q is not defined: it has neither a derivative (q') nor a definition (q = ...)
    q=2
    ^
  $ wrong --begin "x=1,,x'=2"
  rbf_inverse: --begin x=1,,x'=2: an empty condition between two commas
  $ wrong --begin x=1 --end x
  rbf_inverse: --end x: is no condition; give an equation, such as x = 0
  $ ends() { refused rbf_inverse bvp --equation "x'' = a x; a = 1" --until 1 --begin x=1 --end x=0 "$@"; }
  $ ends --guess y=1
  rbf_inverse: --guess y=1: must begin with a component and =; the components are x, x'
  $ ends --guess x=x+1
  rbf_inverse: --guess x=x+1: must be a function of the time t only
  $ ends --guess x=t,x=2
  rbf_inverse: --guess x=2: x is given twice
  $ ends --from 1
  rbf_inverse: --until 1: must be later than --from 1
  $ ends --every 1e-9
  rbf_inverse: --every 1e-09: more than a million rows
  $ ends --tolerance 0
  rbf_inverse: --tolerance 0: must be from 1e-13 to 0.1
  $ ends --set b=2
  rbf_inverse: --set b: the equation has no such definition; choose one of a
  $ text() { refused rbf_inverse bvp --equation "$1" --until 1 --begin x=1 --end x=0; }
  $ text "x'' = x; x(0) = 1"
  rbf_inverse: --equation: give values at a time, such as x(0) = 1, by --begin and --end
  $ text "x'' = x; t <= 2"
  rbf_inverse: --equation: end, bounds and conserved quantities are for initial value problems; give the end by --until
  $ text "x'' = x; x >= 0"
  rbf_inverse: --equation: end, bounds and conserved quantities are for initial value problems; give the end by --until
  $ text "x'' = x; conserved x"
  rbf_inverse: --equation: end, bounds and conserved quantities are for initial value problems; give the end by --until
  $ refused rbf_inverse bvp --until 1
  rbf_inverse: give one of --equation TEXT and --file NAME.ode
