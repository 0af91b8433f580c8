Transition matrices and covariances
===================================

  $ propagate() { two_body_series propagate --mu 1 "$@"; }
  $ circle="--position 1,0,0 --velocity 0,1,0"
  $ propagate $circle --until 2 --stm | head -1 | cut -d, -f 1-9,43
  t,x,y,z,vx,vy,vz,phi_11,phi_12,phi_66
  $ propagate $circle --until 2 --stm | sed -n 2p | cut -d, -f 8-15
  1,0,0,0,0,0,0,1

Of a circle, from the equations of Clohessy and Wiltshire in the inertial frame, by each method, between too; state and rows are those without --stm:

  $ for method in series kepler rkn1210; do
  >   propagate $circle --until -3 --every 1 --stm --method $method > rows.csv
  >   holds --each 'n = 4' 't = -i' 'phi_33 = cos(t) +- 1e-13' 'phi_36 = sin(t) +- 1e-13' 'phi_63 = -sin(t) +- 1e-13' \
  >     'phi_11 = cos(t)*(2 - cos(t)) + sin(t)*(3*t - 2*sin(t)) +- 1e-12' < rows.csv
  >   cut -d, -f 1-7 rows.csv > states.csv
  >   propagate $circle --until -3 --every 1 --method $method > plain.csv
  >   holds --each --like plain.csv 1e-13 'n = 4' < states.csv
  > done
  $ propagate $circle --until 5 --stm | cut -d, -f 1-7 > states.csv
  $ propagate $circle --until 5 | cmp - states.csv
  $ propagate $circle --until 0 --stm | holds 'n = 1' 'phi_11 = 1' 'phi_12 = 0'

With zonal terms both methods agree:

  $ oblate="--position 1.1,0,0.2 --velocity 0,0.8,0.5 --zonal 1e-3,-2e-6 --radius 0.9 --until 9 --stm"
  $ propagate $oblate --method rkn1210 > rkn.csv
  $ propagate $oblate | holds --like rkn.csv 1e-10 'n = 1'

Covariances
-----------

Without position errors and for a short time the covariance of the position is t^2 times that of the velocity:

  $ cat > cov.csv <<END
  > x,y,z,vx,vy,vz
  > 0,0,0,0,0,0
  > 0,0,0,0,0,0
  > 0,0,0,0,0,0
  > 0,0,0,4e-6,1e-6,0
  > 0,0,0,1e-6,1e-6,0
  > 0,0,0,0,0,9e-6
  > END
  $ propagate $circle --until 1e-3 --covariance cov.csv > rows.csv
  $ head -1 rows.csv | cut -d, -f 7-9,43
  vz,p_11,p_12,p_66
  $ holds 'p_11 = 4e-12 +- 1e-17' 'p_12 = 1e-12 +- 1e-17' 'p_21 = p_12' 'p_33 = 9e-12 +- 1e-17' 'p_44 = 4e-6 +- 1e-11' < rows.csv
  $ propagate $circle --until 1e-3 --covariance cov.csv --stm | head -1 | cut -d, -f 43-44
  phi_66,p_11

A header is not needed, and standard input is a file too. Across a circle errors exchange:

  $ for v in 1 4 9 16 25 36; do echo $v; done | awk '{for (i = 1; i <= 6; ++i) printf "%s%s", i == NR ? $1 : 0, i < 6 ? "," : "\n"}' > diagonal.csv
  $ propagate $circle --until 2 --method kepler --covariance - < diagonal.csv |
  >   holds 'p_33 = 9*cos(2)^2 + 36*sin(2)^2 +- 1e-12' 'p_36 = (36 - 9)*sin(2)*cos(2) +- 1e-12'

Catalogues
----------

  $ printf 'name,x,y,z,vx,vy,vz,phi_11\na,1,0,0,0,1,0,7\nb,1,0,0,0,1.2,0.1,8\n' > orbits.csv
  $ for method in series kepler; do
  >   propagate --states orbits.csv --until 2 --every 1 --stm --covariance diagonal.csv --method $method > rows.csv
  >   head -1 rows.csv | cut -d, -f 8-10,44-46,80-83
  >   holds --where row=1 't = i' 'phi_33 = cos(t) +- 1e-13' 'p_33 = 9*cos(t)^2 + 36*sin(t)^2 +- 1e-12' 'input_phi_11 = 7' 'status = "success"' < rows.csv
  >   propagate --position 1,0,0 --velocity 0,1.2,0.1 --until 2 --stm --method $method > alone.csv
  >   holds "phi := $(tail -1 alone.csv | cut -d, -f 8)" 'phi_11 = phi +- 1e-12' 'name = "b"' < rows.csv
  > done
  vz,phi_11,phi_12,phi_66,p_11,p_12,p_66,name,input_phi_11,status
  vz,phi_11,phi_12,phi_66,p_11,p_12,p_66,name,input_phi_11,status
  $ printf 'x,y,z,vx,vy,vz\n1,0,0,0,0,0\n1,0,0,0,1,0\n' > fall.csv
  $ propagate --states fall.csv --until 5 --stm > rows.csv
  two_body_series: 1 of the orbits failed; the first is row 1: collision: analytic-continuation: the body falls into the centre of attraction at t = 1.11072*; Kepler's solution (method kepler) goes through, a series cannot (glob)
  [1]
  $ cut -d, -f 1,45 rows.csv
  row,status
  1,collision
  2,success

Mistakes
--------

  $ bad() { cat > bad.csv; refused two_body_series propagate --mu 1 $circle --until 1 --covariance bad.csv; }
  $ sed 3d diagonal.csv | bad
  two_body_series: bad.csv: 5 rows of numbers; a covariance of x,y,z,vx,vy,vz has 6 of 6 numbers
  $ cut -d, -f 1-5 diagonal.csv | bad
  two_body_series: bad.csv: line 1: * (glob)
  $ sed '2s/4/nan/' diagonal.csv | bad
  two_body_series: bad.csv: line 2, column 2 (y): 'nan' is not a finite number
  $ sed '2s/4/-4/' diagonal.csv | bad
  two_body_series: bad.csv: line 2, column 2 (y): the variance -4 is negative
  $ sed '2s/^0/0.5/' diagonal.csv | bad
  two_body_series: bad.csv: line 2, column 1 (x): 0.5 differs from 0, the entry across the diagonal
  $ sed '1s/^1,0/1,3/; 2s/^0/3/' diagonal.csv | bad
  two_body_series: bad.csv: line 2, column 2 (y): the variance 4 is too small for the covariances with the variables before: the matrix has a negative eigenvalue (what is left of the variance is -1.25 of it)
  $ refused two_body_series propagate --mu 1 $circle --until 1 --covariance none.csv
  two_body_series: none.csv: No such file or directory
  $ refused two_body_series propagate --mu 1 --states - --until 1 --covariance -
  two_body_series: --covariance -: standard input contains the states; give a file
