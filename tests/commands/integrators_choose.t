Which method suits a problem
============================

  $ choose() { integrators choose "$@"; }
  $ ln -s "$TESTDIR/../../chapters" chapters
  $ equation="x'' + 0.1 x' + x + a x^3 = 0.2 cos(1.1 t); a = 3"

The ranks with their reasons, and on standard error the command that runs the first:

  $ choose --equation "$equation" --initial "x=1, x'=0" --until 20 --set a=4 > ranks.csv
  integrators integrate --equation "x'' + 0.1 x' + x + a x^3 = 0.2 cos(1.1 t); a = 3" --set a=4 --initial "x=1, x'=0" --until 20 --method series --tolerance *e-11 (glob)
  $ cat ranks.csv
  rank,method,tolerance,seconds,reason
  1,series,*,*,"9 digits, errors amplified 5.1 times; not stiff (*); smooth, *; a right-hand side takes * s; about * right-hand sides; test run over the whole interval" (glob)
  2,*,*,*,"next by the same rule; about * right-hand sides; test run over the whole interval" (glob)
  3,*,*,*,"next by the same rule; about * right-hand sides; test run over the whole interval" (glob)
  $ holds --each 'n >= 2' 'rank = i + 1' 'tolerance > 0.9e-13' 'tolerance < 1e-7' 'seconds > 0' < ranks.csv
  $ choose --equation "$equation" --initial "x=1, x'=0" --until 20 --set a=4 --digits 6 2> command.txt > ranks.csv
  $ method=$(sed -n 2p ranks.csv | cut -d, -f 2) tolerance=$(sed -n 2p ranks.csv | cut -d, -f 3)
  $ grep -o "method $method --tolerance $tolerance" command.txt | sed "s/$tolerance/.../"
  method series --tolerance ...
  $ sh command.txt | sed -n 1p
  t,x,x'

  $ first() { integrators choose "$@" 2> said.txt | sed -n 2p | cut -d, -f 2; }
  $ first --problem duffing --until 100
  rkn1210
  $ first --problem lorenz --until 5
  series
  $ first --problem van-der-pol --set mu=1000 --until 2000
  adaptive-collocation
  $ first --file chapters/integrators/examples/friction.ode --until 20
  series

More digits than rounding leaves: Lorenz's attractor multiplies errors by e^(0.9 t). And a solution that ends before the end:

  $ choose --problem lorenz --until 25 --digits 14 > ranks.csv
  integrators: the problem multiplies errors by *, so that rounding alone leaves about * of the 14 digits (glob)
  integrators integrate --problem lorenz --until 25 --method series --tolerance * (glob)
  $ choose --equation "x' = x^2" --initial x=1 --until 2
  integrators: step_underflow: adaptive-collocation: even the shortest step, *, from t = 1.0* misses the tolerance; the solution may be singular there, else loosen it (glob)
  [1]

integrate without a method takes what choose says for nine digits, among those that have what is asked for:

  $ same() { first "$@"; integrators integrate "$@" > a.csv; integrators integrate "$@" --method "$(first "$@")" | cmp - a.csv; }
  $ same --problem duffing --until 100
  rkn1210
  $ same --problem lorenz --until 5
  series
  $ same --file chapters/integrators/examples/van-der-pol.ode --until 1000
  adaptive-collocation
  $ same --equation "$equation" --initial "x=1, x'=0" --until 20
  series
  $ for asked in "--order 18" "--every 1" "--event x=0"; do
  >   integrators integrate --problem duffing --until 10 $asked > a.csv
  >   integrators integrate --problem duffing --until 10 $asked --method series | cmp - a.csv
  > done

Mistakes:

  $ refused integrators choose --equation "$equation" --initial "x=1, x'=0" --until 20 --digits 15
  integrators: --digits 15: must be a whole number from 1 to 14
  $ refused integrators choose --equation "$equation" --initial "x=1, x'=0" --until 20 --digits 0
  integrators: --digits 0: must be a whole number from 1 to 14
  $ refused integrators choose --equation "$equation" --initial "x=1, x'=0" --until 0
  integrators: --until 0: is the start time; give another end
  $ refused integrators choose --equation "$equation" --initial "x=1, x'=0" --until 20 --set b=1
  integrators: --set b: the equation has no such definition; choose one of a
  $ refused integrators choose --equation "$equation" --initial "x=1, x'=0"
  integrators: --until: missing; give the time at which the run ends, or t <= ... in the text
  $ refused integrators choose --until 1
  integrators: give one of --problem NAME, --equation TEXT and --file NAME.ode
  $ refused integrators choose --equation "x' = -y" --initial x=1 --until 1
  integrators: --equation:1:7: y is not defined: it has neither a derivative (y') nor a definition (y = ...)
    x' = -y
          ^
