Methods of other libraries
==========================

  $ duffing() { integrators integrate --problem duffing "$@"; }
  $ X='X := ellipfun("cn", sqrt(2)*t, m=0.25)'
  $ V='V := -sqrt(2)*ellipfun("sn", sqrt(2)*t, m=0.25)*ellipfun("dn", sqrt(2)*t, m=0.25)'

At their tolerance of 1e-9 in some hundred steps:

  $ for peer in cvode-adams arkode-erk gsl-rk8pd odeint-dopri5; do
  >   duffing --until 5 --method $peer | holds 't = 5' "$X" "$V" 'x = X +- 1e-6' "x' = V +- 1e-6"
  > done

Of 85 rows those in the jump of a relaxation oscillation are verified, where an error in time is greatest:

  $ integrators integrate --problem van-der-pol --set mu=10 --initial 2,0 --until 11 --every 0.13 --method cvode-adams --tolerance 1e-8 | wc -l
  integrators: verified: 4.* digits at t = 9.23; x' is off by * (glob)
  87

An event, friction and an end before the end as by methods of nlmech (integrators_equations.t):

  $ integrators integrate --equation "x'' = -9.81; x(0) = 20; x'(0) = 0" --until 10 --event "x=0 end" --method cvode-adams |
  >   holds 'T := sqrt(40/9.81)' 'event = "x=0"' 't = T +- 1e-8*T' 'x = 0 +- 2e-7' "x' = -9.81*T +- 1e-7"
  $ friction() { integrators integrate --equation "x'' + x + 0.6 sign(x' - 0.5) = 0; x(0) = 0; x'(0) = 0.5" --tolerance 1e-12 --method cvode-bdf "$@"; }
  $ friction --until 1 | holds 'x = 0.5 +- 1e-11' "x' = 0.5 +- 1e-11"
  $ friction --until 3 | holds 'x = 0.6 + 0.5*sin(3 - 1.2) +- 1e-8'
  $ integrators integrate --equation "y' = -1/(2 y)" --initial 1 --until 2 --tolerance 1e-3 --method cvode-bdf
  integrators: outside_validity: a denominator of the equations becomes zero at t = 0.99 +- 0.02: the solution ends there; end the run before
  [1]

Runs that end with success and are far off: multistep formulas and extrapolation that underrate the errors of their steps. The right ends: the
leap of van der Pol's equation, cos 1e4 = -0.9521 and cn of the Duffing oscillator, each by two methods of other kinds.

  $ integrators integrate --problem van-der-pol --set mu=266.85 --until 200 --tolerance 4.2e-10 --method gsl-msadams
  integrators: not_converged: gsl-msadams: verified by integration, x at t = 200 is off by * times the tolerance *; the tolerance bounds the error of each step, not their sum: take --tolerance 1e-* or another method (--no-verify prints the unverified run; *) (glob)
  [1]
  $ duffing --set natural_frequency=1e4 --initial 1,0 --until 1 --tolerance 1e-6 --method gsl-bsimp
  integrators: not_converged: gsl-bsimp: verified by integration, x' at t = 1 is off by * times the tolerance *; the tolerance bounds the error of each step, not their sum: take --tolerance 1e-* or another method (--no-verify prints the unverified run; *) (glob)
  [1]
Half of the nine digits asked for are enough; standard error says how many there are:

  $ duffing --until 20 --method gsl-msbdf | holds "$X" 'x = X +- 1e-5'
  integrators: verified: 5.* digits at the end; x is off by *e-06 there, * tolerances; the problem multiplies errors by up to 1* (glob)

Rows are verified too: the cubic between ARKODE's steps is off by more than its tolerance, the ends of its steps are not. A run that is printed
is right to a hundred tolerances, or ten of what the shear makes of one, 10 x 20:

  $ duffing --until 20 --method arkode-erk --tolerance 1e-6 > ends.csv
  $ duffing --until 20 --method arkode-erk --tolerance 1e-6 --every 0.37 > rows.csv 2> said.txt ||
  >   grep -q 'verified by integration' said.txt
  $ [ ! -s rows.csv ] || holds --each "$X" 'x = X +- 2e-3' < rows.csv

Robertson's reactions: refused, or right (integrators_verified.t):

  $ for peer in cvode-bdf gsl-msbdf; do
  >   integrators integrate --problem robertson --until 1e11 --tolerance 1e-6 --method $peer > rows.csv 2> said.txt ||
  >     grep -q 'take a smaller absolute tolerance' said.txt || cat said.txt
  >   [ ! -s rows.csv ] || holds 'y1 = 0 +- 1e-4' 'y2 = 0 +- 1e-4' 'y3 = 1 +- 1e-4' < rows.csv
  > done

No Taylor series in extended precision gets through them; the digits of a comparison come from two methods that agree, and are no more than
these have in common:

  $ integrators compare --problem robertson --until 1e11 --methods adaptive-collocation --tolerance 1e-8 --absolute-tolerance 1e-16 |
  >   holds 'digits > 6' 'digits < 13'
  integrators: reference: adaptive-collocation and * agree to * digits (glob)

Methods of chosen steps are refused with a step:

  $ refused integrators compare --problem duffing --until 1 --methods ode45,cvode-bdf --step 0.1
  integrators: reference: Taylor series of order 22 and Taylor series of order 28 agree to * digits (glob)
  integrators: ode45: its steps are adaptive; give a tolerance, not a step
  integrators: cvode-bdf: its steps are adaptive; give a tolerance, not a step
  integrators: --methods: none of them suits the problem: ode45: its steps are adaptive; give a tolerance, not a step; cvode-bdf: its steps are adaptive; give a tolerance, not a step
