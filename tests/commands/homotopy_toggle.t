The toggle: loads at limit points, deflections under a load
===========================================================

Limit points
------------

  $ homotopy limit-points --height 0.44 > points.csv
  limit-points: mesh error of the loads up to 2.5e-05, relative, estimated from 4 and 6 elements a member
  $ cut -d, -f 1,4 points.csv
  kind,motion
  maximum,symmetric
  minimum,symmetric
  $ cut -d, -f 3 points.csv | sed 1d | sort -g -u -c

The maximum comes before the minimum; a low toggle has neither:

  $ limit_points() { homotopy limit-points --height "$@" 2> said.txt; }
  $ first() { grep -m 1 "$1" points.csv | sed '1i kind,load,deflection,motion'; }
  $ for words in "" "--model williams" "--elements 1"; do limit_points 0.32 $words; done
  kind,load,deflection,motion
  kind,load,deflection,motion
  kind,load,deflection,motion

Of one element and of sixteen a member, and of Williams' equation:

# oracle: homotopy_williams Williams 0.?? maximum, Williams 0.?? minimum
# oracle: homotopy_frames toggle 0.?? of 1 m*imum, toggle 0.44 of 4 m*, toggle 0.44 of 16 m*
  $ while read -r maximum minimum words; do
  >   limit_points $words < /dev/null | holds --each 'kind = "maximum" if i == 0 else "minimum"' "load = [$maximum, $minimum] +- 1e-10*load"
  > done <<END
  > 42.435492120383 32.124218754757 0.44 --elements 1
  > 42.4387099966 32.1222520061 0.44
  > 42.4397089470 32.1221702414 0.44 --model element --elements 16
  > 42.771896097273 30.363548710287 0.44 --model williams
  > 33.278532607761 30.588387926087 0.38 --model williams
  > 33.122797603353 31.107808393235 0.38 --elements 1
  > END

Members bow before the limit, unless one element is asked for, which says so. Known loads of a path of short steps: 642.99 and 964.03 for a
height of 2, 258.7 and 266.7 for 1; with four elements the three at height 1, 161.0617, 258.7358 and 266.6795 for eight, are within m^-2 of 1e-3:

  $ limit_points 2 --elements 8 > points.csv
  $ head -3 points.csv | cut -d, -f 1,4
  kind,motion
  bifurcation,antisymmetric
  bifurcation,symmetric
  $ first ,symmetric | holds 'load = 642.99 +- 0.05'
  $ first maximum | holds 'load = 964.03 +- 0.05'
  $ limit_points 1 --elements 8 > points.csv
  $ head -3 points.csv | cut -d, -f 1,4
  kind,motion
  bifurcation,antisymmetric
  bifurcation,symmetric
  $ first ,symmetric | holds 'load = 258.7 +- 0.05'
  $ first maximum | holds 'load = 266.7 +- 0.05'
  $ limit_points 1 | sed -n 1,4p > points.csv
  $ cut -d, -f 1,4 points.csv
  kind,motion
  bifurcation,antisymmetric
  bifurcation,symmetric
  maximum,symmetric
  $ holds --each 'load = [161.0617, 258.7358, 266.6795] +- 2.5e-4*load' < points.csv

Two bifurcations between which one more motion is unstable, beside a third that is not: the motions that are unstable at the ends of the step
do not show them. Loads by `tests/randomised/commands/half_toggle.py`, to their printed digits:

  $ limit_points 12.783486250373349 --elements 2 | tail -n 4 > points.csv
  $ cut -d, -f 1,4 points.csv
  bifurcation,antisymmetric
  bifurcation,symmetric
  bifurcation,antisymmetric
  bifurcation,antisymmetric
  $ (echo kind,load,deflection,motion; sed -n 2,3p points.csv) | holds --each 'load = [-6450.87, -6379.09] +- 0.005' 'deflection = [12.934, 12.946] +- 5e-4'
  $ homotopy limit-points --height 1 --elements 1
  homotopy: wrong_branch: limit-points: the path was followed only to a drop of * in and 1 critical points; take another number of elements a member, 4 or more: *: this is the straight branch, which is unstable; take two elements a member, or start from a symmetric imperfection of the end rotations (glob)
  [1]

High toggles, by a path of short steps; and Williams' equation to its end:

  $ limit_points 10 --elements 4 > points.csv
  $ first maximum | holds 'load = 6698.82 +- 0.01'
  $ for elements in 2 4 8 16; do
  >   limit_points 5 --elements $elements > points.csv
  >   first maximum | holds 'load = 3112 +- 8'
  > done
  $ homotopy limit-points --height 1 --model williams | cut -d, -f 1
  limit-points: Williams' equation ends at a drop of 0.65* in, at the pole of d_5, where its load falls without bound; --model element follows the path further (glob)
  kind
  bifurcation
  bifurcation
  maximum

Deflections
-----------

|F| of the default tolerance over a stiffness of 15 lb/in and more:

  $ homotopy toggle --height 0.44 --load 43.79 | sed -n 1p
  toggle: before this load the path from rest reaches a maximum at 42.43871 lb and a drop of 0.22712* in, where it loses its stability; the equilibrium found lies beyond it and is stable (glob)
  status,deflection,residual,iterations,bound,stability,critical_load
  $ solve() { homotopy toggle --height "$@" 2> said.txt; }
# oracle: homotopy_williams Williams 0.?? drop under *
# oracle: homotopy_frames toggle 0.?? of 1 drop under *
  $ while read -r deflection words; do
  >   solve $words < /dev/null | holds 'status = "success"' "deflection = $deflection +- 2e-9" 'iterations >= 1' 'residual <= bound'
  > done <<END
  > 0.621922545486 0.44 --load 43.79 --elements 1
  > 0.623070489 0.44 --load 44 --elements 1
  > 0.265167973289 0.32 --load 27.11 --elements 1
  > 0.621922545486 0.44 --load 43.79 --elements 1 --solver newton
  > 0.265167973289 0.32 --load 27.11 --elements 1 --solver newton
  > 0.635331561089 0.44 --load 43.79 --model williams
  > 0.636310193301 0.44 --load 44 --model williams
  > 0.266690787315 0.32 --load 27.11 --model williams
  > 0.266690787315 0.32 --load 27.11 --model williams --solver newton
  > END

Two elements a member are as one here: the S of a member is its own mirror image. With more the error falls like m^-2, so that 4 and 8 tell 64,
to the next order and 1/64 of the difference:

  $ solve 0.44 --load 43.79 --elements 1 > one.csv
  $ solve 0.44 --load 43.79 --elements 2 | cut -d, -f 1,2 | holds 'status = "success"' "deflection = $(sed -n 2p one.csv | cut -d, -f 2) +- 1e-8"
  $ deflection() { solve 0.44 --load 43.79 --elements $1 | sed -n 2p | cut -d, -f 2; }
  $ solve 0.44 --load 43.79 --elements 64 |
  >   holds "four := $(deflection 4)" "eight := $(deflection 8)" 'deflection = eight + (eight - four)/3 +- 0.1*abs(eight - four)'

Stability is that of the whole toggle, and a shape beyond a bifurcation is not shown in silence; the half toggle loses nothing at 340.22:

  $ homotopy toggle --height 2 --elements 8 --load 300 | cut -d, -f 1,6,7
  status,stability,critical_load
  success,stable,
  $ solve 2 --elements 8 --load 500 | holds 'stability = "unstable"' 'critical_load = 340.22 +- 0.01'
  $ solve 2 --elements 8 --load 660 > snapped.csv
  $ cat said.txt
  toggle: before this load the path from rest reaches an antisymmetric bifurcation at 340.2203 lb and a drop of 0.05047* in, where it loses its stability; the equilibrium found lies beyond it and is stable (glob)
  $ holds 'stability = "stable"' 'deflection > 3' < snapped.csv
  $ solve 2 --elements 8 --load 660 --solver riks | cut -d, -f 6
  stability
  unstable
  $ solve 0.44 --load 36 | cut -d, -f 6,7
  stability,critical_load
  stable,
  $ solve 0.44 --load 43.79 --elements 1 | holds 'critical_load = 42.435492120383 +- 1e-9'
  $ solve 1 --load 300 | cut -d, -f 1
  status
  success

Solvers
-------

All but fictitious time, whose steps of 0.1 are unstable where the stiffness at rest is 5000 lb/in, find the deflection below the limit
load to |F| of 1e-10 of 13.6 lb over half the slope of 14.7 lb/in. A solver that lets |F| fall is stuck at its minimum beyond it:

# oracle: homotopy_frames toggle 0.32 of 1 drop under 27.11
  $ solvers=$(homotopy toggle --height 0.44 --load 43 --solver magic 2>&1 | sed 's/.*the solvers are //; s/, kinsol//; s/,//g')
  $ echo $solvers
  newton damped-newton continuous-newton broyden least-squares steepest-descent fictitious-time vector-homotopy chow-yorke scalar-homotopy fixed-point newton-homotopy optimal-iterative levenberg-marquardt dogleg energy-trust-region riks crisfield gdc
  $ for solver in $solvers; do
  >   solve 0.32 --load 27.11 --elements 1 --solver $solver > found.csv || { cat said.txt; continue; }
  >   holds 'deflection = 0.265167973289 +- 5e-10' < found.csv
  > done
  homotopy: non_finite: fictitious-time: at iteration *, fictitious time *, with |F| = *: F is not finite any more; change the sign of nu, shorten the step or take a method that uses dF/dx (glob)
  $ homotopy toggle --height 0.44 --load 43.79 --solver damped-newton
  homotopy: not_converged: damped-newton: at iteration *, with |F| = 8.6*: no shorter step makes |F| smaller: a minimum that is no root, or rounding; start elsewhere or loosen the tolerance (glob)
  [1]

With 1000 elements rounding of the displacements makes more of the residual than 1e-10, and no residual above the tolerance is a success:

  $ for solver in energy-trust-region riks; do
  >   solve 0.44 --load 43.79 --elements 1000 --solver $solver --tolerance 1e-10 || cat said.txt
  >   solve 0.44 --load 43.79 --elements 1000 --solver $solver | holds 'status = "success"' 'bound > 1e-10'
  > done
  homotopy: not_converged: energy-trust-region: |F| = * at the end is above the tolerance, 2.19e-09, but at the level of rounding: changes of x in its last digits alone make |F| = *; take a tolerance of * or more, or coarser equations (glob)
  homotopy: not_converged: riks: |F| = * at the end is above the tolerance, 2.19e-09, but at the level of rounding: changes of x in its last digits alone make |F| = *; take a tolerance of * or more, or coarser equations (glob)

Mistakes
--------

  $ wrong() { refused homotopy "$@"; }
  $ wrong limit-points
  --height is required
  Run with --help for more information.
  $ wrong limit-points --height x
  homotopy: --height x: not a finite number
  $ wrong limit-points --height -1
  homotopy: --height -1: Toggle: a height of -1 with members of length 12.94
  $ wrong limit-points --height 13
  homotopy: --height 13: Toggle: a height of 13 with members of length 12.94
  $ wrong limit-points --height 0.44 --model wooden
  homotopy: --model wooden: must be one of element, williams
  $ wrong limit-points --height 0.44 --elements 0
  homotopy: --elements 0: must be a whole number from 1 to 10000
  $ wrong toggle
  --height is required
  Run with --help for more information.
  $ wrong toggle --height 0.44
  --load is required
  Run with --help for more information.
  $ wrong toggle --height 0.44 --load nan
  homotopy: --load nan: not a finite number
  $ wrong toggle --height 0.44 --load inf
  homotopy: --load inf: not a finite number
  $ wrong toggle --height x --load 43
  homotopy: --height x: not a finite number
  $ wrong toggle --height 0 --load 43
  homotopy: --height 0 --load 43: Toggle: a height of 0 with members of length 12.94
  $ wrong toggle --height -1 --load 43 --model williams
  homotopy: --height -1 --load 43: Toggle: a height of -1 with members of length 12.94
  $ wrong toggle --height 0.44 --load 43 --solver magic
  homotopy: --solver magic: no such solver; the solvers are newton, damped-newton, *, energy-trust-region, riks, crisfield, gdc* (glob)
  $ wrong toggle --height 0.44 --load 43 --model wooden
  homotopy: --model wooden: must be one of element, williams
  $ wrong toggle --height 0.44 --load 43 --elements 0
  homotopy: --elements 0: must be a whole number from 1 to 10000
  $ wrong toggle --height 0.44 --load 43 --elements 1.5
  homotopy: --elements 1.5: must be a whole number from 1 to 10000
  $ wrong toggle --height 0.44 --load 43 --elements 1e9
  homotopy: --elements 1e9: must be a whole number from 1 to 10000
  $ wrong toggle --height 0.44 --load 43 --model williams --elements 2
  homotopy: --elements 2: Williams' equation has no elements; use --model element
  $ wrong toggle --height 0.44 --load 43 --tolerance 0
  homotopy: --tolerance 0: must be positive

The example of the page solves for the deflection above:

  $ homotopy_example | grep -o -m 1 0.6219225
  0.6219225
