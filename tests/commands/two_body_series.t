Orbits: states, elements, propagation
=====================================

  $ two_body() { two_body_series "$@"; }
  $ low="--position 1702547.136867679,6353992.417071098,0 --velocity -7886.014053829254,2113.051097224035,0"

Rows
----

test_orbits.py compares their numbers with Kepler's problem. A distance that divides the time, in doubles or not, makes no second row at the
end; no time is one row:

  $ propagate() { two_body_series propagate "$@"; }
  $ propagate $low --until 6500 --every 1000 | cut -d, -f 1 | paste -s -d ' '
  t 0 1000 2000 3000 4000 5000 6000 6500
  $ propagate $low --until 0.3 --every 0.1 | wc -l
  5
  $ propagate $low --until 1 --every 2 | cut -d, -f 1
  t
  0
  1
  $ for method in series kepler rkn1210; do propagate $low --until 0 --every 10 --method $method | holds 'n = 1' 't = 0' 'x = 1702547.136867679'; done

Rows at times of a list or a file, on one side of 0, have the bits of rows at equal intervals:

  $ printf 't\n-2000\n-1000\n-3000\n' > times.csv
  $ for method in series kepler rkn1210; do
  >   propagate $low --at 3000,1000,2000,1000 --method $method > at.csv
  >   propagate $low --until 3000 --every 1000 --method $method | sed 2d | cmp - at.csv
  >   propagate $low --at times.csv --method $method > at.csv
  >   propagate $low --until -3000 --every 1000 --method $method | sed 2d | cmp - at.csv
  > done
  $ propagate $low --at 0 | holds 'n = 1' 't = 0' 'x = 1702547.136867679'

The end does not know of the rows:

  $ for method in series kepler rkn1210; do
  >   for sign in '' -; do
  >     propagate $low --until ${sign}6500 --every 1000 --method $method | tail -1 > rows.txt
  >     propagate $low --until ${sign}6500 --method $method | tail -1 | cmp - rows.txt
  >   done
  > done

A radial fall from rest at distance 2 with mu = 1 reaches the centre after pi. Kepler's solution returns to where it was at 2 pi:

  $ fall="--position 2,0,0 --velocity 0,0,0 --mu 1"
  $ propagate $fall --until 4 --every 0.5 --method series
  two_body_series: collision: analytic-continuation: the body falls into the centre of attraction at t = 3.14159265*; Kepler's solution (method kepler) goes through, a series cannot (glob)
  [1]
  $ propagate $fall --until 4 --every 0.5 --method rkn1210
  two_body_series: step_underflow: rkn1210: stopped at t = 3.14159265*, at a distance of * from the centre; loosen the tolerance 1e-15, or use the method series; about a point mass --method kepler needs no steps and is exact to rounding (glob)
  [1]
  $ propagate $fall --until 4
  two_body_series: collision: analytic-continuation: the body falls into the centre of attraction at t = 3.14159265*; Kepler's solution (method kepler) goes through, a series cannot (glob)
  [1]
  $ propagate $fall --method kepler --until 6.283185307179586 | holds 'x = 2 +- 1e-14'

A phase that rounding leaves undetermined is no answer; one of few digits is said to be one:

  $ propagate $low --method kepler --until 1e100
  two_body_series: outside_validity: Kepler's problem: rounding of the data leaves the place after 1e+100 undetermined (its condition, 1.*e+98, times the rounding of doubles leaves not one digit); ask for a time nearer 0 (glob)
  [1]
  $ propagate $low --method kepler --until -1e300
  two_body_series: outside_validity: Kepler's problem: rounding of the data leaves the place after -1e+300 undetermined (its condition, 1.*e+298, times the rounding of doubles leaves not one digit); ask for a time nearer 0 (glob)
  [1]
  $ propagate $low --method kepler --until 1e21
  two_body_series: outside_validity: Kepler's problem: rounding of the data leaves the place after 1e+21 undetermined (its condition, 1.*e+19, times the rounding of doubles leaves not one digit); ask for a time nearer 0 (glob)
  [1]
  $ propagate $low --method kepler --until 1e15 > rows.csv
  two_body_series: the data, rounded to doubles, determine the position at t = 1e+15 to * of the distance (glob)
  $ propagate $low --method kepler --until 1e8 > rows.csv

Nearly at rest far out, near the parabola, velocities have fewer digits than positions (at 2 with a speed of 1e-4, after 100 revolutions: mpmath):

  $ slow() { propagate --position 2,0,0 --velocity 0,$1,0 --mu 1 --until $2 --method $3; }
  $ slow 1e-4 628.3185307179587 kepler | holds 'vx = 2.356194519e-6 +- 1e-11'
  $ slow 1e-4 628.3185307179587 series
  two_body_series: outside_validity: series: the velocity at t = 628.319 differs from Kepler's solution by * of the speed: the tolerance 1e-15 of a step is too large for it; take --method kepler (glob)
  [1]
  $ slow 1e-3 628.3185307179587 series > rows.csv
  two_body_series: the velocity at t = 628.319 differs from Kepler's solution by * of the speed: the tolerance 1e-15 of a step is too large for it; take --method kepler (glob)
  $ slow 1e-9 6283185.307179586 kepler > rows.csv
  two_body_series: the data, rounded to doubles, determine the velocity at t = 6.28319e+06 to * of the speed (glob)
  $ propagate --position 1,0,0 --velocity 0,1e-9,0 --mu 1 --until 1e4 --limit 1e-9
  two_body_series: time_limit: * (glob)
  [1]

An oblate Earth for a day; double precision errs by 2e-6 m:

  $ day() { two_body_series propagate --position 7e6,0,0 --velocity 0,4700,5900 --until 86400 --radius 6378137 --zonal "$@"; }
# oracle: two_body_series_orbits day of circular ?
  $ for method in series rkn1210; do
  >   day 1.08262668e-3 --method $method |
  >     holds 'hypot(hypot(x - 4532841.9627156031062, y + 3542172.7947567830238), z + 3979637.2144251580166) < 1e-5'
  > done

With J2 to J6 both methods agree, and are elsewhere:

  $ all=1.08262668e-3,-2.53265649e-6,-1.61962159e-6,-2.27296083e-7,5.40681239e-7
  $ day $all --every 10000 --method rkn1210 > rkn.csv
  $ day $all --every 10000 > series.csv
  $ holds --each --like rkn.csv 1e-5 'n = 10' < series.csv
  $ holds 'abs(y + 3542172.8) > 100' < series.csv

Events
------

An ellipse with e = 0.3 and the argument of the periapsis 40 degrees, from M = 90 degrees. Its nodes are at the true anomalies -40 and 140 degrees, and
r = 1.1 where cos E = -1/3; Kepler's equation gives the times:

  $ two_body state --a 1 --e 0.3 --i 50 --raan 300 --argp 40 --mean-anomaly 90 --mu 1 | tail -1 > state.csv
  $ ellipse="--position $(cut -d, -f 1-3 state.csv) --velocity $(cut -d, -f 4-6 state.csv) --mu 1"
  $ M='M := lambda nu: (lambda E: E - 0.3*sin(E))(2*atan(sqrt(0.7/1.3)*tan(nu/2)))'
  $ passes() { holds --where event="$1" "$M" 'n = 2' 'turn := 2*pi*sign(t)' "t = $2 - pi/2 + turn*i +- 1e-13*(1 + abs(t))" < events.csv; }
  $ for method in series kepler rkn1210; do
  >   propagate $ellipse --until 12 --events nodes,apsides,altitude=0.1 --radius 1 --method $method > events.csv
  >   passes 'ascending node' 'M(-40*pi/180) + turn'
  >   passes 'descending node' 'M(140*pi/180)'
  >   passes periapsis turn
  >   passes apoapsis pi
  >   passes 'altitude=0.1 rising' 'acos(-1/mpf(3)) - 0.1*sqrt(8)'
  >   passes 'altitude=0.1 falling' '0.1*sqrt(8) - acos(-1/mpf(3)) + turn'
  >   propagate $ellipse --until -12 --events "nodes, apsides" --method $method > events.csv
  >   passes 'ascending node' 'M(-40*pi/180)'
  >   passes periapsis 0
  >   passes apoapsis '-pi'
  > done

Rows stand in order of time, and the others have an empty cell:

  $ propagate $ellipse --until 5 --every 2 --events nodes,apsides | cut -d, -f 8 | paste -s -d '|'
  event||descending node|apoapsis|||ascending node|periapsis|

In the field of the Earth to J6, near-circular, both integrators find the same, at least 14 of each in 14.8 revolutions from a node:

  $ J=1.08262668e-3,-2.53265649e-6,-1.61962159e-6,-2.27296083e-7,5.40681239e-7
  $ for method in series rkn1210; do day $J --events nodes,apsides,altitude=6.1e5 --method $method > $method.csv; done
  $ holds --each --like rkn1210.csv 1e-3 'n > 60' < series.csv
  $ holds --each --where 'event=ascending node' 'n = 14' 'z = 0 +- 1e-5' 'vz > 0' < series.csv
  $ holds --each --where event=periapsis 'n >= 14' '(x*vx + y*vy + z*vz)/norm([x, y, z])/norm([vx, vy, vz]) = 0 +- 1e-12' < series.csv
  $ holds --each --where 'event=altitude=6.1e5 rising' 'n >= 14' 'norm([x, y, z]) = 6988137 +- 1e-5' < series.csv

What a motion does not determine is said: nodes in the plane of reference, apsides and altitude of a circle, the centre of a fall:

  $ propagate --position 1,0,0 --velocity 0,1,0 --mu 1 --until 9 --radius 1 --events nodes,apsides,altitude=0 | wc -l
  two_body_series: nodes: z is 0 to within rounding from t = 0 to 9: no row is determined there
  two_body_series: apsides: the distance stays the same to within rounding from t = 0 to 9: no row is determined there
  two_body_series: altitude=0: the altitude stays the same to within rounding from t = 0 to 9: no row is determined there
  3
  $ propagate $fall --method kepler --until 4 --events apsides
  two_body_series: outside_validity: Kepler's problem: rounding of the data leaves the place after 3.14159 undetermined * (glob)
  [1]

Elements
--------

Of the printed states (equations 3.72 and 3.74):

# oracle: two_body_series_orbits LEO eccentricity, LEO period, LEO axis with the implied mu
  $ two_body elements $low | holds 'e = 0.0999999757 +- 1e-10' 'raan + argp = 75 +- 1e-9' 'period = 6218.7281 +- 1e-4'
  $ two_body elements $low --mu 3.98600433e14 | holds 'a = 7309041.111 +- 1e-3' 'e = 0.1 +- 1e-14'

From a shape to the state, to its elements, and back to the state by what fixes the place on any conic. Angles come back to 1e-12, and places to
32 eps of the elements, of which angles are in degrees:

  $ while read -r conic; do
  >   two_body_series state $conic --i 50 --raan 300 --argp 200 --nu -70 < /dev/null > state.csv
  >   two_body_series elements --position $(tail -1 state.csv | cut -d, -f 1-3) --velocity $(tail -1 state.csv | cut -d, -f 4-6) > elements.csv
  >   holds 'i = 50 +- 1e-12' 'raan = 300 +- 1e-12' 'argp = 200 +- 1e-12' 'nu = -70 +- 1e-12' < elements.csv
  >   IFS=, read -r a e i raan argp nu period p q E M t <<ROW
  > $(tail -1 elements.csv)
  > ROW
  >   [ $a = inf ] && form="--e 1" || form="--a $a"
  >   two_body_series state $form --q $q --i $i --raan $raan --argp $argp --time-since-periapsis $t > again.csv
  >   paste -d, state.csv again.csv | sed '1s/.*/x,y,z,vx,vy,vz,X,Y,Z,VX,VY,VZ/' |
  >     holds 'r := 1e-14*norm([x, y, z])' 'v := 1e-14*norm([vx, vy, vz])' \
  >       'X = x +- r' 'Y = y +- r' 'Z = z +- r' 'VX = vx +- v' 'VY = vy +- v' 'VZ = vz +- v'
  > done <<END
  > --a 7e6 --e 0.3
  > --a -7e6 --e 1.5
  > --p 9e6 --e 0.3
  > --p 9e6 --e 1
  > --p 9e6 --e 2
  > END

A parabola has v^2 = 2 mu/r, here exactly; a circle has no direction of its periapsis:

  $ two_body elements --position 1,0,0 --velocity 0,2,0 --mu 2
  a,e,i,raan,argp,nu,period,p,q,eccentric_anomaly,mean_anomaly,time_since_periapsis
  inf,1,0,0,0,0,inf,2,1,0,0,0
  $ two_body state --a 1 --e 0 --mu 1
  x,y,z,vx,vy,vz
  1,0,0,0,1,0

From each anomaly: an ellipse with M = 40 degrees and e = 0.1. E - e sin E = M has the root E = 0.768..., nu follows by tan(nu/2):

  $ E='E := findroot(lambda E: E - 0.1*sin(E) - 40*pi/180, 0.77)'
  $ solve() { python3 -c 'from mpmath import *; E = findroot(lambda E: E - 0.1*sin(E) - 40*pi/180, 0.77); print(eval('"'$1'"'))'; }
  $ for place in "--mean-anomaly 40" "--mean-anomaly -320" "--eccentric-anomaly $(solve 'E*180/pi')" \
  >   "--nu $(solve '2*atan(sqrt(1.1/0.9)*tan(E/2))*180/pi')" "--time-since-periapsis $(solve '40*pi/180')"; do
  >   two_body state --a 1 --e 0.1 --mu 1 $place | holds "$E" 'x = cos(E) - 0.1 +- 1e-14' 'y = sqrt(0.99)*sin(E) +- 1e-14'
  > done

Mistakes
--------

  $ wrong() { refused two_body_series "$@"; }
  $ wrong propagate --position 0,0,0 --velocity 0,1,0 --until 1
  two_body_series: --position 0,0,0: is the centre of attraction; give another position
  $ wrong propagate --position 1,0 --velocity 0,1,0 --until 1
  two_body_series: --position 1,0: 2 numbers; 3 are needed
  $ wrong propagate --position 1,0,0 --velocity 0,one,0 --until 1
  two_body_series: --velocity 0,one,0: 'one' is not a finite number
  $ wrong propagate --position 1,0,0 --velocity 0,1,inf --until 1
  two_body_series: --velocity 0,1,inf: 'inf' is not a finite number
  $ wrong propagate --position 1,0,0 --until 1
  two_body_series: --velocity x,y,z is needed, or --states FILE.csv for many orbits
  $ run() { refused two_body_series propagate --position 1,0,0 --velocity 0,1,0 "$@"; }
  $ run
  two_body_series: --until T is needed, or --at T1,T2,...
  $ run --at 1,2 --until 3
  two_body_series: --until 3: --at 1,2 gives the times of the rows; leave out one of the two
  $ run --at 1,2 --events nodes
  two_body_series: --events nodes: --at 1,2 gives the times of the rows; leave out one of the two
  $ run --at 1,-1
  two_body_series: --at 1,-1: has times before and after 0; ask for each side in a run of its own
  $ run --at 1,2x
  two_body_series: --at 1,2x: '2x' is not a finite number
  $ run --at soon.csv
  two_body_series: soon.csv: No such file or directory
  $ printf 't\n1\nnoon\n' > noon.csv
  $ run --at noon.csv
  two_body_series: noon.csv: line 3, column 1 (t): 'noon' is not a finite number
  $ run --until 1 --events nodes,noon
  two_body_series: --events nodes,noon: there is no event noon; give nodes, apsides, altitude=H
  $ run --until 1 --events altitude=high
  two_body_series: --events altitude=high: not a finite number
  $ run --until 1 --events nodes,apsides,nodes
  two_body_series: --events nodes,apsides,nodes: nodes is there twice
  $ run --until 1 --events altitude=100,altitude=1e2
  two_body_series: --events altitude=100,altitude=1e2: altitude=1e2 is there twice
  $ run --until 1 --mu 1 --events altitude=1
  two_body_series: --events altitude=1: needs --radius R, from which the altitude counts
  $ run --until 1 --mu 1 --radius 1 --events altitude=-1
  two_body_series: --events altitude=-1: is at the distance 0 from the centre; must be above -1
  $ run --until soon
  two_body_series: --until soon: not a finite number
  $ run --until 1 --every 0
  two_body_series: --every 0: must be positive
  $ run --until 1 --every 1e-9
  two_body_series: --every 1e-09: more than 10 million rows
  $ run --until 1 --mu -1
  two_body_series: --mu -1: must be positive
  $ run --until 1 --method euler
  two_body_series: --method euler: must be one of series, rkn1210, kepler
  $ run --until 1 --tolerance 0
  two_body_series: --tolerance 0: must be from 1e-18 to 0.1
  $ run --until 1 --tolerance 1
  two_body_series: --tolerance 1: must be from 1e-18 to 0.1
  $ run --until 1 --tolerance 1e-9 --method kepler
  two_body_series: --tolerance 1e-09: --method kepler is exact to rounding; leave it out
  $ run --until 1 --zonal 1e-3 --radius 1 --method kepler
  two_body_series: --zonal 0.001: --method kepler is for a point mass; use series or rkn1210
  $ run --until 1 --zonal 1e-3
  two_body_series: --zonal 0.001: needs --radius R
  $ run --until 1 --radius 1
  two_body_series: --radius 1: needs --zonal J2[,J3,...], or --events altitude=H
  $ run --until 1 --zonal 1,2,3,4,5,6 --radius 1
  two_body_series: --zonal 1,2,3,4,5,6: 6 numbers; J2 to J6 at most
  $ run --until 1 --zonal 1,,2 --radius 1
  two_body_series: --zonal 1,,2: '' is not a finite number
  $ run --until 1 --zonal 1e-3 --radius 0
  two_body_series: --radius 0: must be positive
  $ run --until 1 --limit 0
  two_body_series: --limit 0: must be positive
  $ wrong elements --position 1,0,0 --velocity 1,0,0
  two_body_series: --position 1,0,0 --velocity 1,0,0 --mu 398600441800000: elements_of: the body moves on a straight line through the centre, which has no classical elements
  $ wrong elements --position 0,0,0 --velocity 1,0,0
  two_body_series: --position 0,0,0: is the centre of attraction; give another position
  $ wrong elements --position 1,0,0 --velocity 0,1,0 --mu 0
  two_body_series: --mu 0: must be positive
  $ state() { refused two_body_series state "$@"; }
  $ state --e 0.1
  two_body_series: --a A, --p P or --q Q is needed
  $ state --a 1 --p 1 --e 0.1
  two_body_series: --a 1 --p 1 --e 0.1: give one of --a, --p and --q with --e, or --a and --q alone
  $ state --a 1
  two_body_series: --a 1: needs --e E
  $ state --a 1 --e -0.1
  two_body_series: --e -0.1: must be 0 or more
  $ state --a 1 --e 1
  two_body_series: --a 1 --e 1: from_axis: a = 1 and e = 1 make no conic (p = a (1 - e^2) must be positive and finite); a is positive for e < 1 and negative for e > 1
  $ state --a 1 --e 1.5
  two_body_series: --a 1 --e 1.5: from_axis: a = 1 and e = 1.5 make no conic (p = a (1 - e^2) must be positive and finite); a is positive for e < 1 and negative for e > 1
  $ state --p 0 --e 1
  two_body_series: --p 0: must be positive
  $ state --p 1 --e 2 --nu 150
  two_body_series: --p 1 --e 2 --nu 150: the true anomaly lies beyond the asymptote of a conic with e = 2, which is at 1* degrees (glob)
  $ state --p 1 --e 1 --nu 180
  two_body_series: --p 1 --e 1 --nu 180: the true anomaly lies on the asymptote of a conic with e = 1, which is at 180 degrees
  $ state --a 1 --q 2
  two_body_series: --a 1 --q 2: no conic has these; a must be at least q, or negative for hyperbolas
  $ state --a 1 --q 0.5 --e 0.5
  two_body_series: --a 1 --q 0.5 --e 0.5: give one of --a, --p and --q with --e, or --a and --q alone
  $ state --q 1 --e 1 --mean-anomaly 3
  two_body_series: --q 1 --e 1 --mean-anomaly 3: a parabola has no mean anomaly; give the time since periapsis
  $ state --q 1 --e 1 --eccentric-anomaly 3
  two_body_series: --q 1 --e 1 --eccentric-anomaly 3: an eccentric anomaly is one of ellipses, and e = 1 is none
  $ state --q 1 --e 0 --nu 3 --mean-anomaly 4
  two_body_series: --nu 3 --mean-anomaly 4: give only one of these
  $ state --a 1 --e 0.1 --i 190
  two_body_series: --i 190: must be from 0 to 180
  $ state --a 1 --e 0.1 --raan x
  two_body_series: --raan x: not a finite number
  $ state --a 1 --e 0.1 --nu 1e20
  two_body_series: --nu 1e20: must be from -360 to 360

Units that cannot be meant, kilometres without --mu:

  $ wrong propagate --position 7000,0,0 --velocity 0,7.5,1 --until 6000
  two_body_series: --position 7000,0,0: without --mu lengths are metres about the Earth, and this orbit stays within 7000 m of its centre; give --mu in your units (398600.4418 for kilometres and seconds)
  $ wrong elements --position 7000,0,0 --velocity 0,7.5,1
  two_body_series: --position 7000,0,0: without --mu lengths are metres about the Earth, and this orbit stays within 7000 m of its centre; give --mu in your units (398600.4418 for kilometres and seconds)
  $ state --a 7000 --e 0.1
  two_body_series: --a 7000 --e 0.1: without --mu lengths are metres about the Earth, and this orbit stays within 14000 m of its centre; give --mu in your units (398600.4418 for kilometres and seconds)

Finite numbers that lead to no finite ones:

  $ state --p 7e6 --e 1e308
  two_body_series: --p 7000000 --e 1e+308: periapsis distance 7e-302, e = 1e+308 and mu = 398600441800000 lead to a distance or a speed that is beyond the range of doubles; take other units or a smaller e
  $ wrong elements --position 7e6,0,0 --velocity 0,7500,0 --mu 1e-300
  two_body_series: --position 7000000,0,0 --velocity 0,7500,0 --mu 1e-300: elements_of: at the distance 7e+06 and the speed 7500 with mu = 1e-300 the eccentricity is beyond 1e300
  $ wrong elements --position 1e308,0,0 --velocity 1,1e-5,0 --mu 1e308
  two_body_series: --position 1e+308,0,0 --velocity 1,1e-05,0 --mu 1e+308: the period is beyond the range of doubles; choose other units

The example of the page
-----------------------

A day about an oblate Earth, by another method:

  $ two_body_series_example | sed 's/success: x = \([^ ]*\) m,.*/x\n\1/' > example.csv
  $ tail -1 rkn.csv | cut -d, -f 2 | sed '1i x' | holds --like example.csv 1e-3
