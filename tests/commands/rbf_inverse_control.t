Optimal control as one types it
===============================

Closed forms; control_test.cpp has more of them, test_boundary_values.py the Duffing oscillator of chapters/rbf_inverse/duffing.

  $ mass() { rbf_inverse control --equation "x'' = u; x(0) = 0; x'(0) = 0" --control u "$@"; }

A mass from rest to rest in unit time takes u = 6 - 12 t, and costs 6. Errors are within the tolerance of 1e-9 of the size of u:

  $ mass --minimise "integral(u^2/2)" --conditions "x(1) = 1; x'(1) = 0" --every 0.5 > mass.csv
  rbf_inverse: cost 6; Hamiltonian from -18 to -18; deviation of an integration * (glob)
  rbf_inverse: multiplier of x(0) = 0: 12
  rbf_inverse: multiplier of x'(0) = 0: 6
  rbf_inverse: multiplier of x(1) = 1: -12
  rbf_inverse: multiplier of x'(1) = 0: 6
  $ head -1 mass.csv
  t,x,x',lambda_x,lambda_x',u
  $ holds --each 't = [0, 0.5, 1]' 'u = 6 - 12*t +- 1e-8' 'x = 3*t^2 - 2*t^3 +- 1e-8' < mass.csv

With a bound it is at the bound until 1/2 - sqrt(3/20), and after 1/2 + sqrt(3/20), of the time:

  $ mass --minimise "integral(u^2/2)" --conditions "x(1) = 1; x'(1) = 0" --bounds "-5 <= u <= 5" --every 0.5 2>&1 >bounded.csv | grep -v multiplier
  rbf_inverse: cost 6.04502775632; Hamiltonian from * to *; deviation of an integration * (glob)
  rbf_inverse: from 0 to 0.1127016654: u = 5
  rbf_inverse: from 0.1127016654 to 0.8872983346: u between its bounds
  rbf_inverse: from 0.8872983346 to 1: u = -5
  $ holds --each 'u = [5, 0, -5] +- 1e-8' < bounded.csv

In least time it switches once. The end is free:

  $ mass --minimise T --until T --conditions "x(T) = 1; x'(T) = 0" --bounds "-1 <= u <= 1" 2>&1 >least.csv | grep -v multiplier
  rbf_inverse: cost 2, T = 2; Hamiltonian from * to *; deviation of an integration * (glob)
  rbf_inverse: from 0 to 1: u = 1
  rbf_inverse: from 1 to 2: u = -1
  $ holds 't = 2 +- 1e-8' 'x = 1 +- 1e-8' < least.csv
  $ mass --minimise u --until u --conditions "x(u) = 1; x'(u) = 0" --bounds "-1 <= u <= 1"
  rbf_inverse: --until u: is a control; a free end needs another name
  [2]

Breakwell's problem (A. E. Bryson, Y.-C. Ho, Applied Optimal Control, 1975, section 3.11): the mass is thrown at 1 and caught at -1. Below a bound l >= 1/4 it
flies freely, from 1/6 to 1/4 it touches the bound, and then it stays on it from 3 l to 1 - 3 l. The costs are 2, 2 + 6 (1 - 4 l)^2, 4/(9 l):

  $ breakwell() {
  >   rbf_inverse control --equation "x'' = u; x(0) = 0; x'(0) = 1; x(1) = 0; x'(1) = -1" --control u --minimise "integral(u^2/2)" \
  >     --state-bounds "x <= $1" 2>&1 >$1.csv | grep -v "multiplier of"
  > }
  $ breakwell 0.3
  rbf_inverse: cost 2; Hamiltonian from -2 to -2; deviation of an integration * (glob)
  $ breakwell 0.2
  rbf_inverse: cost 2.24; Hamiltonian from * to *; deviation of an integration * (glob)
  rbf_inverse: from 0 to 0.5: u between its bounds
  rbf_inverse: from 0.5 to 1: u between its bounds
  rbf_inverse: at 0.5 contact with x <= 0.2: multipliers 9.6 (re)
  $ breakwell 0.1
  rbf_inverse: cost 4.44444444444; Hamiltonian from * to *; deviation of an integration * (glob)
  rbf_inverse: from 0 to 0.3: u between its bounds
  rbf_inverse: from 0.3 to 0.7: u between its bounds, on x <= 0.1
  rbf_inverse: from 0.7 to 1: u between its bounds
  rbf_inverse: at 0.3 entry to x <= 0.1: multipliers * (glob)
  $ head -1 0.1.csv
  t,x,x',lambda_x,lambda_x',u,mu_1
  $ holds --each 'x <= 0.1 + 1e-12' 'mu_1 >= -1e-9' < 0.1.csv

A singular arc before a prescribed end, and one after a prescribed start: x = 0 there, costs 1/9 and 1/72:

  $ point() { rbf_inverse control --equation "x' = u; x(0) = $1; x(1) = $2" --control u --minimise "integral(x^2)" --bounds "-3 <= u <= 3" --every 0.5 2>&1 >point.csv | grep -v multiplier; }
  $ point 1 0
  rbf_inverse: cost 0.111111111111; Hamiltonian from * to *; deviation of an integration * (glob)
  rbf_inverse: from 0 to 0.3333333333: u = -3
  rbf_inverse: from 0.3333333333 to 1: u singular
  $ holds --each 'u = [-3, 0, 0] +- 1e-8' < point.csv
  $ point 0 0.5
  rbf_inverse: cost 0.0138888888889; Hamiltonian from * to *; deviation of an integration * (glob)
  rbf_inverse: from 0 to 0.8333333333: u singular
  rbf_inverse: from 0.8333333333 to 1: u = 3

Mistakes
--------

  $ wrong() { refused rbf_inverse control "$@"; }
  $ wrong --equation "x' = u" --control u
  --minimise is required
  Run with --help for more information.
  $ wrong --control u --minimise T
  rbf_inverse: give one of --equation TEXT and --file NAME.ode
  $ point() { wrong --equation "x' = u; x(0) = 0; x(1) = 1" --control u "$@"; }
  $ point --minimise "u^2"
  rbf_inverse: --minimise: a control has to stand in an integral
  $ point --minimise "integral(u^2)*x(1)"
  rbf_inverse: --minimise integral(u^2)*x(1): the factor of an integral has to be a number
  $ point --minimise "integral(u)"
  rbf_inverse: --control u: equations and cost are linear in it, so it has no least cost between bounds; give both by --bounds
  $ point --minimise "integral(abs(u))" --bounds "-1 <= u <= 1"
  rbf_inverse: --equation: abs, sign, min, max, if and floor have no derivative where they switch; write abs(u) as the sum of two controls, each at least 0, a bound by --bounds or --state-bounds
  $ point --minimise "integral(u^2)" --bounds "2 <= u <= 1"
  rbf_inverse: --bounds: the lower bound 2 of u is not below the upper bound 1
  $ point --minimise "integral(u^2)" --bounds "x <= 1"
  rbf_inverse: --bounds x <= 1: must bound one control (u) by a number; bounds on states are --state-bounds
  $ point --minimise "integral(u^2)" --state-bounds "x = 1"
  rbf_inverse: --state-bounds x = 1: is no bound; give one such as -1 <= u <= 1
  $ point --minimise "integral(u^2)" --state-bounds "x <= q"
  rbf_inverse: --state-bounds:1:1: q is not defined: it has neither a derivative (q') nor a definition (q = ...)
    q
    ^
  $ wrong --equation "x(0) = 0; x' = u q; x(1) = 1" --control u --minimise "integral(u^2)"
  rbf_inverse: --equation:1:18: q is not defined: it has neither a derivative (q') nor a definition (q = ...)
    x(0) = 0; x' = u q; x(1) = 1
                     ^
  $ point --minimise "integral(u^2)" --conditions "u(0) = 1"
  rbf_inverse: --conditions: the control u can jump, so it cannot be prescribed at a time
  $ rbf_inverse control --equation "x' = u; x(0) = 0; x(1) = 2" --control u --minimise "integral(u^2)" --bounds "-1 <= u <= 1"
  rbf_inverse: infeasible: no control was found that leads to the prescribed values: the nearest is 1 off; loosen bounds or conditions, or give a --guess
  [1]
