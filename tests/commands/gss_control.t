A hub with flexible appendages: poles, zeros, responses, manoeuvres, gains
==========================================================================

  $ gss() { gss_control "$@"; }

Poles and zeros of Table 3.1's spacecraft, to all 13 digits:

  $ gss poles --count 4 | cut -d, -f 1 | paste -s -d ' '
  index 1 2 3 4
  $ gss poles | wc -l
  11
# oracle: gss_control_plant tip pole 1, tip pole 2, tip pole 3, tip pole 4
  $ gss poles --count 4 | holds --each 'index = i + 1' 'real = 0' 'imag = [6.452959965749, 52.08177896598, 156.1145680847, 297.5963940072] +- 1e-12*imag'

Those of the closed loop:

# oracle: gss_control_loop designed pole 1 *, designed pole 2 *, designed pole 3 *, designed pole 4 *
  $ gss poles --gains 12,0,16 --count 4 | holds --each 'size := 3e-12*hypot(real, imag)' \
  >   'real = [-0.435108439861, -0.527468041156, -0.0259638869961, -0.00505426852263] +- size' \
  >   'imag = [0.689954756969, 6.42057934175, 52.0811790701, 156.114528064] +- size'

Zeros of the hub's angle and of deflections; feedback moves none:

# oracle: gss_control_plant tip locked 1, tip locked 2, tip locked 3, tip first zero of *
  $ gss zeros --count 3 | holds --each 'real = 0' 'imag = [4.372658473946, 51.39836909583, 155.7182855807] +- 1e-12*imag'
  $ gss zeros --at 2 --count 1 | holds --each 'imag = [37.81075762923] +- 1e-12*imag'
  $ gss zeros --at 4 --count 1 | holds --each 'imag = [52.45443464444] +- 1e-12*imag'
  $ gss zeros > zeros.csv
  $ gss zeros --gains 1,1,1 | cmp - zeros.csv

Responses at frequencies, or on a grid of them; at rest theta is theta_f, and near the maximum it is the resonance:

  $ gss response --omega 0.1,1,10 --at 2,4.0 > response.csv
  $ head -1 response.csv
  omega,theta_re,theta_im,y@2_re,y@2_im,y@4.0_re,y@4.0_im
# oracle: gss_control_plant tip * at 0.1, tip * at 1, tip * at 10
  $ cut -d, -f 1,2,4,6 response.csv | sed '1s/.*/omega,a,b,c/' | holds --each 'omega = [0.1, 1, 10]' \
  >   'a = [-5.52448854758618, -0.0536584284810462, -0.00166615919715115] +- 1e-13*abs(a)' \
  >   'b = [-0.00475612847846067, -0.00487037747371546, 0.00327536292807089] +- 1e-13*abs(b)' \
  >   'c = [-0.0149467556104467, -0.0153109262016674, 0.0106674410862429] +- 1e-13*abs(c)'
  $ sed '1s/.*/omega,a,A,b,B,c,C/' response.csv | holds --each 'A = 0 +- 1e-13*abs(a)' 'B = 0 +- 1e-13*abs(b)' 'C = 0 +- 1e-13*abs(c)'
  $ gss response --omega 1e-8:1e8:33 --gains 12,0,16 --at 2 > grid.csv
  $ head -1 grid.csv
  omega,theta_re,theta_im,y@2_re,y@2_im
  $ sed 1d grid.csv | cut -d, -f 1 | sed -n '1p;33p'
  1e-08
  100000000
  $ sed 1d grid.csv | grep -c -v -e nan -e inf
  33
  $ gss response --omega 0.01:100:5 | holds --each 'omega = [0.01, 0.1, 1, 10, 100] +- 1e-14*omega'
  $ gss response --omega 0.1,1,-10 | holds --each 'omega = [0.1, 1, -10]'
  $ sed -n 1,2p grid.csv | holds 'theta_re = 1 +- 1e-14'
# oracle: gss_control_loop designed resonance, designed resonance at
  $ gss response --omega 0.5256 --gains 12,0,16 | holds 'hypot(theta_re, theta_im) = 1.099208 +- 1e-6'

Manoeuvres
----------

From rest; the largest angle has ten digits, with the time rounded. All is linear in the angle:

  $ gss step --gains 12,0,16 --final-angle 1 --until 5 --every 0.5 --at 2 > step.csv
  $ head -1 step.csv
  t,theta,theta_dot,y@2,ydot@2
  $ sed 1d step.csv | cut -d, -f 1 | paste -s -d ' '
  0 0.5 1 1.5 2 2.5 3 3.5 4 4.5 5
  $ sed -n 1,2p step.csv | holds 'theta = 0 +- 1e-8' 'y@2 = 0 +- 1e-7'
# oracle: gss_control_loop designed largest angle, designed least deflection
  $ gss step --gains 12,0,16 --until 4.508 --at 2 > peak.csv
  $ holds 'n = 1' 't = 4.508' 'theta = 1.136136789 +- 3e-9' < peak.csv
  $ gss step --gains 12,0,16 --until 0.4315 --at 2 | holds 'y@2 = -0.08167668 +- 3e-8'
  $ gss step --gains 12,0,16 --final-angle 0.5 --until 4.508 --at 2 | paste -d, - peak.csv | sed '1s/.*/t,a,b,c,d,T,A,B,C,D/' |
  >   holds 'a = A/2 +- 1e-15' 'b = B/2 +- 1e-15' 'c = C/2 +- 1e-15' 'd = D/2 +- 1e-15'

A slow real pole beside s = 0: the hub starts at 0, to the tolerance of the sum, and an integration of finite elements in time gives 0.423 after 10 s:

  $ gss step --gains 5,0,90 --until 10 > slow.csv
  $ sed -n 1,2p slow.csv | holds 'theta = 0 +- 1e-9'
  $ holds 'theta = 0.42329 +- 1e-5' < slow.csv

A rigid body's t^2/(2 J) carries the turn under unit torque; the ripple is bounded by the appendages' inertia:

  $ gss step --until 100 --every 50 | holds 't = 100' 'theta/(1e4/2/18.0961) = 1 +- 1e-4' 'theta_dot/(1e2/18.0961) = 1 +- 1e-2'

Times beyond a multiple of --every end where asked, and a rounding makes no second row:

  $ gss step --until 1 --every 0.3 | cut -d, -f 1 | paste -s -d ' '
  t 0 0.29999999999999999 0.59999999999999998 0.89999999999999991 1
  $ gss step --until 0.3 --every 0.1 | wc -l
  5

Optimal gains
-------------

# oracle: gss_control_loop optimum k* at *, optimum cost *, PD optimum * at W = 100
  $ while read -r k1 k2 k3 cost words; do
  >   gss_control optimal-gains --torque-weight 0.006944444444444444 --deflection-weight $words > gains.csv < /dev/null
  >   holds "k1 = $k1 +- 1e-11*max(1, k1)" "k2 = $k2 +- 1e-11*max(1, k2)" "k3 = $k3 +- 1e-11*k3" "cost = $cost +- 1e-11*cost" < gains.csv
  > done <<END
  > 12 4.82952499282 31.9283386251 2.66069488543 100
  > 4.55260668488 0 12.8362319884 2.81953458248 100 --pd
  > 12 0 20.8400191938 1.73666826615 0
  > 12 18.7466651844 52.0146602067 4.33455501723 1000
  > END
  $ head -1 gains.csv
  k1,k2,k3,cost

The example of the page: k3 = k1 J for the best PD gains, to the six decimals that are printed, and the turn of 0.5 rad is nearly done after 10 s:

  $ gss_control_example | tr '\n' ' ' | sed 's/.*k1 \([^ ,;]*\).*k3 \([^ ,;]*\).*cost \([^ ,;]*\).*theta \([^ ,;]*\).*tip \([^ ,;]*\).*/k1,k3,cost,theta,tip\n\1,\2,\3,\4,\5\n/' |
  >   holds 'k3 = k1*cost +- 1e-5' 'theta = 0.5 +- 0.03' 'tip = 0 +- 0.01'

A spacecraft from a file
------------------------

Keys that it does not have keep Table 3.1's values, here all but tips:

  $ printf 'tip_mass = 0\ntip_inertia = 0.0\n' > bare.toml
# oracle: gss_control_plant bare pole 1, bare pole 2, bare locked 1, bare locked 2, bare theta at 1, bare y2 at 1
  $ gss poles --count 2 --spacecraft bare.toml | holds --each 'imag = [12.85700141881, 72.75595661757] +- 1e-12*imag'
  $ gss zeros --count 2 --spacecraft bare.toml | holds --each 'imag = [11.51094878903, 72.13788468598] +- 1e-12*imag'
  $ gss response --omega 1 --at 2 --spacecraft bare.toml |
  >   holds 'theta_re/-0.0974374222149588 = 1 +- 1e-13' 'y@2_re = -0.00155990461324693 +- 2e-16'

An empty file is Table 3.1's spacecraft, as is one with all its values; comments and 4_0 are TOML's:

  $ gss poles > table.csv
  $ gss response --omega 1 --at 2 > response.csv
  $ printf '' > empty.toml
  $ cat > all.toml <<END
  > # a comment
  > hub_inertia = 8
  > mass_per_length = 0.0271875
  > youngs_modulus = 0.1584e10
  > length = 4
  > hub_radius = 1
  > second_moment = 0.47095e-7
  > tip_mass = 0.1569
  > tip_inertia = 0.0018
  > END
  $ for file in empty all; do
  >   gss poles --spacecraft $file.toml | cmp - table.csv
  >   gss response --omega 1 --at 2 --spacecraft $file.toml | cmp - response.csv
  > done
  $ sed 's/length = 4/length = 4_0/' all.toml > long.toml
  $ gss zeros --at 39 --count 1 --spacecraft long.toml | wc -l
  2

Any consistent units: the help names keys and no unit of the user's.

  $ for command in poles zeros response step optimal-gains; do
  >   gss_control $command --help > help.txt
  >   grep -q 'consistent units' help.txt && grep -q mass_per_length help.txt && ! grep -e 'ft from the rim' -e '1/ft^2' help.txt || echo $command
  > done

Ends of the appendages
----------------------

A beam of unit data on a hub of radius 0. Its frequencies with the hub at rest, the zeros of theta/u, are q^2 with the zeros q of the characteristic
equations of single beams (R. D. Blevins, Formulas for Natural Frequency and Mode Shape, 1979, table 8-1): cos q cosh q = -1, tan q = tanh q, tan q = -tanh q,
cos q cosh q = 1, sin q = 0 and cos q = 0:

  $ unit() {
  >   printf 'hub_inertia = 1\nmass_per_length = 1\nyoungs_modulus = 1\nlength = 1\nhub_radius = 0\nsecond_moment = 1\ntip_mass = 0\ntip_inertia = 0\n%b' "$1" > unit.toml
  >   shift; gss_control "$@" --spacecraft unit.toml
  > }
  $ unit '' zeros --count 1 | holds 'sqrt(imag) = findroot(lambda q: cos(q) * cosh(q) + 1, 1.9) +- 1e-12'
  $ unit 'root_stiffness = "clamped"\ntip_support = "free"' zeros --count 1 | holds 'sqrt(imag) = 1.875104068711961 +- 1e-12'
  $ unit 'root_stiffness = 0' zeros --count 2 | holds --each 'q := sqrt(imag)' 'tan(q) - tanh(q) = 0 +- 1e-11' 'q = [3.9266, 7.0686] +- 1e-4'
  $ unit 'tip_support = "pinned"' zeros --count 1 | holds 'sqrt(imag) = 3.926602312047919 +- 4e-12'
  $ unit 'tip_support = "guided"' zeros --count 1 | holds 'sqrt(imag) = 2.365020372431352 +- 3e-12'
  $ unit 'root_stiffness = 0\ntip_support = "clamped"' zeros --count 1 | holds 'sqrt(imag) = 3.926602312047919 +- 4e-12'
  $ unit 'tip_support = "clamped"' zeros --count 1 | holds 'sqrt(imag) = 4.730040744862704 +- 5e-12'
  $ unit 'root_stiffness = 0\ntip_support = "pinned"' zeros --count 3 | holds --each 'sqrt(imag) = (i + 1)*pi +- 1e-11'
  $ unit 'root_stiffness = 0\ntip_support = "guided"' zeros --count 3 | holds --each 'sqrt(imag) = (i + 0.5)*pi +- 1e-11'

The elastically hinged beam has k (1 + cos q cosh q) + q (cos q sinh q - sin q cosh q) = 0, a soft one is a rigid bar on a spring, omega^2 = 3 k:

  $ for k in 0.01 2.5 100; do
  >   unit "root_stiffness = $k" zeros --count 4 | holds --each 'q := sqrt(imag)' "$k*(1/cosh(q) + cos(q)) + q*(cos(q)*tanh(q) - sin(q)) = 0 +- 1e-10"
  > done
  $ unit 'root_stiffness = 1e-8' zeros --count 1 | holds 'imag^2 = 3e-8 +- 3e-16'

A torque on each tip turns the rigid body of inertia 1 + 2/3 by t^2/J. At rest it bends the beams by 1/2, and the turn of the hub, whose inertial load is
triangular, by -11/120 of 2/J (any table of beams):

  $ unit '' response --torque-on tips --omega 1e-4 --at 1 | holds 'theta_re = -1e8*2/(5/3) +- 10' 'theta_im = 0' 'y@1_re = 1/2 - 11/120*6/5 +- 1e-8' 'y@1_im = 0'
  $ gss step --torque-on tips --until 100 --at 4 | holds 'theta/(1e4/18.0961) = 1 +- 1e-3'
  $ unit '' step --torque-on tips --until 1 --at 1
  gss_control: not_converged: step response: a torque on tips without inertia gives the appendages rates whose sum over the modes does not converge; give a tip_inertia, or ask for no deflection
  [1]
  $ gss step --torque-on hub --until 3 > hub.csv
  $ gss step --until 3 | cmp - hub.csv

A guided tip keeps the slope of the hub, so that a torque on it is one on the hub; with pinned tips the hub still turns to its angle:

  $ echo 'tip_support = "guided"' > guided.toml
  $ gss response --omega 1,30,200 --at 2 --spacecraft guided.toml > hub.csv
  $ gss response --omega 1,30,200 --at 2 --torque-on tips --spacecraft guided.toml | paste -d , - hub.csv | sed '1s/.*/w,t,ti,y,yi,W,T,Ti,Y,Yi/' |
  >   holds --each 't/T = 2 +- 1e-12' 'y/Y = 2 +- 1e-11'
  $ printf 'root_stiffness = 20\ntip_support = "pinned"\n' > pinned.toml
  $ gss step --gains 12,0,16 --until 10000 --at 2,4 --spacecraft pinned.toml | holds 'theta = 1 +- 1e-9' 'y@2 = 0 +- 1e-8' 'y@4 = 0'

Appendages that swing freely about pinned roots have frequencies and responses, but no motion that is told, nor a control:

  $ echo 'root_stiffness = 0' > swinging.toml
  $ gss response --omega 3 --at 4 --spacecraft swinging.toml | wc -l
  2
  $ refused gss_control step --until 1 --spacecraft swinging.toml
  gss_control: step: the appendages swing freely about pinned roots; give a root_stiffness above 0 or a support of the tips
  $ refused gss_control poles --gains 1,0,1 --spacecraft swinging.toml
  gss_control: --gains: the appendages swing freely about pinned roots; give a root_stiffness above 0 or a support of the tips
  $ refused gss_control zeros --at 4 --spacecraft pinned.toml
  gss_control: --at 4: the deflection of a held tip is 0 for every s
  $ refused gss_control step --until 1 --torque-on tips --gains 1,0,1
  gss_control: --torque-on tips: the controller of --gains acts on the hub; leave one of them out
  $ refused gss_control optimal-gains --deflection-weight 1 --torque-weight 1 --spacecraft pinned.toml
  gss_control: --deflection-weight 1 --torque-weight 1: statics: for appendages with a clamped root and a free tip alone; leave out root_stiffness and tip_support
  $ for text in 'root_stiffness = -1' 'root_stiffness = "soft"' 'root_stiffness = inf' 'root_stiffness = 1e-200' 'tip_support = "welded"' 'tip_support = 3'; do
  >   echo "$text" > ends.toml; refused gss_control poles --spacecraft ends.toml
  > done
  gss_control: ends.toml, line 1: root_stiffness = -1: must not be negative
  gss_control: ends.toml, line 1: root_stiffness = 'soft': neither a number nor 'clamped'
  gss_control: ends.toml, line 1: root_stiffness = inf: not a finite number
  gss_control: ends.toml: spacecraft: root_stiffness length/(youngs_modulus second_moment) = 5.36204e-202 is outside 1e-75 to 1e+75: no computation in double precision is possible
  gss_control: ends.toml, line 1: tip_support = 'welded': must be 'free', 'pinned', 'guided' or 'clamped'
  gss_control: ends.toml, line 1: tip_support = 3: must be 'free', 'pinned', 'guided' or 'clamped'

Where no number can be told
---------------------------

Undamped oscillations some 1e16 radians on, t^2/2J beyond the largest double, a response on a pole. A controlled spacecraft has come to rest:

  $ gss step --until 1e15 --at 2
  gss_control: outside_validity: step: at t = 1e+15 s rounding leaves the phase of the oscillations of y at 2 undetermined (0.00475* of 0.00475*); ask for an earlier time (glob)
  [1]
  $ gss step --until 1e308
  gss_control: non_finite: step: theta is not finite at t = 1e+308 s; ask for an earlier time
  [1]
  $ gss step --gains 12,0,16 --until 1e300 --at 2 | holds 'theta = 1 +- 1e-12' 'y@2 = 0 +- 1e-12'
  $ gss response --omega $(gss poles --count 1 | tail -1 | cut -d, -f 3)
  gss_control: at_pole: transfer function: s = 0 + 6.45295996574* i is a pole to the rounding of s; choose another frequency (glob)
  [1]

Data with which no number of double can be computed:

  $ for text in 'length = 1e300' 'length = 1e100' 'length = 1e-100' 'mass_per_length = 1e308' 'youngs_modulus = 1e-308' \
  >   'second_moment = 1e308' 'tip_mass = 1e300' 'hub_inertia = 1e308' 'hub_radius = 1e200'; do
  >   echo $text > far.toml
  >   for command in poles zeros "response --omega 1" "step --until 1" "step --until 1 --gains 1,1,1"; do
  >     refused gss_control $command --spacecraft far.toml | sed 's/gss_control: far.toml, .*double precision.*/double precision/'
  >   done
  > done | sort | uniq -c
        5 gss_control: far.toml: spacecraft: hub_inertia/(mass_per_length length^3) = 5.74713e+307 is outside 0 to 1e+75: no computation in double precision is possible
        5 gss_control: far.toml: spacecraft: hub_radius/length = 2.5e+199 is outside 0 to 1e+75: no computation in double precision is possible
        5 gss_control: far.toml: spacecraft: mass_per_length length^3 = 2.71875e+298 is outside 1e-150 to 1e+150: no computation in double precision is possible
        5 gss_control: far.toml: spacecraft: mass_per_length length^3 = 2.71875e-302 is outside 1e-150 to 1e+150: no computation in double precision is possible
       10 gss_control: far.toml: spacecraft: mass_per_length length^3 = inf is outside 1e-150 to 1e+150: no computation in double precision is possible
        5 gss_control: far.toml: spacecraft: tip_mass/(mass_per_length length) = 9.1954e+300 is outside 0 to 1e+75: no computation in double precision is possible
        5 gss_control: far.toml: spacecraft: youngs_modulus second_moment = 4.7095e-316 is outside 1e-150 to 1e+150: no computation in double precision is possible
        5 gss_control: far.toml: spacecraft: youngs_modulus second_moment = inf is outside 1e-150 to 1e+150: no computation in double precision is possible

Each value of a spacecraft and each gain within the range but at its far ends gives numbers or a sentence:

  $ check() {
  >   if gss_control "$@" > out.csv 2> said.txt; then grep -H -e nan -e inf out.csv
  >   elif [ -s out.csv ] || [ $(wc -c < said.txt) -le 20 ]; then echo "$@"; cat out.csv said.txt; fi; true
  > }
  $ for text in 'length = 1e15' 'length = 1e-15' 'tip_mass = 1e60' 'hub_inertia = 1e60' 'hub_inertia = 0' 'hub_radius = 1e30' 'youngs_modulus = 1e-40'; do
  >   echo $text > end.toml
  >   for command in poles "zeros --count 3" "response --omega 1" "step --until 1 --gains 1,1,1"; do check $command --spacecraft end.toml; done
  > done
  $ for gains in 1e300,0,1 1,1e300,1 1,0,1e300 1e-300,0,1e-300 1,-1.9999999999999998,1 1e308,1e308,1e308 0,0,0; do
  >   check step --until 1 --at 2 --gains $gains
  >   check poles --gains $gains
  >   check response --omega 1e-300,1,1e150 --at 2 --gains $gains
  > done
  $ check response --omega 1e-300:1e300:9 --at 0,4
  $ check step --until 1e-308 --at 4
  $ check optimal-gains --deflection-weight 1e308 --torque-weight 1e-308
  $ check optimal-gains --deflection-weight 0 --torque-weight 1e308 --pd

Mistakes
--------

  $ wrong() { refused gss_control "$@"; }
  $ wrong poles --count 0
  gss_control: --count 0: must be a whole number from 1 to 1000
  $ wrong poles --count 2.5
  gss_control: --count 2.5: must be a whole number from 1 to 1000
  $ wrong poles --gains 1,1
  gss_control: --gains 1,1: 2 numbers; needs three, k1,k2,k3
  $ wrong poles --gains 12,0,16,1
  gss_control: --gains 12,0,16,1: 4 numbers; needs three, k1,k2,k3
  $ wrong poles --gains 1,-2,1
  gss_control: --gains 1,-2,1: k2 = -2: it must be above -2, at which the appendages exert no torque on the hub
  $ wrong poles --gains -1,0,16
  gss_control: --gains -1,0,16: k1 = -1: it must be at least 0
  $ wrong poles --gains 1,nan,1
  gss_control: --gains 1,nan,1: 'nan' is not a finite number
  $ wrong poles --spacecraft /no/such/file.toml
  gss_control: /no/such/file.toml: No such file or directory
  $ wrong zeros --at 5
  gss_control: --at 5: 5 is not on the appendage; give a distance from 0 to 4
  $ wrong zeros --at 0
  gss_control: --at 0: the deflection at the root is 0 for every s; give a distance above 0
  $ wrong zeros --at 1,2
  gss_control: --at 1,2: several places; give one, whose zeros are found
  $ wrong response
  --omega is required
  Run with --help for more information.
  $ wrong response --omega 1 --at 4.5
  gss_control: --at 4.5: 4.5 is not on the appendage; give a distance from 0 to 4
  $ wrong response --omega 1 --at -1
  gss_control: --at -1: -1 is not on the appendage; give a distance from 0 to 4
  $ for omega in x 0 inf 1:2 1, 1,nan 1:2:3:4 0:1:5 2:1:5 1:2:1 1:2:1.5; do wrong response --omega $omega; done
  gss_control: --omega x: 'x' is not a finite number
  gss_control: --omega 0: 0 is the double pole of a free body
  gss_control: --omega inf: 'inf' is not a finite number
  gss_control: --omega 1:2: LO:HI:N needs three parts, not 2
  gss_control: --omega 1,: '' is not a finite number
  gss_control: --omega 1,nan: 'nan' is not a finite number
  gss_control: --omega 1:2:3:4: LO:HI:N needs three parts, not 4
  gss_control: --omega 0: must be positive
  gss_control: --omega 2:1:5: in LO:HI:N LO must be below HI, and N at least 2
  gss_control: --omega 1:2:1: in LO:HI:N LO must be below HI, and N at least 2
  gss_control: --omega 1.5: must be a whole number from 1 to 10000000
  $ wrong step
  --until is required
  Run with --help for more information.
  $ wrong step --until -1
  gss_control: --until -1: must be positive
  $ wrong step --until 1 --every 0
  gss_control: --every 0: must be positive
  $ wrong step --until 1 --every 1e-9
  gss_control: --every 1e-09: more than 10 million rows
  $ wrong step --until 1 --final-angle 1
  gss_control: --final-angle 1: needs --gains k1,k2,k3
  $ wrong step --until 1 --gains 1,1,1 --final-angle nan
  gss_control: --final-angle nan: not a finite number
  $ wrong optimal-gains
  --deflection-weight is required
  Run with --help for more information.
  $ wrong optimal-gains --deflection-weight -1 --torque-weight 1
  gss_control: --deflection-weight -1: must not be negative
  $ wrong optimal-gains --deflection-weight 1 --torque-weight 0
  gss_control: --torque-weight 0: must be positive

A file with line, key and value, by each command:

  $ echo 'mass = 3' > bad.toml
  $ for command in poles zeros "response --omega 1" "step --until 1" "optimal-gains --deflection-weight 1 --torque-weight 1"; do
  >   wrong $command --spacecraft bad.toml
  > done
  gss_control: bad.toml, line 1: mass = 3: no such key; the keys are hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, second_moment, tip_mass, tip_inertia, root_stiffness, tip_support
  gss_control: bad.toml, line 1: mass = 3: no such key; the keys are hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, second_moment, tip_mass, tip_inertia, root_stiffness, tip_support
  gss_control: bad.toml, line 1: mass = 3: no such key; the keys are hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, second_moment, tip_mass, tip_inertia, root_stiffness, tip_support
  gss_control: bad.toml, line 1: mass = 3: no such key; the keys are hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, second_moment, tip_mass, tip_inertia, root_stiffness, tip_support
  gss_control: bad.toml, line 1: mass = 3: no such key; the keys are hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, second_moment, tip_mass, tip_inertia, root_stiffness, tip_support
  $ bad() { printf "$1" > bad.toml; refused gss_control poles --spacecraft bad.toml; }
  $ bad '\n\nlenght = 5\n'
  gss_control: bad.toml, line 3: lenght = 5: no such key; the keys are hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, second_moment, tip_mass, tip_inertia, root_stiffness, tip_support
  $ bad 'length = "long"\n'
  gss_control: bad.toml, line 1: length = 'long': not a number
  $ bad 'length = true\n'
  gss_control: bad.toml, line 1: length = true: not a number
  $ bad 'length = [4]\n'
  gss_control: bad.toml, line 1: length = [ 4 ]: not a number
  $ bad 'tip_mass = 0.1\nlength = nan\n'
  gss_control: bad.toml, line 2: length = nan: not a finite number
  $ bad 'length = inf\n'
  gss_control: bad.toml, line 1: length = inf: not a finite number
  $ bad 'length = -4\n'
  gss_control: bad.toml, line 1: length = -4: must be positive
  $ bad 'length = 0\n'
  gss_control: bad.toml, line 1: length = 0: must be positive
  $ bad '\n\nyoungs_modulus = -1\n'
  gss_control: bad.toml, line 3: youngs_modulus = -1: must be positive
  $ bad 'tip_mass = -0.1\n'
  gss_control: bad.toml, line 1: tip_mass = -0.10000000000000001: must not be negative
  $ bad 'length = 4\nlength = 5\n'
  gss_control: bad.toml, line 2, column 10: Error while parsing key-value pair: cannot redefine existing integer 'length'
  $ bad 'length = \n'
  gss_control: bad.toml, line 1, column 10: Error while parsing key-value pair: expected value, saw '\n'
  $ bad 'length 4\n'
  gss_control: bad.toml, line 1, column 8: Error while parsing key-value pair: expected '=', saw '4'
  $ bad '[craft]\nlength = 4\n'
  gss_control: bad.toml, line 1: craft = length = 4: no such key; the keys are hub_inertia, mass_per_length, youngs_modulus, length, hub_radius, second_moment, tip_mass, tip_inertia, root_stiffness, tip_support
