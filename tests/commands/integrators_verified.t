Runs are compared with an independent one
=========================================

A run by a tolerance is integrated again by another method; a step that is given is the user's own:

  $ duffing() { integrators integrate --problem duffing --until 20 "$@"; }
  $ duffing --method newmark --step 0.1 > rows.csv

Where the concentration that drives the others has become smaller than the absolute tolerance a run may leave the physical states, as
rounding decides. It is refused then; one that is printed is right to a hundred tolerances (Hairer and Wanner II, IV.10: x1 falls like 1/t):

  $ integrators integrate --problem robertson --method adaptive-collocation --until 1e14 > rows.csv 2> said.txt || grep -q 'take a smaller absolute tolerance' said.txt
  $ [ ! -s rows.csv ] || holds 'y1 = 0 +- 1e-7' 'y2 = 0 +- 1e-7' 'y3 = 1 +- 1e-7' < rows.csv

Fast forces
-----------

A force that turns 160 000 times is verified; one that turns too often for the limit is refused before the run:

  $ integrators integrate --equation "x' = cos(10 t)" --initial x=0 --until 1e5 | holds 'x = sin(10**6)/10 +- 1e-7'
  $ integrators integrate --equation "x' = cos(1000 t)" --initial x=0 --until 1e5 --limit 5
  integrators: time_limit: a force of the frequency 1000 turns 1.6e+07 times from t = 0 to 100000, which takes 8 s at least, more than the limit of 5 s; take an earlier end, or the mean of the force
  [1]
