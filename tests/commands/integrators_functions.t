Functions with jumps, and others, in equations as one types them
================================================================

  $ integrate() { integrators integrate --equation "$@"; }

The inverse functions undo those that they are inverses of: all three solutions are t, by slopes that are 1.

  $ integrate "x' = sinh(asinh(x))/x; y' = cosh(acosh(1 + y^2)) - y^2; z' = 1/(1 - tanh(atanh(z/4))^2 + z^2/16)" --initial "x=1, y=0.5, z=0.2" --until 2 |
  >   holds 'x = 3 +- 1e-8' 'y = 2.5 +- 1e-8' 'z = 2.2 +- 1e-8'

Integrals of sec^2, csc^2 and cot, and of logarithms to three bases:

  $ integrate "x' = sec(t)^2; y' = csc(t)^2; z' = cot(t); u' = ln(t); v' = log2(t); w' = log10(t)" --initial "x=0, y=0, z=0, u=0, v=0, w=0" --from 0.5 --until 1.25 |
  >   holds 'x = tan(1.25) - tan(0.5) +- 1e-8' 'y = cot(0.5) - cot(1.25) +- 1e-8' 'z = log(sin(1.25)/sin(0.5)) +- 1e-8' \
  >         'I := (1.25*log(1.25) - 1.25) - (0.5*log(0.5) - 0.5)' 'u = I +- 1e-8' 'v = I/log(2) +- 1e-8' 'w = I/log(10) +- 1e-8'

What jumps at known times
-------------------------

A saw-tooth has the mean 1/2; methods step onto its jumps, those of fixed step too:

  $ saw() { integrate "y' = t - floor(t); y(0) = 0" --until 10 "$@"; }
  $ for method in "" "--method ode45" "--method rk4 --step 0.3" "--method adaptive-collocation" "--method series"; do
  >   saw $method | holds 'y = 5 +- 1e-9'
  > done
  integrators: the equations change at t = 1 and 8 more times: steps end there
  integrators: the equations change at t = 1 and 8 more times: steps end there
  integrators: the equations change at t = 1 and 8 more times: steps end there
  integrators: the equations change at t = 1 and 8 more times: steps end there
  integrators: the equations change at t = 1 and 8 more times: steps end there
  $ integrate "y' = mod(t, 1); z' = frac(t); u' = ceil(t)" --initial "y=0, z=0, u=0" --until 10 | holds 'y = 5 +- 1e-9' 'z = 5 +- 1e-9' 'u = 55 +- 1e-8'
  integrators: the equations change at t = 1 and 8 more times: steps end there

Backwards and from a time that is no jump, with a period that doubles do not hold:

  $ integrate "y' = mod(t, 0.1)" --initial y=0 --from 1.25 --until 0.25 | holds 'y = -0.05 +- 1e-10'
  integrators: the equations change at t = 0.3 and 9 more times: steps end there

A square wave drives an oscillator: x = 1 - cos(t) while it is 1. Its state at t = 2, 4, ... by rotations about (1, 0) and (-1, 0):

  $ integrate "x'' + x = if(mod(t, 2) < 1, 1, -1); x(0) = 0; x'(0) = 0" --until 4 > rows.csv
  integrators: the equations change at t = 1 and 2 more times: steps end there
  $ holds 'a := 1 - exp(-1j)' 'b := -1 + (a + 1)*exp(-1j)' 'c := 1 + (b - 1)*exp(-1j)' 'd := -1 + (c + 1)*exp(-1j)' \
  >       "x = re(d) +- 4e-8" "x' = im(d) +- 4e-8" < rows.csv

A step, one side of a time, and the same by a condition; 1 lasts from t = 1 to 3:

  $ integrate "x' = if(t > 1, 1, 0); y' = step(t - 1); z' = heaviside(3 - t)" --initial "x=0, y=0, z=0" --until 3.5 |
  >   holds 'x = 2.5 +- 1e-9' 'y = 2.5 +- 1e-9' 'z = 3 +- 1e-9'
  integrators: the equations change at t = 1 and 1 more time: steps end there
  $ integrate "x' = if(t > 1 and not (t >= 3 or t < 0), 1, 0)" --initial x=0 --until 5 | holds 'x = 2 +- 1e-9'
  integrators: the equations change at t = 1 and 1 more time: steps end there

What jumps on a surface of the state
------------------------------------

A spring that pulls alone: half a swing of each of the frequencies 1 and 2:

  $ integrate "x'' = -if(x > 0, 1, 4) x; x(0) = 0; x'(0) = 1" --until "3*pi/2 - 0.1" |
  >   holds 'x = -sin(2*(pi/2 - 0.1))/2 +- 1e-8' "x' = -cos(2*(pi/2 - 0.1)) +- 1e-8"

Stairs: the slope between k and k + 1 is k, by every method, and a turn of mod(x, 1) takes log(2):

  $ for method in "" "--method ode45" "--method series" "--method rk4 --step 0.01" "--method adaptive-collocation"; do
  >   integrate "x' = floor(x)" --initial x=1.5 --until 1.5 $method | holds 'x = 4 + 4*(1 - 1/2 - 1/3) +- 1e-8'
  >   integrate "x' = 1 + mod(x, 1)" --initial x=0 --until "3.5*log(2)" $method | holds 'x = 2 + sqrt(2) +- 1e-7'
  > done
  $ integrate "x' = -floor(2 x)/2" --initial x=1.2 --until 5 --every 1 | holds --each 'x = [1.2, 0.6, 0.5, 0.5, 0.5, 0.5] +- 1e-8'
  $ integrate "x' = floor(3 sin(t))" --initial x=0 --until "2*pi" | holds 'x = -pi +- 1e-8'

A phase that wraps has the events of one that does not:

  $ integrate "a' = 2 + sin(a)" --initial a=0 --until 10 --event "turn: sin(a/2) = 0" --columns "b = mod(a, 2*pi)" > turns.csv
  $ holds --where event=turn 'n = 2' 't = 2*pi*(i + 1)/sqrt(3) +- 1e-8' < turns.csv
  $ integrate "a' = 2 + sin(mod(a, 2*pi))" --initial a=0 --until "2*pi/sqrt(3)" | holds 'a = 2*pi +- 1e-7'

At an integer floor has the value of the upper side, on which this solution stays:

  $ integrate "x' = floor(x)" --initial x=0 --until 1
  integrators: the solution from t = 0 is not unique: it may go to either side of a switching surface; this run takes the side where the switching function is greater
  t,x
  0,0
  1,0

A surface that jumps itself: x falls to it, moves with it, and falls again after its jump:

  $ integrate "x' = -2 if(x > mod(t, 1), 1, -1); x(0) = 0.5" --until 2.5 --at 1/6,1,4/3,2.2 | holds --each 'x = [1/2, 1/6, 1, 1/3, 0.6, 0.5] +- 1e-8'
  integrators: the equations change at t = 1 and 1 more time: steps end there

One that is crossed and jumps back, forwards and backwards:

  $ cross="x' = if(x > mod(t, 1), 0.1, -0.1)"
  $ integrate "$cross" --initial x=0.2 --until 2 --at 2/9 --every 1 | holds --each 'x = [0.2, 2/9, 13/90, 6.2/81] +- 1e-8'
  integrators: the equations change at t = 1: steps end there
  $ integrate "$cross" --initial x=6.2/81 --from 2 --until 0 --every 1 | holds --each 'x = [6.2/81, 13/90, 0.2] +- 1e-8'
  integrators: the equations change at t = 1: steps end there

Numbers of time are expressions
-------------------------------

  $ swing() { integrate "x'' = -w^2 x; w = 2; x(0) = 1; x'(0) = 0" "$@"; }
  $ swing --from 0 --until "2 pi/w" --every pi/8 > rows.csv
  $ holds --each 't = i*pi/8 +- 1e-15*(1+t)' 'x = cos(2*t) +- 2e-8' 'n = 9' < rows.csv
  $ swing --set w=1 --from pi --until 2*pi --step pi/64 --method rk4 | holds 't = 2*pi +- 1e-15' 'x = -1 +- 1e-6'

Rows at times that are asked for, among those at equal distances; none stands twice:

  $ swing --until 1 --at 0,1/4,0.6,1 | cut -d, -f 1 | paste -s -d '|'
  t|0|0.25|0.59999999999999998|1
  $ swing --until 1 --every 0.2 --at '0.5,0.6,sqrt(0.5)' | holds --each 't = [0, 0.2, 0.4, 0.5, 0.6, sqrt(1/2), 0.8, 1] +- 1e-15' 'x = cos(2*t) +- 4e-9'
  $ swing --from 1 --until 0 --at 0.25,0.75 | holds --each 't = [1, 0.75, 0.25, 0]'

Tables
------

Values by the time, straight between two rows; methods step onto the rows. The areas below, and a ramp on an oscillator, x = t - sin(t):

  $ printf 't,load\n0,0\n1,2\n3,2\n4,-1\n' > load.csv
  $ printf '0,0\n10,10\n' > ramp.csv
  $ for method in "" "--method ode45" "--method rk4 --step 0.3" "--method series"; do
  >   integrate 'x1 = table("load.csv"); x'"' = x1; y' = "'table("load.csv", steps)' --initial "x=0, y=0" --until 4 $method | holds 'x = 5.5 +- 1e-9' 'y = 6 +- 1e-9'
  > done
  integrators: the equations change at t = 1 and 1 more time: steps end there
  integrators: the equations change at t = 1 and 1 more time: steps end there
  integrators: the equations change at t = 1 and 1 more time: steps end there
  integrators: the equations change at t = 1 and 1 more time: steps end there
  $ integrate "x'' + x = table(\"ramp.csv\"); x(0) = 0; x'(0) = 0" --until 10 --every 2.5 --columns 'u = table("ramp.csv")' |
  >   holds --each 'x = t - sin(t) +- 1e-7' 'u = t +- 1e-15'
  $ integrate "x' = table(\"load.csv\")" --initial x=5.5 --from 4 --until 0 | holds 'x = 0 +- 1e-9'
  integrators: the equations change at t = 1 and 1 more time: steps end there

A surface made of one: x climbs to it, moves with it and cannot follow when it falls:

  $ integrate 'x1 = table("load.csv"); x'"' = if(x > x1, -1, 1); x(0) = 0" --until 4 --at 1,2,2.5,3 | holds --each 'x = [0, 1, 2, 2, 2, 1] +- 1e-8'
  integrators: the equations change at t = 1 and 1 more time: steps end there

A file of equations has its tables beside it:

  $ mkdir folder && mv ramp.csv folder && echo "x' = table(\"ramp.csv\"); x(0) = 0" > folder/ramp.ode
  $ integrators integrate --file folder/ramp.ode --until 4 | holds 'x = 8 +- 1e-8'

What is refused
---------------

  $ equation() { refused integrators integrate --until 1 --equation "$@"; }
  $ equation "x' = arctan(x)" --initial x=1
  integrators: --equation:1:6: arctan is not a function here; atan is
    x' = arctan(x)
         ^^^^^^
  $ equation "x' = x(t-1)" --initial x=1
  integrators: --equation:1:6: x at another time: delays are not supported; for a product write x*(...), or a blank before the bracket
    x' = x(t-1)
         ^
  $ equation "x' = mod(t, x)" --initial x=1
  integrators: --equation:1:13: the second argument of mod must be a number other than 0
    x' = mod(t, x)
                ^
  $ equation "x' = mod(t, 1e-9)" --initial x=1
  integrators: --until 1: floor, ceil, frac or mod jump more than a million times before this time; give an earlier end, or longer periods
  $ refused integrators integrate --equation "x' = -x" --initial x=1 --until 2*q
  integrators: --until:1:3: q is not defined: it has neither a derivative (q') nor a definition (q = ...)
    2*q
      ^
  $ refused integrators integrate --equation "x' = -x" --initial x=1 --until 2*x
  integrators: --until:1:1: a time must be a number, or an expression of constants
    2*x
    ^^^
  $ equation "x' = -x" --initial x=1 --every 1-2
  integrators: --every 1-2: must be positive
  $ equation "x' = -x" --initial x=1 --at 0.5,1.5
  integrators: --at 1.5: is outside the run, from 0 to 1
  $ equation "x' = -x" --initial x=1 --section x=0.5 --at 0.5
  integrators: --section prints only its own rows; leave out --event, --every and --at
  $ loaded() { equation "x' = -x + table(\"$1\")" --initial x=1; }
  $ loaded nosuch.csv
  integrators: table nosuch.csv: there is no such file
  $ printf 't,load\n0,0\n1,two\n' > bad.csv && loaded bad.csv
  integrators: table bad.csv: line 3: 'two' is not a finite number
  $ printf '0,0\n1,2\n1,3\n' > bad.csv && loaded bad.csv
  integrators: table bad.csv: line 3: the time 1 does not come after 1
  $ printf '0,0,1\n' > bad.csv && loaded bad.csv
  integrators: table bad.csv: line 1: a row must have two cells, time and value; this one has 3
  $ printf '0,0\n' > bad.csv && loaded bad.csv
  integrators: table bad.csv: fewer than two rows
  $ printf '0,0\n0.5,0\n' > short.csv && loaded short.csv
  integrators: --until 1: the run goes from 0 to 1, and the tables of the equations from 0 to 0.5
  $ equation "x' = table(load.csv)" --initial x=1
  integrators: --equation:1:12: the name of a file must be in quotation marks: table("load.csv")
    x' = table(load.csv)
               ^
  $ equation "x' = table(\"load.csv)" --initial x=1
  integrators: --equation:1:12: the name of a file must end with a quotation mark
    x' = table("load.csv)
               ^
