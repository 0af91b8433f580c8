Runs are compared with an independent one
=========================================

A run by a tolerance is integrated again by another method; a step that is given is the user's own:

  $ duffing() { integrators integrate --problem duffing --until 20 "$@"; }
  $ duffing --method newmark --step 0.1 > rows.csv

Where doubles are so far apart that rounding of the time is a noticeable part of a step, steps are refused. Of longer ones the last is as long as it
has to be, although the time at its start is rounded: 8000 s at 1 m/s.

  $ late() { integrators integrate --method rk4 --from 1e16 "$@"; }
  $ late --equation "x'' = -x" --initial 1,0 --until 10000000000000010 --step 1.5
  integrators: step_underflow: rk4: at t = 10000000000000000 times are rounded by a noticeable part of the step of 1.5; take a step of at least 1024, or count the time from the start
  [1]
  $ integrators integrate --method mtl --from 1e16 --equation "x'' = -x" --initial 1,0 --until 10000000000000010 --step 1.5
  integrators: step_underflow: mtl: at t = 10000000000000000 times are rounded by a noticeable part of the step of 1.5; take a step of at least 341.333, or count the time from the start
  [1]
  $ late --equation "x' = 1" --initial 0 --until 10000000000008000 --step 1501 | holds 'x = 8000 +- 1e-11'

Where the concentration that drives the others has become smaller than the absolute tolerance a run may leave the physical states, as
rounding decides. It is refused then; one that is printed is right to a hundred tolerances (Hairer and Wanner II, IV.10: x1 falls like 1/t):

  $ integrators integrate --problem robertson --method adaptive-collocation --until 1e14 > rows.csv 2> said.txt || grep -q 'take a smaller absolute tolerance' said.txt
  $ [ ! -s rows.csv ] || holds 'y1 = 0 +- 1e-7' 'y2 = 0 +- 1e-7' 'y3 = 1 +- 1e-7' < rows.csv

Up to 48 rows are all verified, and so is each of exactly 48: here the one with the greatest error is among the odd ones.

  $ masses() {
  >   integrators integrate --problem three-dof --method laier --from -1.8491272887126064 --until 72.1645941414463 \
  >   --set m1=0.612454598186901 --set c2=0.5 --set k1=16.63342507775686 --set k2=2.715078751560266 --set k3=0.13515582326371672 --set frequency=0.14356348048273132 \
  >   --initial -0.1,0,0,-0.7181212438446362,-0.42174430937270013,0.07549993333308734 --tolerance 9.92e-7 --absolute-tolerance 4.92e-8 "$@"
  > }
  $ masses --every 1.541952529792896 > rows.csv
  integrators: not_converged: laier: verified by integration, x1' at t = 2.7767303 is off by * times the tolerance 9.92e-07, where * (glob)
  [1]
  $ [ ! -s rows.csv ]
Fast forces
-----------

A force that turns 160 000 times is verified; one that turns too often for the limit is refused before the run:

  $ integrators integrate --equation "x' = cos(10 t)" --initial x=0 --until 1e5 | holds 'x = sin(10**6)/10 +- 1e-7'
  $ integrators integrate --equation "x' = cos(1000 t)" --initial x=0 --until 1e5 --limit 5
  integrators: time_limit: a force of frequency 1000 goes through 1.6e+07 periods from t = 0 to 100000, which takes at least 8 s, more than the limit of 5 s; take an earlier end, or replace the force by its mean
  [1]
