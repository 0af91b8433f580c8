Derivatives of a solution by its initial values and parameters
==============================================================

  $ integrate() { integrators integrate --equation "$@"; }

The logistic equation has x = K x0 E/(K + x0 (E - 1)) with E = exp(r t), and dx/dr = t x (1 - x/K), as x depends on r t:

  $ integrate "x' = r x (1 - x/K); r = 1.5; K = 2; x(0) = 0.25" --until 2 --every 0.5 --sensitivities "x,r, K" > logistic.csv
  $ head -2 logistic.csv
  t,x,dx/dx,dx/dr,dx/dK
  0,0.25,1,0,0
  $ holds --each 'E := exp(1.5*t)' 'below := 2 + 0.25*(E - 1)' 'dx/dx = 4*E/below^2 +- 1e-7' 'dx/dr = t*x*(1 - x/2) +- 1e-7' \
  >   'dx/dK = 0.0625*E*(E - 1)/below^2 +- 1e-7' < logistic.csv

By all initial values, in the order in which `--initial` names them; the columns of a name stand together. An oscillator turns:

  $ integrate "x'' = -x" --initial "x'=0, x=1" --until 1 --sensitivities all --method rkn1210 > turn.csv
  $ head -1 turn.csv
  t,x',x,dx'/dx,dx/dx,dx'/dx',dx/dx'
  $ holds "dx/dx = cos(1) +- 1e-8" "dx/dx' = sin(1) +- 1e-8" "dx'/dx = -sin(1) +- 1e-8" "dx'/dx' = cos(1) +- 1e-8" < turn.csv

An initial value that is an expression of a parameter depends on it, here x(0) = 3 a, so that x = 3 a exp(-a t):

  $ integrate "x' = -a x; x(0) = 3 a; a = 0.5" --until 2 --sensitivities a | holds 'dx/da = 3*exp(-1)*(1 - 0.5*2) +- 1e-8'
  $ integrate "x' = -a x; a = 0.5" --initial "x=3 a" --until 2 --sensitivities a | holds 'dx/da = 0 +- 1e-8'
  $ integrate "x' = -a x; a = 0.5" --initial 1.5 --until 2 --sensitivities a | holds 'dx/da = -2*1.5*exp(-1) +- 1e-8'

With steps that see the solution alone, which is constant here, the derivative exp(t) is wrong, which verification finds; steps that see
both are right:

  $ integrate "x' = sin(x); x(0) = 0" --until 10 --sensitivities x --method ode45 > /dev/null
  integrators: not_converged: ode45: verified by integration, dx/dx at t = 10 is off by * (glob)
  [1]
  $ integrate "x' = sin(x); x(0) = 0" --until 10 --sensitivities x --method ode45 --control-sensitivities | holds 'dx/dx = exp(10) +- 1e-2'

Events and switches
-------------------

A ball that falls from h bounces at t1 = sqrt(2 h/g) with the coefficient e; then y = e g t1 s - g s^2/2 with s = t - t1. The time of the
bounce depends on h, so that the derivatives jump there:

  $ integrate "y'' = -9.81; e = 0.8; y(0) = 2; y'(0) = 0" --until 1 --event "bounce: y=0 falling" --set-at "bounce: y' = -e y'" \
  >   --sensitivities y,e > ball.csv
  $ holds 'T := sqrt(4/9.81)' 'dy/de = 9.81*T*(1 - T) +- 1e-8' 'dy/dy = (0.8*(1 - 2*T) + 1 - T)/T +- 1e-8' < ball.csv

At given times nothing but the factor counts. Doses of b at 0 and 1, with the decay exp(-a t):

  $ integrate "c' = -a c; a = 0.5; b = 2; c(0) = 0; at t = 0:1:1: c -> c + b" --until 2 --sensitivities a,b |
  >   holds 'dc/db = exp(-1) + exp(-0.5) +- 1e-8' 'dc/da = -2*(2*exp(-1) + exp(-0.5)) +- 1e-8'

Equations that switch, with a jump of the slope from 1 to 3 at x = 1:

  $ integrate "x' = if(x < 1, a, 3); a = 1; x(0) = 0" --until 2 --sensitivities x,a | holds 'dx/dx = 3 +- 1e-8' 'dx/da = 3 +- 1e-8'

Where the solution stays on a surface, or at the zero of a root, or where a parameter moves a switch, there is no answer:

  $ integrate "x' = 0.5 - sign(x); x(0) = 1" --until 4 --sensitivities x --method dop853
  integrators: outside_validity: switching at t = *: sensitivities do not continue where the solution stays on the surface of switching function 1; end before, or smooth the equation there (glob)
  [1]
  $ integrate "h' = -sqrt(h); h(0) = 1" --until 3 --sensitivities h --method dop853 > /dev/null
  integrators: * (glob)
  [1]
  $ refused integrators integrate --equation "x' = step(t - a); a = 1; x(0) = 0" --until 2 --sensitivities a
  integrators: --sensitivities a: the equations switch where a decides, which is not supported for a parameter; make it a component, a' = 0 with a(0) = 1, and ask for its initial value
  $ integrate "x' = step(t - a); a' = 0; a(0) = 1; x(0) = 0" --until 2 --sensitivities a | holds 'dx/da = -1 +- 1e-8'

Wrong use
---------

  $ run() { refused integrators integrate --equation "x'' = -w x; w = 1; x(0) = 1; x'(0) = 0" --until 1 "$@"; }
  $ run --sensitivities x,v
  integrators: --sensitivities v: neither an initial value nor a parameter; choose from x,x',w
  $ run --sensitivities w,all,w
  integrators: --sensitivities: w is given twice
  $ run --sensitivities "x,,w"
  integrators: --sensitivities : neither an initial value nor a parameter; choose from x,x',w
  $ run --control-sensitivities
  integrators: --control-sensitivities: needs --sensitivities
  $ run --sensitivities x --states rows.csv
  integrators: --sensitivities x: belongs to a single run; leave out --states
  $ run --sensitivities x --initial 1,0,0
  integrators: --initial 1,0,0: 3 numbers for the 2 components x,x' of the equation: x'' = -w x
