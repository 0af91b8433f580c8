Comparing methods on a problem
==============================

  $ compare() { integrators compare "$@"; }
  $ ln -s "$TESTDIR/../../chapters" chapters

Digits are those of the end against a reference, which stands on standard error. Here they are also computed from what integrate prints and the
exact motion of the Duffing oscillator:

  $ compare --problem duffing --until 20 --methods rk4,ode45,adaptive-collocation --step 0.01 --tolerance 1e-7 > rows.csv
  integrators: reference: Taylor series of order 22 and Taylor series of order 28 agree to * digits (glob)
  $ cut -d, -f 1-3,7 rows.csv
  method,setting,status,note
  rk4,step 0.01,success,
  ode45,tolerance 1e-07,success,
  adaptive-collocation,tolerance 1e-07,success,
  $ holds --each 'seconds > 0' 'right_hand_sides > 100' < rows.csv
  $ for setting in "rk4 --step 0.01" "ode45 --tolerance 1e-7" "adaptive-collocation --tolerance 1e-7"; do
  >   integrators integrate --problem duffing --until 20 --method $setting > end.csv
  >   found=$(grep "^${setting%% *}," rows.csv | cut -d, -f 4)
  >   holds 'X := ellipfun("cn", sqrt(2)*t, m=0.25)' 'V := -sqrt(2)*ellipfun("sn", sqrt(2)*t, m=0.25)*ellipfun("dn", sqrt(2)*t, m=0.25)' \
  >     "-log10(max(abs(x/X - 1), abs(x'/V - 1))) = $found +- 0.01" < end.csv
  > done

Without a list it takes what suits the problem: rkn1210 only where the equation has no velocities, even with a factor that is zero at first;
methods of equal steps where a step is given; no explicit ones for a stiff problem:

  $ methods() { compare "$@" 2> said.txt > rows.csv; cut -d, -f 1 rows.csv | sed 1d | grep -x -e adaptive-collocation -e series -e ode45 -e rkn1210; }
  $ methods --equation "x'' + sin(x) = 0" --initial "x=1, x'=0" --until 5
  adaptive-collocation
  series
  ode45
  rkn1210
  $ methods --equation "x'' + x^2 x' + x = 0" --initial "x=0, x'=1" --until 5
  adaptive-collocation
  series
  ode45
  $ compare --equation "x'' + x = 0" --initial "x=0, x'=1" --until 5 --step 0.1 2> said.txt | holds --each 'status = "success"'
  $ methods --file chapters/integrators/examples/robertson.ode --until 1e4
  adaptive-collocation
  $ holds --each 'status = "success"' < rows.csv

A method that does not suit the problem keeps its row; --methods all takes all of this build:

  $ compare --problem van-der-pol --until 1 --methods "rkn1210, rk4 , ode45" --step 0.01 --tolerance 1e-9 2> said.txt > rows.csv
  $ cut -d, -f 1-3,7 rows.csv
  method,setting,status,note
  rkn1210,tolerance 1e-09,unsuitable,"rkn1210: the accelerations of this problem depend on velocities; take another method"
  rk4,step 0.01,success,
  ode45,tolerance 1e-09,success,
  $ holds 'digits > 6' < rows.csv
  $ compare --problem duffing --until 1 --methods all --step 0.001 --tolerance 1e-4 2> said.txt > rows.csv
  $ cut -d, -f 1 rows.csv | grep -x -e euler -e rkn1210 -e mtl -e adaptive-collocation
  euler
  rkn1210
  mtl
  adaptive-collocation
  $ holds --each 'n >= 21' 'digits > 1 if status == "success" else note != ""' < rows.csv

A typed equation by all of them; four digits are asked of a step, and multistep methods end with two:

  $ compare --equation "x'' + x + 0.1 x^3 = 0.2 cos(t)" --initial "x=1, x'=0" --until 2 --methods all --step 0.001 --tolerance 1e-4 2> said.txt |
  >   holds --each 'n > 20' 'status = "success"' 'digits > 1.5'

Tolerances
----------

A sweep by decades, or a list; all but the seconds is the same to the bit, and digits grow:

  $ sweep() { compare --equation "x'' = -x" --initial "x=1, x'=0" --until 20 --methods ode45,series --tolerances "$1"; }
  $ sweep 1e-3:1e-6 > decades.csv
  integrators: reference: Taylor series of order 22 and Taylor series of order 28 agree to * digits (glob)
  $ cut -d, -f 1-3 decades.csv
  method,setting,status
  ode45,tolerance 0.001,success
  ode45,tolerance 0.0001,success
  ode45,tolerance 1e-05,success
  ode45,tolerance 1e-06,success
  series,tolerance 0.001,success
  series,tolerance 0.0001,success
  series,tolerance 1e-05,success
  series,tolerance 1e-06,success
  $ cut -d, -f 5 --complement decades.csv > one.csv
  $ sweep 1e-3,1e-4,1e-5,1e-6 2> said.txt | cut -d, -f 5 --complement | cmp - one.csv
  $ for method in ode45 series; do grep "^$method," one.csv | cut -d, -f 4 | sort -n -u -c; done

Methods of equal steps take the step, the others the tolerances:

  $ both() { compare --equation "x'' = -x" --initial "x=1, x'=0" --until 2 --methods rk4,ode45 --tolerances 1e-3,1e-6 "$@" 2> said.txt | cut -d, -f 1-3,7-; }
  $ both
  method,setting,status,note
  rk4,tolerance 1e-09,unsuitable,"rk4: it takes equal steps: give a step, or a method with adaptive steps, as series or dop853"
  ode45,tolerance 0.001,success,
  ode45,tolerance 1e-06,success,
  $ both --step 0.1
  method,setting,status,note
  rk4,step 0.1,success,
  ode45,tolerance 0.001,success,
  ode45,tolerance 1e-06,success,
  $ compare --equation "x' = -x" --initial x=1 --until 1 --methods rk4,ode45 --step 0.1 --absolute-tolerance 1e-12 2> said.txt | cut -d, -f 1,2
  method,setting
  rk4,step 0.1
  ode45,tolerance 1e-09 absolute 1e-12

Nodes and shapes go to the methods that have them:

  $ compare --problem duffing --until 5 --methods rk4,rbf-coll,lgl-coll --step 0.5 --nodes 9 --shape 1 2> said.txt > rows.csv
  $ cut -d, -f 1,2 rows.csv
  method,setting
  rk4,step 0.5
  rbf-coll,step 0.5 nodes 9 shape 1
  lgl-coll,step 0.5 nodes 9
  $ holds --where method=rk4 'right_hand_sides = 40' < rows.csv

Over eight periods errors of steps add up to more than a hundred tolerances, which a note says; an error at a given step is no surprise:

  $ compare --problem duffing --until 50 --methods hoff,ode45 --tolerance 1e-8 2> said.txt > rows.csv
  $ cut -d, -f 1,7- rows.csv
  method,note
  hoff,"off by 1.* tolerances; a tolerance bounds the error of each step, not their sum" (glob)
  ode45,
  $ holds --where method=hoff 'digits < 4' < rows.csv
  $ compare --problem duffing --until 50 --methods rk4 --step 0.1 2> said.txt | cut -d, -f 1,7
  method,note
  rk4,

Failures and limits
-------------------

Runs that fail keep their rows, with the place in the note; where the solution ends there is no reference:

  $ compare --problem blow-up --until 1 --methods rk4,radau-coll --step 0.01 | cut -d, -f 1-4,7-
  integrators: no digits, because there is no reference: * (glob)
  integrators: non_finite: rk4: the step of 0.01 from t = 0.5* leads to a state that is not finite; the solution may blow up there, else take a smaller step or tolerance (glob)
  integrators: not_converged: radau-coll: the equations of the step of 0.01 from t = 0.5 were not solved in 50 iterations (not_converged); take a smaller step or tolerance
  method,setting,status,digits,note
  rk4,step 0.01,non_finite,,"rk4: the step of 0.01 from t = 0.5* leads to a state that is not finite; the solution may blow up there, else take a smaller step or tolerance" (glob)
  radau-coll,step 0.01,not_converged,,"radau-coll: the equations of the step of 0.01 from t = 0.5 were not solved in 50 iterations (not_converged); take a smaller step or tolerance"

The limit is that of the whole command:

  $ compare --problem three-dof --until 2000 --methods euler,backward-euler,newmark,hht --step 1e-5 --limit 2 2> said.txt | cut -d, -f 1,3
  method,status
  euler,time_limit
  backward-euler,time_limit
  newmark,time_limit
  hht,time_limit

Backwards
---------

y' = y^3 from 1 is 1/sqrt(1 - 2 t):

  $ compare --problem blow-up --until -3 --methods dop853 --tolerance 1e-12 2> said.txt | holds 'digits > 11'
  $ integrators integrate --problem blow-up --until -3 --method dop853 --tolerance 1e-12 | holds 'y = 1/sqrt(7) +- 1e-12'

Across the discontinuities of the impact, from after them:

  $ compare --problem impact --from 3 --until -1 --initial 0.5,-0.25 --methods dop853,adaptive-collocation --tolerance 1e-12 2> said.txt |
  >   holds --each 'n = 2' 'digits > 10.5'
