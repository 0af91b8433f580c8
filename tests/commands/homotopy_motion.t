Frames from files: motions in time
==================================

  $ ln -s "$TESTDIR/../../chapters/homotopy/frames" frames
  $ motion() { homotopy frame "$@" --dynamic; }

Energies balance: the command itself calls more than a hundredth of the greatest energy a failure, as of steps that are far too long:

  $ motion frames/toggle.toml --factor 30 --time 0.2 > motion.csv
  frame: the energies balance within * of the largest (glob)
  $ greatest=$(cut -d, -f "$(head -1 motion.csv | tr , '\n' | grep -n -x work | cut -d: -f 1)" motion.csv | sed 1d | tr -d - | sort -g | tail -1)
  $ holds --each "$greatest > 1" "kinetic_energy + strain_energy = work +- 1e-2*$greatest" < motion.csv
  $ motion frames/toggle.toml --time 0.2 --method explicit --step 0.1 > rows.csv
  homotopy: not_converged: explicit: the energies do not balance: the error is * of the largest energy, more than 0.01; take a shorter step, a smaller tolerance, or newmark, which does not dissipate (glob)
  [1]

Rows stand at the times asked for, with steps that are given or chosen. Of the largest displacement, 0.215, a hundredth is what a given step may be
off by:

  $ for method in newmark explicit "dop853 --tolerance 1e-9"; do
  >   motion frames/toggle.toml --factor 30 --time 0.18 --every 0.05 --method $method > ${method%% *}.csv
  >   cut -d, -f 1 ${method%% *}.csv | paste -s -d ' '
  > done
  frame: the energies balance within * of the largest (glob)
  time 0 0.05 0.1 0.15 0.18
  frame: the energies balance within * of the largest (glob)
  time 0 0.05 0.1 0.15 0.18
  frame: the energies balance within * of the largest (glob)
  time 0 0.05 0.1 0.15 0.18
  $ column=$(head -1 newmark.csv | tr , '\n' | grep -n -x B.y | cut -d: -f 1)
  $ for method in newmark explicit dop853; do cut -d, -f $column $method.csv | sed -n '1p;5p' > $method.txt; done
  $ for method in newmark explicit; do holds --like dop853.txt 2e-3 < $method.txt; done

A mass on a bar that is hinged at the origin is a mechanism, which falls: x'' = -s x, y'' = -g - s y with s = EA/l (r/l - 1)/(m r), here by the
Taylor series of mpmath. Under growing loads it is refused:

  $ cat > pendulum.toml <<END
  > [nodes]
  > A = [0, 0]
  > B = [1, 0]
  > [[members]]
  > nodes = ["A", "B"]
  > EA = 1000
  > EI = 1
  > mass = 1e-9
  > hinges = ["A"]
  > [supports]
  > A = ["x", "y"]
  > [masses]
  > B = { mass = 1 }
  > [loads]
  > B = { y = -9.81 }
  > END
  $ motion pendulum.toml --elements 1 --time 1 --every 1 --method dop853 --tolerance 1e-10 | sed '1s/B[.]//g' > fall.csv
  frame: the energies balance within * of the largest (glob)
  $ head -1 fall.csv
  time,load_factor,x,y,rotation,kinetic_energy,strain_energy,work,dissipated
  $ holds < fall.csv 's := lambda z: 1000*(1 - 1/hypot(z[0], z[1]))' \
  >   'z := odefun(lambda t, z: [z[2], z[3], -s(z)*z[0], -9.81 - s(z)*z[1]], 0, [1, 0, 0, 0])(1)' 'x = z[0] - 1 +- 1e-6' 'y = z[1] +- 1e-6'
  $ homotopy frame pendulum.toml
  homotopy: pendulum.toml, line 3: node B can move along y and no member is strained: it is unsupported, or the frame is a mechanism; give it a support or a member
  [2]

A rod of stiffness k = EA/l with a mass m at its end under a sudden load P moves by P/k (1 - cos(w t)), w^2 = k/m, as long as strains are small.
12 steps a period of 2 pi let the phase lag by (w h)^2/12 a radian, 2 rad in all: a given step is compared with half of it:

  $ cat > rod.toml <<END
  > [nodes]
  > A = [0, 0]
  > B = [0, 1]
  > [[members]]
  > nodes = ["A", "B"]
  > elements = 1
  > EA = 1e6
  > EI = 1
  > mass = 1e-9
  > [supports]
  > A = ["x", "y", "rotation"]
  > B = ["x", "rotation"]
  > [masses]
  > B = { mass = 1e6 }
  > [loads]
  > B = { y = -1 }
  > END
  $ motion rod.toml --time 100 --elements 1 --every 1 | holds 'B.y = -1e-6*(1 - cos(100)) +- 2e-8'
  frame: the energies balance within * of the largest (glob)
  $ motion rod.toml --time 100 --elements 1 --every 1 --step 0.5 > rows.csv
  homotopy: not_converged: newmark: with half the step of 0.5 displacements differ by * of the largest, more than 0.01; take a shorter --step, or --method dop853 with a --tolerance (glob)
  [1]
