The columns of a run
====================

  $ integrate() { integrators integrate --equation "$@"; }

Further columns
---------------

Definitions of the text by name, new ones, and highest derivatives, behind the state:

  $ integrate "x'' = -x + F; F = 0.5 cos(2 t); x(0) = 1; x'(0) = 0" --until 3 --every 1 --columns "F; E = x'^2/2 + V; V = x^2/2" "x''; twice = 2 E" --event "x=0" > rows.csv
  $ head -1 rows.csv
  t,x,x',F,E,V,x'',twice,event
  $ holds --each "F = 0.5*cos(2*t) +- 1e-15" "V = x^2/2 +- 1e-15" "E = x'^2/2 + V +- 1e-15" "x'' = F - x +- 1e-15" 'twice = 2*E +- 1e-15' < rows.csv

The energy of an oscillator is that of its start; so is the area of a section's points:

  $ integrate "x'' = -x; x(0) = 1; x'(0) = 0" --until 20 --section "x=0 rising" --columns "E = x'^2/2 + x^2/2" | holds --each 'E = 1/2 +- 1e-7'

With --states they have the parameters of each row:

  $ printf 'k,E\n1,7\n4,8\n' > springs.csv
  $ integrate "x'' = -k x; k = 1; x(0) = 1; x'(0) = 0" --until 1 --states springs.csv --columns "E = x'^2/2 + k x^2/2" > rows.csv
  $ head -1 rows.csv
  row,t,x,x',E,input_E,status
  $ holds --each 'E = [1/2, 1/2, 2, 2] +- 1e-8' < rows.csv

While a motion stays on a surface of the equations, columns have the values that keep it there: sign(x) is 0.3 where x' = 0.3 - sign(x) is 0, from
t = 5/7 on. A mass on a belt of speed 1 sticks until the spring is as strong as the friction: -x = 2 sign(x' - 1):

  $ for method in "dop853" "series" "ode45 --tolerance 1e-4" "rk4 --step 0.01"; do
  >   integrate "x' = 0.3 - sign(x)" --initial x=0.5 --until 3 --every 0.5 --columns "s = sign(x); x'; two = 2 abs(x) + s" --method $method |
  >     holds --each 's = (1 if t < 0.7 else 0.3) +- 1e-7' "x' = (-0.7 if t < 0.7 else 0) +- 1e-7" 'two = s + 2*abs(x) +- 1e-7'
  >   integrate "x'' = -x - 2 sign(x' - 1)" --initial "x=0, x'=1" --until 3 --every 0.25 --columns "friction = -2 sign(x' - 1); x''" --method $method > belt.csv
  >   awk -F, 'NR == 1 || $1 < 2' belt.csv | holds --each 'friction = x +- 1e-7' "x'' = 0 +- 1e-7" 'x = t +- 1e-7'
  >   holds 'friction = 2 +- 1e-7' < belt.csv
  > done

The order of the columns
------------------------

That in which the text first names the unknowns, or in which --initial names all of them:

  $ lorenz="x' = 10 (z - x); z' = x (28 - y) - z; y' = x z - 8/3 y"
  $ integrate "$lorenz" --initial "x=1, y=2, z=3" --until 0 | head -2
  t,x,y,z
  0,1,2,3
  $ integrate "$lorenz" --initial "1,3,2" --until 0 | head -2
  t,x,z,y
  0,1,3,2
  $ printf 'y\n5\n' > one.csv
  $ integrate "$lorenz" --initial "y=2, x=1, z=3" --until 0 --states one.csv | head -2
  row,t,y,x,z,status
  1,0,5,1,3,success

Components without a digit
--------------------------

exp(-5 t) times 1e-10 stays below the absolute tolerance, and nothing of it is known; a zero is one:

  $ tiny() { integrate "x' = -5 x; y' = x - y; z' = -z" --initial "x=1e-10, y=1, z=0" --until 1 "$@"; }
  $ tiny 2>&1 > rows.csv
  integrators: x stays below the absolute tolerance 1e-09: none of its digits is certain; take a smaller --absolute-tolerance
  $ tiny --absolute-tolerance 1e-20 | holds 'x = 1e-10*exp(-5) +- 1e-18'

What is refused
---------------

  $ columns() { refused integrators integrate --equation "x'' = -x; x(0) = 1; x'(0) = 0; r = 2 x" --until 1 --columns "$@"; }
  $ columns "E = x'^2/2 + V"
  integrators: --columns:1:14: V is not defined: it has neither a derivative (V') nor a definition (V = ...)
    E = x'^2/2 + V
                 ^
  $ columns "r" "r = 3"
  integrators: --columns:1:1: r is already defined; take another name
    r = 3
    ^
  $ columns "x"
  integrators: --columns:1:1: x is a column already
    x
    ^
