# Cartesian and geodetic coordinates of a satellite (Elgohary 2015, Fig. 2.21).
#
#   gnuplot -e "data='results/geodesy/fig-2.21.csv'" \
#       figures/style.gp figures/templates/geodesy-fig-2.21.gp > out.svg
#
# Variables: data (required), heading (title; optional), azimuth and elevation of the eye (optional, deg).
#
# Data: CSV with the header `element,x,y,z`, lengths in any one unit. Rows of one element stand together; the
# order of the elements is free.
#   one row:
#     semi_axes        a, a, b: the semi-axes along x, y, z; 0 < b < a; b/a = 0.8 or so, for the eye
#     satellite        (x_s, y_s, z_s), the Cartesian coordinates of (lambda_g, phi_g, h)
#     ground           its sub-point g on the ellipsoid: the same with h = 0
#     foot             where the normal through g meets the plane of the equator
#     below            (x_s, y_s, 0)
#     normal_tip       g + s n, the end of the arrow for the outward normal n; s shorter than h, about 0.3 a
#     east_tip         g + s tau, tau = (-sin lambda_g, cos lambda_g, 0), the same s
#   a curve, rows in order along it, 1 degree or less from row to row:
#     equator          the whole circle, longitude 0..360
#     meridian         the satellite's meridian, latitude -90..90
#     zero_meridian    longitude 0, latitude -90..90
#     arc_longitude    in the plane of the equator about the centre, 0..lambda_g, radius about 0.45 a
#     arc_latitude     in the plane of the meridian about `foot`, 0..phi_g, radius about 0.3 a
#   many curves, a blank line after each:
#     graticule        meridians and parallels, every 30 degrees, 2 degrees or less from row to row
# The drawing reads best at b/a = 0.8, lambda_g = 65 degrees, phi_g = 42 degrees, h = 0.75 a.

if (!exists("heading")) heading = \
    "Longitude λ_g, latitude φ_g, height h of a satellite: h lies on the normal n"
if (!exists("azimuth"))   azimuth = 28
if (!exists("elevation")) elevation = 20

# Each one-row element becomes three variables: ground_x, ground_y, ground_z. One pass over the data writes them down.
alone = " semi_axes satellite ground foot below normal_tip east_tip "
values = ""
noted(name, x, y, z) = strstrt(alone, " " . name . " ") == 0 ? 0 : strlen(values = values \
    . sprintf("%s_x = %.17g; %s_y = %.17g; %s_z = %.17g; ", name, x, name, y, name, z))
stats data using (noted(strcol("element"), column("x"), column("y"), column("z"))) nooutput
eval values
a = semi_axes_x
b = semi_axes_z

# Orthographic projection on the plane across the line of sight: across to the right, up, and towards the eye.
ca = cos(azimuth * pi/180)
sa = sin(azimuth * pi/180)
ce = cos(elevation * pi/180)
se = sin(elevation * pi/180)
across(x, y, z) = -sa*x + ca*y
up(x, y, z)     = -se*(ca*x + sa*y) + ce*z
# The ellipsoid hides its own far side: there the outward normal points away from the eye.
near(x, y, z)   = ce*(ca*x + sa*y)/a**2 + se*z/b**2 >= 0
across_of(name) = strcol("element") eq name ? across(column("x"), column("y"), column("z")) : NaN
near_of(name)   = near(column("x"), column("y"), column("z")) ? across_of(name) : NaN
up_of(name)     = strcol("element") eq name ? up(column("x"), column("y"), column("z")) : NaN
# Outline: the points whose normal is square to the line of sight, an ellipse with these half-axes.
outline_up = sqrt((a*se)**2 + (b*ce)**2)

set size ratio -1
set xrange [-1.5*a : 1.9*a]
set yrange [-1.0*a : 1.38*a]
unset border
unset tics
unset grid
unset key
set margins 1, 1, 0.5, 2.5
set title heading

# Straight lines from f to t. Axes are dashed inside the ellipsoid, solid outside.
line(i, fx, fy, fz, tx, ty, tz, look) = sprintf("set arrow %d from %.9g,%.9g to %.9g,%.9g %s front", \
    i, across(fx, fy, fz), up(fx, fy, fz), across(tx, ty, tz), up(tx, ty, tz), look)
inside = "nohead linestyle 11"
axis = "linestyle 10 head filled size " . sprintf("%.9g", 0.05*a) . ",18"
eval line(1, 0, 0, 0, a, 0, 0, inside)
eval line(2, 0, 0, 0, 0, a, 0, inside)
eval line(3, 0, 0, 0, 0, 0, b, inside)
eval line(4, a, 0, 0, 1.75*a, 0, 0, axis)
eval line(5, 0, a, 0, 0, 1.75*a, 0, axis)
eval line(6, 0, 0, b, 0, 0, 1.36*a, axis)

# The normal: dashes from the plane of the equator up to g, then the height. Below the satellite its
# coordinates.
eval line(10, foot_x, foot_y, foot_z, ground_x, ground_y, ground_z, "nohead linestyle 1 dashtype 6")
eval line(11, ground_x, ground_y, ground_z, satellite_x, satellite_y, satellite_z, "nohead linestyle 1")
eval line(12, satellite_x, satellite_y, satellite_z, below_x, below_y, below_z, inside)
eval line(13, 0, 0, 0, below_x, below_y, below_z, inside)
eval line(14, below_x, below_y, 0, below_x, 0, 0, inside)
eval line(15, below_x, below_y, 0, 0, below_y, 0, inside)
thick = "linestyle 10 linewidth 3 head filled size " . sprintf("%.9g", 0.07*a) . ",20"
eval line(16, ground_x, ground_y, ground_z, normal_tip_x, normal_tip_y, normal_tip_z, thick)
eval line(17, ground_x, ground_y, ground_z, east_tip_x, east_tip_y, east_tip_z, thick)

# Labels at exact points, moved by whole characters.
text(t, x, y, z, dx, dy) = sprintf("set label \"%s\" at %.9g,%.9g offset %g,%g center front", \
    t, across(x, y, z), up(x, y, z), dx, dy) . " textcolor rgb ink"
lambda = atan2(ground_y, ground_x)
eval text(italic("x"), 1.75*a, 0, 0, -1.2, -0.3)
eval text(italic("y"), 0, 1.75*a, 0, 1.2, -0.2)
eval text(italic("z"), 0, 0, 1.36*a, 1.2, 0)
eval text("(x_s, y_s, z_s)", satellite_x, satellite_y, satellite_z, 5.2, 0.4)
eval text("(x_s, y_s, 0)", below_x, below_y, below_z, 4.6, -0.6)
eval text(bold("g"), ground_x, ground_y, ground_z, -1.3, -0.2)
eval text(bold("n"), normal_tip_x, normal_tip_y, normal_tip_z, -1.2, 0.2)
eval text(bold("τ"), east_tip_x, east_tip_y, east_tip_z, 1.1, -0.1)
eval text(italic("h"), 0.3*ground_x + 0.7*satellite_x, 0.3*ground_y + 0.7*satellite_y, \
    0.3*ground_z + 0.7*satellite_z, 1.2, -0.3)
eval text("λ_g", 0.57*a*cos(0.5*lambda), 0.57*a*sin(0.5*lambda), 0, 0, 0)
tilt = atan2(ground_z, sqrt((ground_x - foot_x)**2 + (ground_y - foot_y)**2))
eval text("φ_g", foot_x + 0.42*a*cos(0.5*tilt)*cos(lambda), \
    foot_y + 0.42*a*cos(0.5*tilt)*sin(lambda), 0.42*a*sin(0.5*tilt), 0, 0)
set label sprintf("drawn with b/a = %.2g;\nthe Earth's is 0.99665", b/a) \
    at graph 0.99,0.07 right front textcolor rgb soft_ink

plot sample [t = 0:2*pi] "+" using (a*cos(t)):(outline_up*sin(t)) \
         with filledcurves closed fillcolor rgb pale, \
     data using (near_of("graticule")):(up_of("graticule")) with lines linestyle 12 linecolor rgb "#b8c6d2", \
     data using (across_of("equator")):(up_of("equator")) with lines linestyle 11, \
     data using (near_of("equator")):(up_of("equator")) with lines linestyle 10, \
     data using (near_of("zero_meridian")):(up_of("zero_meridian")) with lines linestyle 10, \
     data using (near_of("meridian")):(up_of("meridian")) with lines linestyle 10 linewidth 1.8, \
     [t = 0:2*pi] "+" using (a*cos(t)):(outline_up*sin(t)) with lines linestyle 10, \
     data using (across_of("arc_longitude")):(up_of("arc_longitude")) with lines linestyle 5 dashtype solid, \
     data using (across_of("arc_latitude")):(up_of("arc_latitude")) with lines linestyle 1, \
     data using (across_of("ground")):(up_of("ground")) with points pointtype 7 linecolor rgb ink, \
     data using (across_of("satellite")):(up_of("satellite")) \
         with points pointtype 7 pointsize 1.1 linecolor rgb ink
