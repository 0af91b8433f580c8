Frames from files: springs, loads along members, forces, modes
===============================================================

  $ ln -s "$TESTDIR/../../chapters/homotopy/frames" frames
  $ frame() { homotopy frame "$@" 2> said.txt || { cat said.txt >&2; return 1; }; }

Springs and joints
------------------

A column on a spring against rotation branches at x^2 with x tan(x) = 1, but for its shortening; the base turns with the spring, whose moment is a
column. A joint of stiffness 1 under the moment pi/4 turns by pi/4, and the cantilever behind it bends by as much:

  $ frame frames/spring-column.toml --elements 8 --branches 1 --forces > path.csv
  $ holds --where kind=bifurcation 'x := findroot(lambda x: x*tan(x) - 1, 0.86)^2' 'load_factor = x +- 1e-4' < path.csv
  $ cut -d, -f 3,16- path.csv | head -1
  base.rotation,spring_1.force,mesh_error,negative_eigenvalues,kind
  $ sed 's/base.rotation/turn/; s/spring_1.force/moment/' path.csv | holds --each 'moment = turn +- 1e-9'
  $ frame frames/joint-cantilever.toml --at 0.25 | sed 's/tip[.]//g' > path.csv
  $ holds 'load_factor = 0.25' 'rotation = pi/2 +- 1e-9' 'y = 4/pi*cos(pi/4) +- 1e-6' < path.csv

Loads along members, and forces
-------------------------------

A cantilever under its own load, in linear theory: the load at the support, -w l^2/2 there, and the greatest moment:

  $ frame frames/heavy-cantilever.toml --at 1e-3 --forces | sed '1s/[.-]/_/g' > forces.csv
  $ head -1 forces.csv | tr , '\n' | grep -e force -e base_tip
  base_x_force
  base_y_force
  base_rotation_force
  base_tip_base_axial
  base_tip_base_shear
  base_tip_base_moment
  base_tip_tip_axial
  base_tip_tip_shear
  base_tip_tip_moment
  base_tip_moment
  $ holds 'base_y_force = 1e-3 +- 1e-12' 'base_tip_base_shear = 1e-3 +- 1e-9' 'base_rotation_force = 5e-4 +- 1e-9' 'base_tip_moment = -5e-4 +- 1e-9' 'base_tip_tip_moment = 0 +- 1e-9' < forces.csv

A clamped beam has no node that moves, and needs none for its forces: -w l^2/12 at its ends, w l^2/24 in its middle:

  $ sed 's/base = \["x/tip = ["x", "y", "rotation"]\n&/; s/y = -1/y = -24/' frames/heavy-cantilever.toml > clamped.toml
  $ frame clamped.toml --at 1e-3 --forces | sed '1s/[.-]/_/g' | holds 'tip_rotation_force = -2e-3 +- 1e-6' 'base_tip_moment = -2e-3 +- 1e-6' 'load_factor = 1e-3'
  $ refused homotopy frame clamped.toml --at 1e-3 --elements 1
  homotopy: clamped.toml, line 12: all nodes are fixed; take more elements, or add a node that moves
  $ refused homotopy frame clamped.toml --at 1e-3 --plot beam.svg
  homotopy: --plot: all nodes of the file are fixed; add one where the frame moves

The deck's cantilever that sags by half of its length, by the elastica:

# oracle: homotopy_deck heavy-cantilever load at -0.5
  $ frame frames/heavy-cantilever.toml --elements 32 --at 5.06437817114 | sed 's/tip[.]//g' | holds 'y = -0.5 +- 2e-4'

A constant load is there before the others grow. Half of a column's own weight takes some of what its top can carry: here none of the load factor is
left at Greenhill's weight:

  $ frame frames/loaded-column.toml --at 0,0.5 --forces | sed '1s/[.-]/_/g' | holds --each 'base_y_force = 4 + load_factor +- 1e-10'
  $ sed 's/-4 }/-8 }/' frames/loaded-column.toml > heavy.toml
  $ homotopy frame heavy.toml
  homotopy: wrong_branch: frame: at 0.95* of the constant loads, before any others, the frame reaches a bifurcation; take smaller constant loads, or let them grow (glob)
  [1]

Modes
-----

Euler's loads of a column, and Greenhill's by linear buckling and on the path. Its lowest frequency, 1.8751^2/(2 pi) of a cantilever without weight,
falls to zero there. Errors of the lumped masses and of the weight are m^-2; mesh_error says 4e-4:

  $ homotopy frame frames/column.toml --modes 3 > modes.csv
  $ head -1 modes.csv
  load_factor,kind,mode,value,mesh_error,base.rotation,middle.x,middle.y,middle.rotation,top.y,top.rotation
  $ holds --where kind=buckling 'value = (i + 1)^2 +- 3e-3*(i + 1)^2' < modes.csv
  $ frame frames/heavy-column.toml --modes 1 --elements 32 --at 0,4,7.8 > modes.csv
# oracle: homotopy_deck heavy-column first bifurcation
  $ holds --where kind=buckling 'value = [7.83737654040, 7.83737654040, 7.83737654040] +- 4e-3' < modes.csv
  $ holds --where kind=vibration 'value = [1.87510406871^2/(2*pi), value, value] +- 2e-3' 'value < [0.57, 0.4, 0.05][i]' < modes.csv
  $ homotopy frame frames/heavy-column.toml --modes 1 --at 9
  homotopy: wrong_branch: frame: at the load factor 9 the equilibrium is not stable, and has no modes; take a smaller load factor
  [1]

Euler's column vibrates with the frequency pi/2 sqrt(1 - P). Load factors beyond 1 have no modes, the others do. In the fourth mode of 4 elements of
length l the nodes only rotate, alternately: 12 EI/l^2 and (48 EI/(m l^4))^0.5/(2 pi):

  $ homotopy frame frames/column.toml --modes 1 --elements 10 --at 1.1,0,0.5,0.9,0.99 > modes.csv
  homotopy: wrong_branch: frame: at the load factor 1.1 the equilibrium is not stable, and has no modes; take a smaller load factor
  [1]
  $ holds --where kind=vibration 'n = 4' 'load_factor = [0, 0.5, 0.9, 0.99]' 'value = pi/2*sqrt(1 - load_factor) +- 2e-3' < modes.csv
  $ homotopy frame frames/column.toml --elements 2 --modes 4 | sed '1s/[.]rotation//g' | grep -e mode, -e ,4, |
  >   holds --each 'value = [12*4^2/pi^2, sqrt(48*4^4)/(2*pi)] +- 1e-8' 'base = 1 +- 1e-9' 'top = 1 +- 1e-9'

Dissipation of integrators
--------------------------

rho = 1 and alpha = 0 dissipate nothing, and alpha = 0 is Newmark's method; constant loads start the motion bent:

  $ motion() { homotopy frame "$@" --dynamic --time 0.02 --every 0.01 --step 5e-5 2> said.txt; }
  $ motion frames/toggle.toml > newmark.csv
  $ motion frames/toggle.toml --method hht --alpha 0 | holds --like newmark.csv 1e-9
  $ motion frames/toggle.toml --method generalized-alpha --rho 1 | holds --like newmark.csv 1e-3
  $ sed 's/\[loads\]/[constant_loads]\nB = { y = -20 }\n&/' frames/toggle.toml > bent.toml
  $ motion bent.toml --factor 1e-9 | holds --each 'kinetic_energy = 0 +- 1e-9' 'work = 0 +- 1e-9' 'strain_energy > 0.5'

Mistakes
--------

  $ bad() { sed "$1" "$2" > bad.toml; shift 2; refused homotopy frame bad.toml "$@"; }
  $ bad 's/nodes = \["base"\]/nodes = ["top", "base", "top"]/' frames/spring-column.toml
  homotopy: bad.toml, line 16: nodes = [ 'top', 'base', 'top' ]: a spring has one node, and the ground, or two
  $ bad 's/nodes = \["base"\]/nodes = ["base", "base"]/' frames/spring-column.toml
  homotopy: bad.toml, line 15: spring at base: from a node to itself
  $ bad 's/direction = .*/direction = [0, 0]/' frames/spring-column.toml
  homotopy: bad.toml, line 15: spring at base: direction = [0, 0]; its length must be positive
  $ bad 's/direction = .*/direction = "z"/' frames/spring-column.toml
  homotopy: bad.toml, line 17: direction = 'z': must be "x", "y", "rotation" or a vector [x, y]
  $ bad 's/stiffness = 1/stiffness = -1/' frames/spring-column.toml
  homotopy: bad.toml, line 15: spring at base: stiffness = -1; it must be positive
  $ bad '/stiffness/d' frames/spring-column.toml
  homotopy: bad.toml, line 14: a spring without stiffness
  $ bad '$a[[springs]]\nnodes = ["base"]\ndirection = "y"\nstiffness = 1' frames/joint-cantilever.toml
  homotopy: bad.toml, line 17: spring at base, whose motion is fixed, or to which no member is rigidly joined
  $ bad 's/\[\[springs\]\]/[springs]/' frames/spring-column.toml
  homotopy: bad.toml, line 15: springs = * must be tables, each under [[springs]] (glob)
  $ bad 's/base = 1/base = -1/' frames/joint-cantilever.toml
  homotopy: bad.toml, line 6: member base-tip: joint = -1; its stiffness must not be negative
  $ bad 's/^joints/hinges = ["base"]\n&/' frames/joint-cantilever.toml
  homotopy: bad.toml, line 9: joints = { base = 1 }: the end base has a hinge or a joint already; give it one
  $ bad 's/\[loads\]/[constant_loads]/' frames/column.toml
  homotopy: bad.toml, [loads]: constant loads alone do not grow with the load factor; add a load other than 0, or a displacement
  $ bad 's/base-tip/base-top/' frames/heavy-cantilever.toml
  homotopy: bad.toml, line 15: there is no node and no member base-top
  $ bad 's/y = -1/moment = -1/' frames/heavy-cantilever.toml
  homotopy: bad.toml, line 15: load on base-tip: gravity and loads along members have x and y
  $ bad '/mass/d' frames/heavy-column.toml
  homotopy: bad.toml, line 16: gravity: no member and no node has a mass
  $ refused homotopy frame frames/column.toml --at 1,-1
  homotopy: --at -1: is not between 0 and the end of the path, 1
  $ refused homotopy frame frames/column.toml --at 2 --until 1
  homotopy: --at 2: is not between 0 and the end of the path, 1
  $ refused homotopy frame frames/column.toml --modes 1 --forces
  homotopy: --forces: leave out this option or --modes
  $ refused homotopy frame frames/toggle.toml --dynamic --time 1 --alpha 0
  homotopy: --alpha: is for --method hht
  $ refused homotopy frame frames/toggle.toml --dynamic --time 1 --method hht --alpha -0.4
  homotopy: --alpha -0.4: * (glob)
