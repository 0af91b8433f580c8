Mazzia and Cash's test set, and transfers, as typed problems
===========================================================

  $ set=$TESTDIR/../../common/nlmech/problems/bvp
  $ problem() { number=$1; shift; rbf_inverse bvp --file $set/bvpT$number.ode "$@" 2> said.txt; }

Closed forms, with the parameters of the files and with smaller ones. The tolerance is 1e-9, and the largest value is 1 or 2:

  $ problem 1 --every 0.1 | holds --each 'n = 11' 'y = sinh((1 - t)/sqrt(1e-3))/sinh(1/sqrt(1e-3)) +- 1e-8'
  $ problem 6 --set eps=1e-6 --every 0.125 | holds --each 'n = 17' 'y = cos(pi*t) + erf(t/sqrt(2e-6))/erf(1/sqrt(2e-6)) +- 1e-8'
  $ problem 8 --set eps=1e-6 --every 0.25 | holds --each 'n = 5' 'y = 2 - exp(-t*1e6) +- 1e-8'
  $ problem 15 --set eps=1e-6 --every 0.5 |
  >   holds --each 'a := airyai(-100)' 'b := airybi(-100)' 'c := airyai(100)' 'd := airybi(100)' 'n = 5' \
  >     'y = ((d - b)*airyai(100*t) + (a - c)*airybi(100*t))/(a*d - b*c) +- 1e-8'
  $ problem 20 --every 0.25 | holds --each 'n = 5' 'y = 1 + 0.01*log(cosh(100*(t - 0.745))) +- 1e-8'

A guess, and continuation in the parameter where Newton's iteration does not converge from zeros (values of multiple shooting in 24
digits, tools/bvp_test_set_references.py):

  $ problem 24 --guess 'y = 0.9129 - 0.5379 t' --every 0.1 | holds --where t=0.10000000000000001 'y = 0.99623688484060 +- 1e-8'
  $ problem 28 --from-parameter 'eps = 0.1 : 1e-3' --every 0.1 | holds --where t=0.10000000000000001 "y = 0.6 +- 1e-8"

Problem 35 multiplies errors by exp(1/(2 eps)), 5e21 at eps = 0.01, which rounding decides: it is refused.

  $ problem 35 --set eps=0.01
  [1]

Rendezvous
----------

Hill's equations (Clohessy and Wiltshire 1960) about a circular orbit of radius 1 and period 2 pi, x outward, y along the motion. Two
impulses from (x, y) = (0, -1) meet the target after T = 2. Their closed form is r(T) = A r(0) + B v(0), so that the velocity after the
first one is -inverse(B) A r(0).

  $ A='A := matrix([[4 - 3*cos(2), 0], [6*(sin(2) - 2), 1]])'
  $ B='B := matrix([[sin(2), 2*(1 - cos(2))], [2*(cos(2) - 1), 4*sin(2) - 6]])'
  $ rbf_inverse bvp --equation "x'' = 3 x + 2 y'; y'' = -2 x'; x(0) = 0; y(0) = -1; x(2) = 0; y(2) = 0" > hill.csv
  $ sed -n 1,2p hill.csv | holds "$A" "$B" "v := -lu_solve(B, A*matrix([0, -1]))" "x' = v[0] +- 1e-9" "y' = v[1] +- 1e-9"

The nonlinear motion is Kepler's, so that the same transfer is an arc of Lambert's problem, in axes that do not rotate: the velocity of
departure is that of the rotating axes plus their own. At a distance of 0.01 Hill's velocities are off by less than a hundredth, which is that distance:

  $ rbf_inverse bvp --equation "x'' = x + 2 y' + 1 - (1 + x)/r^3; y'' = y - 2 x' - y/r^3; r = sqrt((1 + x)^2 + y^2)" \
  >   --conditions "x(0) = 0; y(0) = -0.01; x(2) = 0; y(2) = 0" > near.csv 2> said.txt
  $ rbf_inverse lambert --mu 1 --time 2 --from 1,-0.01,0 --to $(python3 -c 'import math; print(f"{math.cos(2)!r},{math.sin(2)!r},0")') > arc.csv
  $ sed -n 1,2p near.csv | paste -d, - arc.csv | holds "x' = vx0 - 0.01 +- 1e-9" "y' = vy0 - 1 +- 1e-9"
  $ sed -n 1,2p near.csv | holds "$A" "$B" "v := -lu_solve(B, A*matrix([0, -0.01]))" "x' = v[0] +- 1e-2*norm(v)" "y' = v[1] +- 1e-2*norm(v)"

With continuous thrust (a, b) of least energy, the integral of (a^2 + b^2)/2, the thrust is -(p, q) with the co-states of the velocities, which
obey Hill's equations too. From rest at (0.5, -1) to rest at the target; the state after T = 2 is the matrix exponential of the eight linear equations:

  $ cat > energy.ode << END
  > x'' = 3 x + 2 y' - p;  y'' = -2 x' - q
  > p'' = 3 p + 2 q';      q'' = -2 p'
  > x(0) = 0.5; y(0) = -1; x'(0) = 0; y'(0) = 0
  > x(2) = 0;   y(2) = 0;  x'(2) = 0; y'(2) = 0
  > END
  $ rbf_inverse bvp --file energy.ode > energy.csv
  $ H='H := matrix([[0,0,1,0],[0,0,0,1],[3,0,0,2],[0,0,-2,0]])'
  $ fill='E := expm(2*matrix([[H[i % 4, j % 4] if i // 4 == j // 4 else -1 if j // 4 == 1 and i in (2, 3) and j == i + 2 else 0 for j in range(8)] for i in range(8)]))'
  $ sed -n 1,2p energy.csv | holds "$H" "$fill" 'c := lu_solve(E[0:4, 4:8], -E[0:4, 0:4]*matrix([0.5, -1, 0, 0]))' 'p = c[0] +- 1e-8' 'q = c[1] +- 1e-8'
