Typed equations F(x) = 0: roots, all roots, solvers side by side, paths
======================================================================

A root
------

  $ circle="x^2 + y^2 = 5; x y = p; p = 2"
  $ homotopy solve --equation "$circle" --start "x=3, y=0.5" > root.csv
  $ head -1 root.csv
  x,y,error,residual,condition,root,method,iterations,evaluations
  $ holds 'x = 2 +- 1e-14' 'y = 1 +- 1e-14' 'error < 1e-13' 'root = "proved"' 'method = "dogleg"' < root.csv
  $ homotopy solve --equation "$circle" --set p=-2 --start "x=3, y=-0.5" --method newton | holds 'x = 2 +- 1e-14' 'y = -1 +- 1e-14'
  $ printf 'x^3 = 2  # a cube\nx(0) = 1\n' > cube.txt
  $ homotopy solve --file cube.txt | holds 'x = 2^(1/mpf(3)) +- 1e-15'
  $ homotopy solve --file cube.txt --method kinsol | holds 'x = 2^(1/mpf(3)) +- 1e-15'
  $ homotopy solve --equation "x = cos(x)" --start x=1 | holds 'cos(x) = x +- 1e-15'

A name on the left of = is a definition, and with a start value an unknown:

  $ homotopy solve --equation "y = x^2; x + y = 6" --start x=1 | head -1
  x,error,residual,condition,root,method,iterations,evaluations
  $ homotopy solve --equation "y = x^2; x + y = 6" --start "x=1, y=1" | holds 'x = 2 +- 1e-14' 'y = 4 +- 1e-14'

Bounds choose among roots; an energy has stationary points:

  $ homotopy solve --equation "x^2 = 4" --start x=-1 --bounds "x <= 0" | holds 'x = -2 +- 1e-15'
  $ homotopy solve --equation "energy = (x^2 - 1)^2 + y^2" --start "x=0.5, y=1" | holds 'x = 1 +- 1e-14' 'y = 0 +- 1e-14' 'method = "energy-trust-region"'
  solve: the energy is 0, a minimum

Units do not matter:

  $ homotopy solve --equation "x^2 = 1e-20" --start x=1 | holds 'x = mpf(10)^-10 +- 1e-24' 'root = "proved"'
  $ homotopy solve --equation "1e12 x^3 = 8e12" --start x=1 | holds 'x = 2 +- 1e-15' 'root = "proved"'
  $ homotopy solve --equation "1e-200 (x - 3) = 0" --start x=1 | holds 'x = 3 +- 1e-15' 'root = "proved"'
  $ homotopy solve --equation "x^2/1e30 = 4" --start x=1e14 | holds 'x = 2e15 +- 1' 'root = "proved"'
  $ homotopy solve --equation "x^20 = 1e-200" --start x=1 | holds 'x = mpf(10)^-10 +- 1e-24' 'root = "proved"'
  $ homotopy solve --equation "exp(x) = 1e-300" --start x=1 | holds 'x = -300*log(mpf(10)) +- 1e-12' 'root = "proved"'
  $ homotopy solve --equation "1/x = 1e-100" --start x=1 | holds 'x = mpf(10)^100 +- 1e86' 'root = "proved"'
  $ homotopy solve --equation "x^2 = 2e300" --start x=1 | holds 'x = sqrt(2*mpf(10)^300) +- 1e135' 'root = "proved"'
  solve: from the given start no solver found a root; this one is from other start 1

Singular roots, and points that are none
----------------------------------------

  $ homotopy solve --equation "x^2 = 0" --start x=1 | holds 'x = 0 +- 1e-15' 'root = "singular"'
  solve: a singular root: dF/dx loses rank 1, multiplicity about 2; a change of the equations in their last digits may remove it, and rounding hides * of its size (glob)
  $ homotopy solve --equation "x^3 = 0" --start x=1 | holds 'x = 0 +- 1e-15' 'root = "singular"'
  solve: a singular root: dF/dx loses rank 1, multiplicity about 3; a change of the equations in their last digits may remove it, and rounding hides * of its size (glob)
  $ homotopy solve --equation "(x - 3)^2 = 0" --start x=1 | holds 'x = 3 +- 1e-14' 'root = "singular"'
  solve: a singular root: dF/dx loses rank 1, multiplicity about 2; a change of the equations in their last digits may remove it, and rounding hides * of its size (glob)
  $ homotopy solve --equation "x^2 - 2 x + 1 = 0" --start x=3 | holds 'x = 1 +- 1e-7' 'error < 1e-6' 'root = "singular"'
  solve: a singular root: dF/dx loses rank 1, multiplicity about 2; a change of the equations in their last digits may remove it, and rounding hides * of its size (glob)
  $ homotopy solve --equation "x^2 + y^2 = 1; x^2 + y^2 = 1" --start "x=3, y=1" | holds 'x^2 + y^2 = 1 +- 1e-14' 'root = "singular"'
  solve: no isolated root: the equations depend on each other there, and roots fill a curve or more
  $ homotopy solve --equation "x + y = 2; 2*x + 2*y = 4" --start "x=3, y=0" | holds 'x + y = 2 +- 1e-14'
  solve: no isolated root: the equations depend on each other there, and roots fill a curve or more
  $ none() { homotopy solve --equation "$1" --start x=1.1; }
  $ none "x^2 + 1 = 0"
  homotopy: not_converged: from the start |F| falls to a minimum that is no root; no root from 32 other starts either
  [1]
  $ for f in "x^2 + 1e-20 = 0" "x^2 + 1e-300 = 0" "1e-30 (x^2 + 1) = 0" "x^2 - 2 x + 1 + 1e-13 = 0" "abs(x) = -1e-13" "sqrt(x) = -1e-9" \
  >   "exp(x) = 0" "exp(-x^2) = 0" "1/x = 0" "1/(1 + x^2) = 0" "1/(x - 1.1) = 0" "2 sign(x - 1.1) = 1"
  > do none "$f" 2>> said.txt || echo "$?"; done | uniq -c | sed 's/^ *//'
  12 1
  $ grep -c '^homotopy: [a-z_]*: ' said.txt
  12

All roots
---------

  $ homotopy solve --all-roots --equation "$circle" --box "x=-5:5, y=-5:5" > all.csv
  solve: these are all roots in the box, proved by interval arithmetic (boxes examined: *) (glob)
  $ holds --each 'x = [-2, -1, 1, 2] +- 1e-13' 'y = [-1, -2, 2, 1] +- 1e-13' 'root = "proved"' < all.csv
  $ homotopy solve --all-roots --equation "sin(x) = 0" --box "x=-10:10" | holds --each 'n = 7' 'x = (i - 3)*pi +- 1e-14' 'error < 1e-13'
  solve: these are all roots in the box, proved by interval arithmetic (boxes examined: *) (glob)
  $ homotopy solve --all-roots --equation "x^2 + 1 = 0" --box "x=-10:10"
  x,error,root
  solve: there is no root in the box, proved by interval arithmetic (boxes examined: *) (glob)
  $ homotopy solve --all-roots --equation "(x - 1)^2 (x + 2) = 0" --box "x=-5:5" > some.csv
  homotopy: singular_matrix: solve: all that was found is printed, but 1 box is undecided: a singular root, a kink or jump, or the end of the domain of F may lie there
  [1]
  $ cut -d, -f 3 some.csv
  root
  proved
  undecided
  $ homotopy solve --all-roots --equation "x^20 = 1" --box "x=0:10" 2>/dev/null | holds 'x = 1 +- 1e-14' 'error < 1e-13' 'root = "proved"'
  $ homotopy solve --all-roots --equation "1000 (1 + i)^30 = 5000" --box "i=0:1" 2>/dev/null | holds 'i = 5^(1/mpf(30)) - 1 +- 1e-15' 'error < 1e-14'
  $ homotopy solve --all-roots --equation "x^2 = 1" --box "x=-2:2" --bounds "x >= 0" | holds 'n = 1' 'x = 1 +- 1e-15'
  solve: these are all roots in the box and the bounds, proved by interval arithmetic (boxes examined: *) (glob)
  $ homotopy solve --all-roots --equation "x^2 = 1" --box "x=-2:1" --bounds "x >= 1"
  x,error,root
  1,0,undecided
  homotopy: singular_matrix: solve: all that was found is printed, but the bounds leave a single value of an unknown in the box; define it as a number
  [1]

Jumps are undecided, not stepped over:

  $ homotopy solve --all-roots --equation "frac(x) = 0.005" --box "x=-3:3" 2>/dev/null > jumps.csv
  [1]
  $ holds --where root=proved 'n = 6' 'x = [-2.995, -1.995, -0.995, 0.005, 1.005, 2.005] +- 1e-13' < jumps.csv

Solvers side by side
--------------------

  $ homotopy compare --equation "$circle" --start "x=3, y=0.5" > rows.csv
  $ head -1 rows.csv
  method,outcome,root,digits,iterations,evaluations,jacobians,seconds
  $ holds --where outcome=success 'digits > 9' 'root = "proved"' < rows.csv
  $ homotopy compare --equation "$circle" --start "x=3, y=0.5" --methods newton,dogleg | cut -d, -f 1,2
  method,outcome
  newton,success
  dogleg,success
  $ homotopy compare --equation "$circle" --box "x=-5:5, y=-5:5" --starts 20 --methods newton,dogleg > shares.csv
  $ head -1 shares.csv
  method,starts,arrived,share,iterations,evaluations,seconds
  $ holds 'starts = 20' 'share > 0.8' < shares.csv
  $ homotopy compare --equation "$circle" --box "x=-5:5, y=-5:5" --starts 20 --methods newton --plot basins.svg > shares.csv
  $ homotopy compare --equation "$circle" --start "x=3, y=0.5" --plot work.svg > rows.csv
  $ grep -c '<svg' basins.svg work.svg
  basins.svg:1
  work.svg:1

Paths in a parameter
--------------------

  $ homotopy path --equation "x^3 - x + a = 0" --start x=2 --parameter "a = -2:2" --plot path.svg > path.csv
  $ head -1 path.csv
  branch,kind,a,x
  $ holds --where kind=maximum 'a = [2/sqrt(mpf(27))] +- 1e-14' < path.csv
  $ holds --where kind=minimum 'a = [-2/sqrt(mpf(27))] +- 1e-14' < path.csv
  $ holds 'a = 2' 'x^3 - x + 2 = 0 +- 1e-13' < path.csv
  $ homotopy path --equation "energy = x^4/4 - a x^2/2" --start x=0 --parameter "a = -1:1" | grep bifurcation | cut -d, -f 1,2,5
  path: 2 half branches leave the paths and are not followed; --branches 2 follows more
  0,bifurcation,0
  $ homotopy path --equation "energy = x^4/4 - a x^2/2" --start x=0 --parameter "a = -1:1" --branches 2 > path.csv
  $ holds --where branch=2 'x^2 = a +- 1e-12' < path.csv

An unknown that grows a thousandfold along the path, and a limit point after it has (a = 3 (0.001/2)^(2/3) at x = -(0.001/2)^(1/3)):

  $ homotopy path --equation "x (x^2 - a) = 0.001" --start x=0 --parameter "a = -1:1" > path.csv
  $ holds --each 'abs(x^3 - a*x - mpf("0.001")) <= 1e-12' < path.csv
  $ tail -1 path.csv | cut -d, -f 2,3
  step,1
  $ homotopy path --equation "x (x^2 - a) = -1e-9" --start x=1e-9 --parameter "a = -1:1" | holds --where a=1 'x = -1 +- 1e-8'
  $ homotopy path --equation "x (x^2 - a) = 0.001" --start x=-1 --parameter "a = 1:-1" | holds --where kind=minimum 'a = 3*(mpf("0.0005"))^(2/mpf(3)) +- 1e-12'

Bifurcation values are accurate to rounding: a = pi, and a = 1, where a cos(x) - 1 vanishes at x = 0:

  $ bifurcations() { homotopy path --equation "$1" --start "$2" --parameter "a = $3" 2> said.txt | grep -E '^(branch|0,bifurcation)'; }
  $ bifurcations "x (x^2 + a - pi) = 0" x=0 0:4 | holds --each 'n = 1' 'a = pi +- 1e-14' 'x = 0 +- 1e-14'
  $ bifurcations "sin(x) a = x" x=0 0.2:3 | holds --each 'n = 1' 'a = 1 +- 1e-14' 'x = 0 +- 1e-14'

Branches that meet without a change of sign of det dF/dx, with a common tangent, at a small angle, or twice within a step:

  $ branches() { homotopy path --equation "$1" --start "$2" --parameter "a = $3" --branches "$4" > path.csv; }
  $ at() { head -1 path.csv; grep -E ",step,($1)," path.csv | sort -t, -k 3g,3 -k 4g; }
  $ branches "x (x^2 - a^2) = 0" x=0 -1:1 4
  $ holds --where kind=bifurcation 'a = 0 +- 1e-14' 'x = 0 +- 1e-14' < path.csv
  $ at 1 | holds --each 'x = [-1, 0, 1] +- 1e-13'
  $ at -1 | holds --each 'x = [-1, 0, 1] +- 1e-13'
  $ branches "x (x^2 - a) (x^2 - 2 a) = 0" x=0 -1:1 4
  $ at 1 | holds --each 'x = [-sqrt(mpf(2)), -1, 0, 1, sqrt(mpf(2))] +- 1e-12'
  $ branches "x (x - 0.02 a) (x + a) = 0" x=0 -1:1 4
  $ at 1 | holds --each 'x = [-1, 0, 0.02] +- 1e-13'
  $ branches "x (x^2 - (a - 0.3) (a - 0.31)) = 0" x=0 -1:1 4
  $ grep '^0,bifurcation' path.csv | wc -l
  2
  $ at 1 | holds --each 'x = [-sqrt(mpf("0.483")), 0, sqrt(mpf("0.483"))] +- 1e-12'
  $ branches "x^2 (x - a) = 0" x=-1 -1:1 4
  path: at 1 bifurcation point no other branch is found: dF/dx loses more than one rank there, or is singular all along the other branch
  $ holds --where kind=bifurcation 'a = 0 +- 1e-14' 'x = 0 +- 1e-14' < path.csv

Branches that pass each other at a distance of about 1e-3 do not meet:

  $ branches "x (x^2 - a) = 1e-9" x=0 -1:1 2
  $ grep -c bifurcation path.csv
  0
  [1]

Branches that cross, and the branch x = 0 from the one that turns back at it, at any step:

  $ branches "x^2 = a^2" x=-1 -1:1 2
  $ at "-?1" | holds --each 'x = [-1, 1, -1, 1] +- 1e-13'
  $ homotopy path --equation "x y = 0; x + y = a" --start "x=-1, y=0" --parameter "a = -1:1" --branches 2 | holds --each 'x*y = 0 +- 1e-14' 'x + y - a = 0 +- 1e-14'
  $ homotopy path --equation "x^3 - a x = 0" --start x=1 --parameter "a = 1:-1" --branches 2 > path.csv
  $ for branch in 1 2; do holds --where branch=$branch 'x = 0 +- 1e-13' < path.csv; done
  $ homotopy path --equation "x^3 - a x = 0" --start x=1 --parameter "a = 1:-1" --branches 2 --turn 0.03 > path.csv
  $ for branch in 1 2; do holds --where branch=$branch 'x = 0 +- 1e-13' < path.csv; done
  $ at "-?1" | holds --each 'a = [-1, 1, 1, 1]' 'x = [0, -1, 0, 1] +- 1e-13'

No root where the unknowns grow without bound, no root at the start, a bound; ranges that are small beside the unknowns, and large numbers:

  $ homotopy path --equation "exp(x) = a" --start x=0 --parameter "a = 1:0" > path.csv
  homotopy: not_converged: * (glob)
  [1]
  $ holds --each 'abs(x - log(a)) <= 2e-6*(1 + abs(x))' < path.csv
  $ homotopy path --equation "exp(-x) = a" --start x=0 --parameter "a = 1:0" > path.csv
  homotopy: not_converged: * (glob)
  [1]
  $ homotopy path --equation "a x = a" --start x=0 --parameter "a = 0:1"
  homotopy: singular_matrix: path: at a = 0 an equation loses its unknowns, and no single root exists there; begin the range at another value
  [1]
  $ homotopy path --equation "x = a" --start x=0 --bounds "x <= 1" --parameter "a = 0:2" > path.csv
  homotopy: wrong_branch: all points found are printed, but a branch did not reach its end: *, the path ends here: x reaches its bound 1 (glob)
  [1]
  $ holds 'a = 1 +- 1e-9' < path.csv
  $ homotopy path --equation "x^3 - x + a = 0" --start x=2 --parameter "a = -1e-9:1e-9" | holds 'a = 1e-9 +- 1e-24' 'x^3 - x + a = 0 +- 1e-15'
  $ homotopy path --equation "x^2 = a" --start x=1e150 --parameter "a = 1e300:1e299" | holds 'x = sqrt(mpf(10)^299) +- 1e136'

A path that reaches its limit of time keeps the points found:

  $ homotopy path --equation "x^2 + a = 1" --start x=1 --parameter "a = 0:2" --limit 1e-9 > path.csv
  homotopy: time_limit: all points found are printed, but a branch did not reach its end: path: 1e-09 s end at a parameter of 0
  [1]
  $ cat path.csv
  branch,kind,a,x
  0,step,0,1

Mistakes
--------

  $ wrong() { refused homotopy "$@"; }
  $ wrong solve
  homotopy: give one of --equation TEXT and --file NAME
  $ wrong solve --equation "x + y = 1" --start x=1
  homotopy: --equation:1:1: 1 equation for 2 unknowns (x, y); a constant has a definition (a = 3) or a --set, and an unknown on the left of = a start value
    x + y = 1
    ^^^^^^^^^
  $ wrong solve --equation "x^2 = e^x" --start x=1
  homotopy: --equation:1:1: 1 equation for 2 unknowns (x, e); a constant has a definition (a = 3) or a --set, and an unknown on the left of = a start value; exp(x) is the exponential function
    x^2 = e^x
    ^^^^^^^^^
  $ wrong solve --equation "a = 3"
  homotopy: --equation:1:1: there is no unknown: every name has a definition; a name with a start value is an unknown
    a = 3
    ^^^^^
  $ wrong solve --equation "x^2 = 2; 1 + 1 = 2" --start x=1
  homotopy: --equation:1:10: this equation has no unknown
    x^2 = 2; 1 + 1 = 2
             ^^^^^^^^^
  $ wrong solve --equation "x^2 = 2" --start "x=1, z=2"
  homotopy: --start:1:6: no unknown; these are x
    x=1, z=2
         ^
  $ wrong solve --equation "x^2 = 2; x(0) = 1; x(0) = 2"
  homotopy: --equation:1:20: given twice
    x^2 = 2; x(0) = 1; x(0) = 2
                       ^^^^
  $ wrong solve --equation "x^2 = 2"
  homotopy: --start: a start value of x is missing; add x=1
  $ wrong solve --equation "x^2 = 2" --start x=1 --method magic
  homotopy: --method magic: no such solver; the solvers are newton, damped-newton, * (glob)
  $ wrong solve --equation "x^2 = 2" --start x=1 --method energy-trust-region
  homotopy: --method energy-trust-region: no such solver for equations without an energy; the solvers are newton, damped-newton, * (glob)
  $ wrong solve --equation "x^2 = 2" --start x=-1 --bounds "x >= 0"
  homotopy: --start x=-1: x = -1 is outside its bounds, 0 to inf
  $ wrong solve --equation "x^2 = 2" --start x=1 --set a=1
  homotopy: --set a: the equations have no such name
  $ wrong solve --equation "x' = 2" --start x=1
  homotopy: --equation:1:1: a derivative; `integrators integrate` and `rbf_inverse bvp` take such equations
    x' = 2
    ^^
  $ wrong solve --equation "x^2 = 2" --start x=1 --box "x=0:1"
  homotopy: --box x=0:1: is for --all-roots
  $ wrong solve --equation "x^2 = 2" --all-roots
  homotopy: --all-roots: give a --box, a range for each unknown
  $ wrong solve --equation "x^2 = 2" --all-roots --box "x=0"
  homotopy: --box x=0: write a range as x = -5:5, and separate several by commas
  $ wrong solve --equation "x^2 = 2" --all-roots --box "y=0:1"
  homotopy: --box y=0:1: x needs a range
  $ wrong compare --equation "x^2 = 2" --start x=1 --methods magic
  homotopy: --methods magic: no such solver; the solvers are newton, damped-newton, * (glob)
  $ wrong compare --equation "x^2 = 2" --start x=1 --box "x=0:1"
  homotopy: --box x=0:1: needs a number of --starts
  $ wrong path --equation "x^2 = a" --start x=1 --parameter "b = 0:1"
  homotopy: --parameter b: the equations have no such name
  $ wrong path --equation "x^2 = a" --start x=1 --parameter "a = 1"
  homotopy: --parameter a = 1: write a range as x = -5:5, and separate several by commas
