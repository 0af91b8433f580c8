Coordinates on an ellipsoid
===========================

`geodesy forward` and `geodesy reverse` read CSV and write CSV. A position near Stuttgart, there and back:

  $ printf 'x,y,z\n3912960.8375,1424201.2720,4816553.5940\n' > stuttgart.csv
  $ geodesy reverse --method series --order 6 stuttgart.csv | sed -n 1p
  latitude_deg,longitude_deg,height_m
  $ geodesy reverse --method series --order 6 stuttgart.csv | geodesy forward - | holds --like stuttgart.csv 2e-9

The default order 4 is right to 2.5e-11 degrees and 8.1e-7 m, as the header of the series says:

  $ cat > points.csv <<END
  > latitude_deg,longitude_deg,height_m
  > 45.5,-120.25,400000
  > -89.5,179.75,35000000
  > 0,0,200000
  > END
  $ geodesy forward points.csv | geodesy reverse --method series - > back.csv
  $ holds --each < back.csv 'latitude_deg = [45.5, -89.5, 0] +- 2.5e-11' 'longitude_deg = [-120.25, 179.75, 0] +- 1e-12' \
  >   'height_m = [4e5, 35e6, 2e5] +- 8.1e-7'

Poles, and both sides of the antimeridian. Right angles are exact; the polar radius of WGS 84 is a (1 - f), to a unit of the last place:

  $ printf '0,0,6400000\n0,0,-6400000\n-7000000,0,0\n-7000000,-0.0,-0.0\n' | geodesy reverse - | cut -d, -f 1,2
  latitude_deg,longitude_deg
  90,0
  -90,0
  0,180
  -0,-180
  $ printf '90,57.3,0\n-90,0,0\n0,90,0\n0,180,0\n' | geodesy forward - > right.csv
  $ holds --each < right.csv 'x = [0, 0, 0, -6378137]' 'y = [0, 0, 6378137, 0]' 'b := 6378137 * (1 - 1/mpf("298.257223563"))' \
  >   'z = [b, -b, z, z] +- 1e-9'

A file that has a header alone, and columns of names or times, which are passed through; a column that the answer has already is renamed:

  $ echo x,y,z > none.csv
  $ geodesy reverse none.csv
  none.csv: no row follows the header
  latitude_deg,longitude_deg,height_m
  $ printf 't,LAT,x,Lon,h\n0.5,30,"a, b",60,100\n' | geodesy forward - > there.csv
  $ head -1 there.csv
  x,y,z,t,input_x
  $ geodesy reverse there.csv > back.csv
  $ cut -d, -f 1-3 --complement back.csv
  t,input_x
  0.5,"a, b"
  $ holds 'latitude_deg = 30 +- 2e-14' < back.csv

Ellipsoids
----------

By size and flattening, or by name. Polar radii of the EPSG registry, to the digits that stand there; the sphere has an exact height:

  $ for ellipsoid in 6378137,0.0033528106647474805 6378137,1/298.257223563 wgs84; do
  >   echo 4e6,3e6,5e6 | geodesy reverse --ellipsoid $ellipsoid - | holds 'longitude_deg = atan2(3, 4) * 180/pi +- 1e-13'
  > done
  $ echo 3000,0,4000 | geodesy reverse --ellipsoid 1000,0 - | holds 'height = 4000'
  $ echo 3000,0,4000 | geodesy reverse --ellipsoid 1000,-0.01 - | holds 'longitude_deg = 0'
  $ while IFS=: read -r name radius; do
  >   echo 0,0,7e6 | geodesy reverse --ellipsoid "$name" - | holds "height_m = 7e6 - mpf(\"$radius\") +- 1e-6"
  > done <<END
  > WGS 84:6356752.314245
  > GRS80:6356752.314140
  > wgs72:6356750.520016
  > Bessel-1841:6356078.962818
  > clarke1866:6356583.8
  > SPHERE:6371000
  > international1924:6356911.946128
  > krassowsky1940:6356863.018773
  > airy1830:6356256.909237
  > END

The unit of A,F is the user's, so that a height is not in metres:

  $ echo 7000,0,0 | geodesy reverse --ellipsoid 6378.137,1/298.257223563 - > km.csv
  $ head -1 km.csv
  latitude_deg,longitude_deg,height
  $ geodesy forward --ellipsoid 6378.137,1/298.257223563 km.csv
  x,y,z
  7000,0,0

Where the series is not exact it says so
----------------------------------------

In degrees, whatever the unit. On the ellipsoid 1,0.5 bisection in 50 digits gives 34.52125 degrees for the first point, and the series 34.890:

  $ off_by() { geodesy reverse --method series "$@" - 2>&1 > out.csv; }
  $ echo 1,0,0.2 | off_by --order 6 --ellipsoid 1,0.5
  geodesy: warning: at line 1 the series of order 6 is off by 0.37 degrees of latitude and by 0.0015 of height; --method fast is exact to rounding
  $ echo 5e6,0,4.2e6 | off_by --order 4 --ellipsoid 6378137,0.1
  geodesy: warning: at line 1 the series of order 4 is off by 2.1e-05 degrees of latitude and by 15 of height; --method fast is exact to rounding
  $ for unit in '' e-3 e-30 e30; do
  >   echo 100000$unit,0,100000$unit | off_by --ellipsoid 6378137$unit,1/298.257223563
  >   echo 4000000$unit,0,5000000$unit | off_by --ellipsoid 6378137$unit,1/298.257223563
  > done
  geodesy: warning: at line 1 the series of order 4 is off by 0.028 degrees of latitude and by 2.7 of height; --method fast is exact to rounding
  geodesy: warning: at line 1 the series of order 4 is off by 0.028 degrees of latitude and by 0.0027 of height; --method fast is exact to rounding
  geodesy: warning: at line 1 the series of order 4 is off by 0.028 degrees of latitude and by 2.7e-30 of height; --method fast is exact to rounding
  geodesy: warning: at line 1 the series of order 4 is off by 0.028 degrees of latitude and by 2.7e+30 of height; --method fast is exact to rounding

With no digit left it ends with 1 and prints nothing (39.26971 degrees against 40.067 of the series; a point in the core):

  $ echo 1,0,0.25 | geodesy reverse --method series --order 6 --ellipsoid 1,0.5 -
  geodesy: outside_validity: standard input, line 1: the series of order 6 is not valid at (1, 0, 0.25); use --method fast, which is valid everywhere
  [1]
  $ echo 0.5,0,0 | geodesy reverse --method series --order 6 --ellipsoid 1,0.5 -
  geodesy: outside_validity: standard input, line 1: the series of order 6 is not valid at (0.5, 0, 0); use --method fast, which is valid everywhere
  [1]
  $ printf '7000000,0,0\n1000,0,1000\n' | geodesy reverse --method series -
  geodesy: outside_validity: standard input, line 2: the series of order 4 is not valid at (1000, 0, 1000); use --method fast, which is valid everywhere
  [1]

Below the evolute another point of the surface is nearer; on the equator that is at a depth of a (1 - e^2) = 6335439.327 m:

  $ printf '45,10,-6.3e6\n0,0,-6335439\n' | geodesy forward - > out.csv
  $ printf '45,10,-6.3e6\n0,0,-6335440\n' | geodesy forward - > out.csv
  geodesy: note: the point of line 2 is so deep that another point of the ellipsoid is nearer; reverse returns the coordinates of the nearest point

Mistakes
--------

Each ends with 2 and names file, line, column and text:

  $ bad() { cat > points.csv; refused geodesy "$@" points.csv; }
  $ refused geodesy reverse nowhere.csv
  geodesy: nowhere.csv: No such file or directory
  $ printf 'x,y,z\n1,2,3\n4,5six,6\n' | bad reverse
  geodesy: points.csv: line 3, column 2 (y): '5six' is not a finite number
  $ echo 7e6,0,nan | bad reverse
  geodesy: points.csv: line 1, column 3 (z): 'nan' is not a finite number
  $ echo 7e6,inf,0 | bad reverse
  geodesy: points.csv: line 1, column 2 (y): 'inf' is not a finite number
  $ echo 7e6,0,1e999 | bad reverse
  geodesy: points.csv: line 1, column 3 (z): '1e999' is not a finite number
  $ echo 7e6,0,0x10 | bad reverse
  geodesy: points.csv: line 1, column 3 (z): '0x10' is not a finite number
  $ echo 7e6,,0 | bad reverse
  geodesy: points.csv: line 1, column 2 (y): '' is not a finite number
  $ echo 7e6,0 | bad reverse
  geodesy: points.csv: line 1: '7e6,0' does not name the columns; the first line must name x,y,z
  $ printf '7e6,0,1\n7e6,0\n' | bad reverse
  geodesy: points.csv: line 2: 2 of 3 cells
  $ printf '' | bad reverse
  geodesy: points.csv: is empty; the first line must name the columns x,y,z
  $ printf '\n\n7e6,0,0,1\n' | bad reverse
  geodesy: points.csv: line 3: '7e6,0,0,1' does not name the columns; the first line must name x,y,z
  $ printf 'B,L,h\n1,2,3\n' | bad forward
  geodesy: points.csv: line 1: there is no column latitude_deg; the header must name latitude_deg,longitude_deg,height_m, separated by commas, and is 'B,L,h'
  $ echo 90.0000001,0,0 | bad forward
  geodesy: points.csv: line 1: latitude_deg = 90.0000001 is not between -90 and 90
  $ point() { echo 1,2,3 | bad reverse "$@"; }
  $ point --ellipsoid 6378137
  geodesy: --ellipsoid 6378137: no such name, and no comma; give wgs84, wgs72, grs80, international1924, krassowsky1940, bessel1841, airy1830, clarke1866, sphere, or A,F as in 6378137,1/298.257223563
  $ point --ellipsoid 6378137,298.257
  geodesy: --ellipsoid 6378137,298.257: F = 298.257 must be below 1 (the inverse of a flattening is written 1/298.257); give wgs84, wgs72, grs80, international1924, krassowsky1940, bessel1841, airy1830, clarke1866, sphere, or A,F as in 6378137,1/298.257223563
  $ point --ellipsoid=-1,0
  geodesy: --ellipsoid -1,0: Ellipsoid: equatorial radius must be finite and positive, is -1.000000; give wgs84, wgs72, grs80, international1924, krassowsky1940, bessel1841, airy1830, clarke1866, sphere, or A,F as in 6378137,1/298.257223563
  $ point --ellipsoid 1,1
  geodesy: --ellipsoid 1,1: F = 1 must be below 1 (the inverse of a flattening is written 1/1); give wgs84, wgs72, grs80, international1924, krassowsky1940, bessel1841, airy1830, clarke1866, sphere, or A,F as in 6378137,1/298.257223563
  $ point --ellipsoid 1,1/0
  geodesy: --ellipsoid 1,1/0: F is not a number; give wgs84, wgs72, grs80, international1924, krassowsky1940, bessel1841, airy1830, clarke1866, sphere, or A,F as in 6378137,1/298.257223563
  $ point --ellipsoid 1,-1e150
  geodesy: --ellipsoid 1,-1e150: ClosestPoint: semi-axes must be representable and of a ratio below 1e100, are 1.000000 and 99999*.000000 (glob)
  $ point --order 7
  geodesy: --order 7: must be a whole number from 1 to 6
  $ point --method magic
  geodesy: --method magic: must be one of fast, series

Options of the series mean nothing to the fast method:

  $ point --order 5
  geodesy: --order 5: belongs to the series; add --method series, or leave it out
  $ point --method fast --height series
  geodesy: --height series: belongs to the series; add --method series, or leave it out
