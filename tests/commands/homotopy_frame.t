Frames from files: paths of equilibria
======================================

  $ ln -s "$TESTDIR/../../chapters/homotopy/frames" frames
  $ frame() { homotopy frame "$@" 2> said.txt || { cat said.txt >&2; return 1; }; }

The frames that ship
--------------------

  $ homotopy frame frames/lee.toml | sed -n 1p
  frame: mesh errors up to 2.5e-05, relative, estimated from 4 and 6 elements a member; column mesh_error
  load_factor,base.rotation,corner.x,corner.y,corner.rotation,load.x,load.y,load.rotation,end.rotation,mesh_error,negative_eigenvalues,kind

Loads at limit points. The truss has them at plus and minus 2 (1 - 1.25^(-1/3))^1.5:

  $ limits() { holds --where kind=maximum "load_factor = [$1] +- $3" < path.csv; holds --where kind=minimum "load_factor = [$2] +- $3" < path.csv; }
# oracle: homotopy_frames toggle 0.44 of 4 m*imum, Lee's frame of 20 *limit, shallow arch of 32 *
  $ frame frames/toggle.toml > path.csv
  $ limits 42.4387099966 32.1222520061 2e-10
  $ frame frames/lee.toml > path.csv
  $ limits 1.8556739134 -0.9414420703 2e-10
  $ frame frames/half-shallow-arch.toml > path.csv
  $ limits 34.0902630603 14.2531501017 1e-9
  $ grep -c bifurcation path.csv
  0
  [1]
  $ frame frames/shallow-arch.toml > path.csv
  $ limits 34.0902630603 14.2531501017 1e-9
  $ holds --where kind=bifurcation 'load_factor = [27.0, load_factor] +- 0.15' < path.csv
  $ tail -1 said.txt
  frame: 4 branches leave the paths and are not followed; --branches 4 follows more
  $ frame frames/truss.toml > path.csv
  $ limit='2*(1 - mpf(1.25)^(-mpf(1)/3))^1.5'
  $ limits "$limit" "-$limit" 1e-12

Errors of m^-2 with 20, 40 and 80 elements; the load is in units of EI/R^2 = 100:

# oracle: homotopy_frames deep arch of 20 limit
  $ for elements in 2 4 8; do frame frames/deep-arch.toml --elements $elements > $elements.csv; done
  $ holds --where kind=maximum '100*load_factor = [907.34075563] +- 1e-8' < 2.csv
  $ four=$(grep maximum 4.csv | cut -d, -f 1)
  $ holds --where kind=maximum "(4*load_factor - $four)/3 = [8.973] +- 5e-4" < 8.csv

The column branches at 1, but for pi^2/EA and m^-2; --branches follows further branches. The cantilever is rolled up to a full circle. The portal
with its small force sideways sways, past the sway load 7.379:

  $ frame frames/column.toml --branches 2 --until 1.5 > path.csv
  $ holds --where kind=bifurcation 'load_factor = 1 +- 2e-5' < path.csv
  $ holds 'branch = 2' 'load_factor = 1.5' < path.csv
  $ frame frames/cantilever.toml --until 1 > path.csv
  $ head -1 path.csv
  load_factor,tip.x,tip.y,tip.rotation,mesh_error,negative_eigenvalues,kind
  $ tail -1 path.csv | cut -d, -f 1-4 | sed '1i f,x,y,turn' | holds 'f = 1' 'x = -1 +- 1e-11' 'y = 0 +- 1e-11' 'turn = 2*pi +- 1e-11'
  $ frame frames/portal.toml > path.csv
  $ grep -m 1 maximum path.csv | cut -d, -f 1 | sed '1i f' | holds 'f > 7.379'
  $ grep -c bifurcation path.csv
  0
  [1]

Steps that turn less are shorter, and more of them lead to the same limit:

  $ frame frames/truss.toml | wc -l > usual.txt
  $ frame frames/truss.toml --turn 0.03 > path.csv
  $ limits "$limit" "-$limit" 1e-12
  $ [ $(wc -l < path.csv) -gt $((3 * $(cat usual.txt))) ]

A frame of one's own
--------------------

  $ cat > beam.toml <<END
  > [nodes]
  > A = [0, 0]
  > B = [1, 0]
  > [[members]]
  > nodes = ["A", "B"]
  > EA = 1000
  > EI = 1
  > [supports]
  > A = ["x", "y", "rotation"]
  > [loads]
  > B = { y = -1 }
  > END
  $ frame beam.toml --until 0.5 > path.csv
  $ head -1 path.csv
  load_factor,B.x,B.y,B.rotation,mesh_error,negative_eigenvalues,kind
  $ holds 'load_factor = 0.5' < path.csv
  $ sed "s/^B = \[1/'B,1' = [1/; s/\"B\"/\"B,1\"/; s/^B = {/'B,1' = {/" beam.toml > named.toml
  $ frame named.toml --until 1 | sed -n 1p
  load_factor,"B,1.x","B,1.y","B,1.rotation",mesh_error,negative_eigenvalues,kind

A load factor of the other sign gives a mirror image here:

  $ down=$(tail -1 path.csv | cut -d, -f 3)
  $ frame beam.toml --until -0.5 | tail -1 | cut -d, -f 1,3 | sed '1i f,y' | holds 'f = -0.5' "y = -($down) +- 1e-12"
  $ frame beam.toml --until 1e-100 | holds 'load_factor = 1e-100'

Ends that are not reached
-------------------------

Every path that does not come to its end says so, and all points found are printed: without a limit or branch point, and behind one:

  $ frame beam.toml --until 50 --steps 2 > path.csv
  homotopy: step_limit: frame: all points found are printed, but a path did not reach its end: frame: 2 steps end at a load factor of *, before 50; allow more steps, or longer ones (turn) (glob)
  [1]
  $ wc -l < path.csv
  4
  $ frame beam.toml > path.csv
  homotopy: step_limit: frame: all points found are printed, but a path did not reach its end: frame: 200 steps end at a load factor of *, before the requested limit or branch point; allow more steps, or longer ones (turn), or give the load factor at which it ends (until) (glob)
  [1]
  $ grep -c -e maximum -e minimum path.csv
  0
  [1]
  $ sed 's/^EA = .*/EA = 4.32e7/' frames/lee.toml > slender.toml
  $ frame slender.toml > path.csv
  homotopy: step_limit: frame: all points found are printed, but a path did not reach its end: frame: 200 steps end at a load factor of *, before 3.71*; allow more steps, or longer ones (turn), or give the load factor at which it ends (until) (glob)
  [1]
  $ grep -c -e maximum -e minimum path.csv
  1
  $ frame frames/toggle.toml --turn 0.002 > path.csv
  homotopy: step_limit: frame: all points found are printed, but a path did not reach its end: frame: 200 steps end at a load factor of *, before the requested limit or branch point; allow more steps, or longer ones (turn), or give the load factor at which it ends (until) (glob)
  [1]
  $ grep -c -e maximum -e minimum path.csv
  0
  [1]

Each row takes some milliseconds here, and all that is asked for minutes:

  $ frame frames/lee.toml --turn 0.001 --steps 100000 --limit 2 > path.csv
  homotopy: time_limit: * (glob)
  [1]
  $ [ $(wc -l < path.csv) -ge 2 ]
  $ frame frames/toggle.toml --dynamic --time 1000 --step 1e-4 --every 0.01 --elements 10 --limit 2 > motion.csv
  homotopy: time_limit: * (glob)
  [1]
  $ [ $(wc -l < motion.csv) -ge 2 ]

A bar that is 1 long and 1 stiff has no length left under a load of 1; steps whose squares are no numbers:

  $ sed 's/EA = 1000/EA = 1/; s/y = -1/x = -1/; s/\[supports\]/&\nB = ["y", "rotation"]/' beam.toml > bar.toml
  $ frame bar.toml --elements 1 --until 2 > path.csv
  homotopy: step_underflow: frame: all points found are printed, but a path did not reach its end: frame: at a load factor of 1 a beam-column at (0, 0) has * of its length left, and the path ends: members shorten in proportion to their force, down to zero length (glob)
  [1]
  $ frame beam.toml --until 1e-300
  load_factor,B.x,B.y,B.rotation,mesh_error,negative_eigenvalues,kind
  0,0,0,0,0,0,step
  homotopy: step_underflow: frame: all points found are printed, but a path did not reach its end: frame: the load factors of steps, *e-302, are too small to be squared; take smaller loads and greater factors (glob)
  [1]

Pictures of paths, also of those that do not come to their end:

  $ for name in lee shallow-arch column; do
  >   homotopy frame frames/$name.toml --branches 2 --until 40 --steps 20 --plot $name.svg > path.csv 2> said.txt
  >   echo "exit code $?"
  >   grep 'not drawn' said.txt
  >   tail -1 $name.svg
  > done
  exit code 1
  <!-- drawn by a command of nlmech -->
  exit code 1
  <!-- drawn by a command of nlmech -->
  exit code 1
  <!-- drawn by a command of nlmech -->

Mistakes in a file
------------------

Each with its line:

  $ bad() { sed "$@" beam.toml > bad.toml; refused homotopy frame bad.toml; }
  $ bad d
  homotopy: bad.toml, [nodes]: there are no nodes
  $ bad '1s/.*/nodes = 1/; 2,$d'
  homotopy: bad.toml, line 1: nodes = 1: must be a table with a line for each node
  $ bad 's/B = \[1, 0\]/B = [1]/'
  homotopy: bad.toml, line 3: nodes.B = [ 1 ]: must be a position of two numbers, [x, y]
  $ bad 's/B = \[1, 0\]/B = [inf, 0]/'
  homotopy: bad.toml, line 3: nodes.B = inf: not a finite number
  $ bad 's/B = \[1, 0\]/&\nB = [2, 0]/'
  homotopy: bad.toml, line 4, column 5: Error while parsing key-value pair: cannot redefine existing array 'B'
  $ bad 's/B = \[1, 0\]/B = [0, 0.0]/'
  homotopy: bad.toml, line 3: node B is at the position of node A, (0, 0)
  $ bad 's/B = \[1, 0\]/&\nC = [2, 0]/'
  homotopy: bad.toml, line 4: node C has no member
  $ bad 's/"B"\]/"b"]/'
  homotopy: bad.toml, line 4: there is no node b
  $ bad 's/EI = 1/EI = -1/'
  homotopy: bad.toml, line 4: member A-B: EI = -1; it must be positive
  $ bad "s/EI = 1/EI = 'soft'/"
  homotopy: bad.toml, line 7: EI = 'soft': not a number
  $ bad '/EI = 1/d'
  homotopy: bad.toml, line 4: a member without EI
  $ bad 's/EI = 1/&\nhinges = ["C"]/'
  homotopy: bad.toml, line 8: hinges = [ 'C' ]: the member joins A and B
  $ bad 's/EI = 1/&\nelements = 0/'
  homotopy: bad.toml, line 8: elements = 0: must be a whole number from 1 to 100000
  $ bad 's/EI = 1/&\nradius = 0.4/'
  homotopy: bad.toml, line 4: member A-B: radius = 0.4: such a circle does not span its length of 1
  $ bad 's/EI = 1/EJ = 1/'
  homotopy: bad.toml, line 7: EJ = 1: no such key; the keys of a member are nodes, EA, EI, hinges, joints, elements, radius, mass
  $ bad 's/"rotation"/"turn"/'
  homotopy: bad.toml, line 9: supports.A = [ 'x', 'y', 'turn' ]: turn is no motion; the motions are x, y, rotation
  $ bad 's/A = \["x"/Z = ["x"/'
  homotopy: bad.toml, line 9: there is no node Z
  $ bad 's/"rotation"/"y"/'
  homotopy: bad.toml, line 3: node B can move along y and no member is strained: it is unsupported, or the frame is a mechanism; give it a support or a member
  $ bad '/A = \["x"/d'
  homotopy: bad.toml, line 2: node A can move along x and no member is strained: it is unsupported, or the frame is a mechanism; give it a support or a member
  $ bad 's/y = -1/z = -1/'
  homotopy: bad.toml, line 11: loads.B.z = -1: a load has x, y, moment
  $ bad 's/y = -1/y = 0/'
  homotopy: bad.toml, line 11: there is no load, or all of them are 0
  $ bad 's/B = { y/A = { y/'
  homotopy: bad.toml, line 11: load on A.y, which is fixed
  $ bad 's/\[loads\]/[load]/'
  homotopy: bad.toml, line 10: load = B = { y = -1 }: no such key; the keys are nodes, members, supports, springs, loads, constant_loads, displacements, masses, damping, imperfection
  $ bad '1s/.*/[nodes/; 2,$d'
  homotopy: bad.toml, line 1, column 7: Error while parsing table header: expected ']', saw '\n'
  $ bad "1s/.*/a.$(head -c 5000 /dev/zero | tr '\0' .)/; 2,\$d"
  homotopy: bad.toml: 5001 dots besides decimal points, where 2000 are more than enough for its names

Of load cases, displacements, imperfections and damping:

  $ refused homotopy frame frames/cases.toml
  homotopy: frames/cases.toml, [loads]: there are several cases; give --case with one of lift, twist, weight
  $ refused homotopy frame frames/cases.toml --case nothing
  homotopy: frames/cases.toml, [loads]: there is no case nothing; the cases are lift, twist, weight
  $ refused homotopy frame frames/toggle.toml --case weight
  homotopy: frames/toggle.toml, [loads]: there is no case weight; the file has no cases
  $ other() { { sed 's/\[loads\]/[loads.down]/' beam.toml; printf "$1"; } > two.toml; refused homotopy frame two.toml --case down; }
  $ other '[loads.other]\nZ = { y = 1 }\n'
  homotopy: two.toml, line 13: there is no node Z
  $ other '[loads.other]\nA = { x = 2 }\n'
  homotopy: two.toml, line 13: load on A.x, which is fixed
  $ other '[loads.other]\nB = { y = 0 }\n'
  homotopy: two.toml, line 13: there is no load, or all of them are 0
  $ other '[displacements.other]\nA = { y = 1 }\n'
  homotopy: two.toml, line 13: displacement of A.y, which is fixed
  $ more() { { cat beam.toml; printf "$1"; } > more.toml; shift; refused homotopy frame more.toml "$@"; }
  $ more '[displacements]\nZ = { y = 1 }\n'
  homotopy: more.toml, line 13: there is no node Z
  $ more '[displacements]\nA = { y = 1 }\n'
  homotopy: more.toml, line 13: displacement of A.y, which is fixed
  $ more '[imperfection]\nmode = 0\namplitude = 1\n'
  homotopy: more.toml, line 13: imperfection.mode = 0: must be a whole number from 1 to 100000
  $ more '[damping]\nmass = -1\n' --dynamic --time 1
  homotopy: more.toml, line 12: damping = -1; it must not be negative

Mistakes in options
-------------------

  $ wrong() { refused homotopy frame "$@"; }
  $ wrong beam.toml --until 0
  homotopy: --until 0: the frame is at rest there; give another load factor
  $ dynamic() { refused homotopy frame frames/toggle.toml --dynamic "$@"; }
  $ dynamic
  homotopy: --dynamic: needs --time T, the end of the motion
  $ wrong frames/lee.toml --dynamic --time 1
  homotopy: frames/lee.toml, line 11: a motion in time needs a mass per length of this member: one of its displacements moves no mass
  $ dynamic --time 1 --history ramp
  homotopy: --history ramp needs a --duration
  $ dynamic --time 1 --duration 1
  homotopy: --duration: is for --history ramp or pulse; leave it out or give one of them
  $ dynamic --time 1 --step 1e-3 --tolerance 1e-6
  homotopy: --step and --tolerance: give only one of them
  $ dynamic --time 1 --step 1e-7
  homotopy: without --every each of 1e+07 steps has a row, more than 1000000; give --every
  $ dynamic --time 1 --every 1e-7
  homotopy: --every 1e-07: more than 1000000 rows

An option that the mode does not heed changes nothing, which its user cannot see: it is refused. The steps of an imperfection's shape are heeded:

  $ for option in '--history step' '--factor 1' '--duration 1' '--time 1' '--method newmark' '--step 0.1' '--tolerance 0.1' '--every 1'; do
  >   wrong frames/toggle.toml $option
  > done
  homotopy: --history: is for a motion in time; add --dynamic or leave it out
  homotopy: --factor: is for a motion in time; add --dynamic or leave it out
  homotopy: --duration: is for a motion in time; add --dynamic or leave it out
  homotopy: --time: is for a motion in time; add --dynamic or leave it out
  homotopy: --method: is for a motion in time; add --dynamic or leave it out
  homotopy: --step: is for a motion in time; add --dynamic or leave it out
  homotopy: --tolerance: is for a motion in time; add --dynamic or leave it out
  homotopy: --every: is for a motion in time; add --dynamic or leave it out
  $ for option in --until --branches --steps --turn; do dynamic --time 0.01 $option 1; done
  homotopy: --until: is for equilibrium paths; leave out this option or --dynamic
  homotopy: --branches: is for equilibrium paths; leave out this option or --dynamic
  homotopy: --steps: is for equilibrium paths; leave out this option or --dynamic
  homotopy: --turn: is for equilibrium paths; leave out this option or --dynamic
  $ wrong frames/level-brace.toml --dynamic --time 1 --steps 100
  frame: imperfection of 0.01 in the shape of the bifurcation at load factor 0.99999* (glob)
  homotopy: frames/level-brace.toml, line 8: a motion in time needs a mass per length of this member: one of its displacements moves no mass
