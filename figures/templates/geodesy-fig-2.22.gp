# Geodetic, parametric and geocentric latitude in the plane of the meridian (Elgohary 2015, Fig. 2.22).
#
#   gnuplot -e "data='results/geodesy/fig-2.22.csv'" \
#       figures/style.gp figures/templates/geodesy-fig-2.22.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `element,r_xy,z`, lengths in any one unit (the picture scales with the semi-major
# axis). Rows of one element stand together; the order of the elements is free.
#   one row:
#     semi_axes         a in column r_xy, b in column z; 0 < b < a; flattened far beyond the Earth, to be seen
#     satellite         r = (r_xy, z), in the first quadrant, outside the auxiliary circle
#     ground            r_g = (a cos phi_c, b sin phi_c)
#     foot              where the normal through r_g meets the equator: (N e^2 cos phi_g, 0)
#     circle            (a cos phi_c, a sin phi_c), on the auxiliary circle straight above r_g
#     normal_tip        r_g + s n, the end of the arrow for the unit normal n; s shorter than h, about 0.2 a
#   a curve, rows in order along it:
#     ellipse           (a cos u, b sin u), u from -12 to 102 degrees in steps of 1 degree or less
#     auxiliary_circle  (a cos u, a sin u), u likewise
#     arc_geodetic      from the equator to the normal, about `foot`, 0..phi_g, radius about 0.13 a
#     arc_parametric    from the equator to `circle`, about the centre, 0..phi_c, radius about 0.36 a
#     arc_geocentric    from the equator to the satellite, about the centre, 0..phi_0, radius about 0.20 a
# The drawing reads best at b/a = 0.6, phi_g = 60 degrees, h = 0.35 a: the angles differ by several degrees.

if (!exists("heading")) heading = \
    "Three latitudes of one satellite: geodetic φ_g, parametric φ_c, geocentric φ_0"

# Each one-row element becomes two variables: ground_r, ground_z.
do for [name in "semi_axes satellite ground foot circle normal_tip"] {
  stats data using (strcol("element") eq name ? column("r_xy") : NaN) nooutput
  eval sprintf("%s_r = %.17g", name, STATS_mean)
  stats data using (strcol("element") eq name ? column("z") : NaN) nooutput
  eval sprintf("%s_z = %.17g", name, STATS_mean)
}
a = semi_axes_r
b = semi_axes_z
geodetic   = atan2(ground_z, ground_r - foot_r)
parametric = atan2(circle_z, circle_r)
geocentric = atan2(satellite_z, satellite_r)
r_on(name) = strcol("element") eq name ? column("r_xy") : NaN
first_quadrant(r) = r >= 0 && column("z") >= 0 ? r : NaN

right = 1.36 * a                          # end of the axis r_xy; the key stands to the right of it
top   = (satellite_z > a ? satellite_z : a) + 0.22 * a
set size ratio -1
set xrange [-0.16*a : 2.06*a]
set yrange [-0.19*a : top]
unset border
unset tics
unset grid
set margins 1, 1, 1, 3
set title heading
set key at 1.13*a,top - 0.02*a left top Left reverse samplen 3.5 spacing 1.3

# Axes, both from the centre of the ellipse.
set arrow from -0.14*a,0 to right,0 linestyle 10 head filled size 0.03*a,18 front
set arrow from 0,-0.17*a to 0,top - 0.06*a linestyle 10 head filled size 0.03*a,18 front
set label italic("r_{xy}") at right,0 offset 0.6,0 left front textcolor rgb ink
set label italic("z") at 0,top - 0.06*a offset 0.8,0 left front textcolor rgb ink
set label italic("a") at a,0 offset 0.5,-0.8 left front textcolor rgb ink
set label italic("b") at 0,b offset -0.6,0.7 right front textcolor rgb ink

# Up from the ground point to the circle and from there to the centre: the parametric latitude.
set arrow from ground_r,0 to circle_r,circle_z nohead linestyle 11 front
set arrow from 0,0 to circle_r,circle_z nohead linestyle 3 linewidth 1.6 front
set arrow from 0,0 to satellite_r,satellite_z nohead linestyle 2 linewidth 2 front
set arrow from foot_r,foot_z to satellite_r,satellite_z nohead linestyle 1 linewidth 2 front
set arrow from ground_r,ground_z to normal_tip_r,normal_tip_z \
    linestyle 10 linewidth 3 head filled size 0.05*a,20 front

# The height is measured beside the normal, on its equatorial side; (u, v) is one step to that side.
u = 0.1 * a * sin(geodetic)
v = -0.1 * a * cos(geodetic)
set arrow from ground_r + u,ground_z + v to satellite_r + u,satellite_z + v \
    heads filled size 0.03*a,18 linestyle 10 front
set label italic("h") at 0.5*(ground_r + satellite_r) + 1.4*u,0.5*(ground_z + satellite_z) + 1.4*v \
    left front textcolor rgb ink
set label bold("n") at 0.35*ground_r + 0.65*normal_tip_r + 0.5*u,0.35*ground_z + 0.65*normal_tip_z + 0.5*v \
    center front textcolor rgb ink

set label bold("r") at satellite_r,satellite_z offset 0.9,0.5 left front textcolor rgb ink
set label bold("r_g") at ground_r,ground_z offset 0.7,-1.2 left front textcolor rgb ink
set label "φ_g" at foot_r + 0.19*a*cos(0.45*geodetic),0.19*a*sin(0.45*geodetic) center front textcolor rgb ink
set label "φ_c" at 0.36*a*cos(1.2*parametric),0.36*a*sin(1.2*parametric) center front textcolor rgb ink
set label "φ_0" at 0.26*a*cos(0.45*geocentric),0.26*a*sin(0.45*geocentric) center front textcolor rgb ink
set label sprintf("drawn with b/a = %.2g;\nthe Earth's is 0.99665", b/a) \
    at 1.13*a,-0.09*a left front textcolor rgb soft_ink

plot data using (first_quadrant(r_on("ellipse"))):(column("z")) with filledcurves xy=0,0 fillcolor rgb pale, \
     data using (r_on("auxiliary_circle")):(column("z")) with lines linestyle 11, \
     data using (r_on("ellipse")):(column("z")) with lines linestyle 10 linewidth 2, \
     data using (r_on("arc_geodetic")):(column("z")) with lines linestyle 1 linewidth 1.5, \
     data using (r_on("arc_parametric")):(column("z")) with lines linestyle 3 linewidth 1.5 dashtype solid, \
     data using (r_on("arc_geocentric")):(column("z")) with lines linestyle 2 linewidth 1.5 dashtype solid, \
     data using (r_on("ground")):(column("z")) with points pointtype 7 pointsize 0.8 linecolor rgb ink, \
     data using (r_on("circle")):(column("z")) with points pointtype 6 pointsize 0.8 linecolor rgb ink, \
     data using (r_on("satellite")):(column("z")) with points pointtype 7 pointsize 1.1 linecolor rgb ink, \
     keyentry with lines linestyle 1 title "normal of the ellipse: geodetic φ_g", \
     keyentry with lines linestyle 3 title "via the circle: parametric φ_c", \
     keyentry with lines linestyle 2 title "to the satellite: geocentric φ_0", \
     keyentry with lines linestyle 11 title "auxiliary circle of radius a"
