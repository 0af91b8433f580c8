# The four radial functions of Eq. 4.8 (left) and their derivatives (right).
#
#   gnuplot -e "data='results/rbf_ivp/kernels.csv'" \
#       figures/style.gp figures/templates/rbf_ivp-kernels.gp > out.svg
#
# Variables: data (required), heading (title; optional).
#
# Data: CSV with the header `kernel,distance,value,derivative`: distance c r, value phi, derivative phi'/c, for the
# kernels gaussian, inverse-quadratic, multiquadric, inverse-multiquadric.

if (!exists("heading")) heading = "The radial functions"

kernels = "gaussian inverse-quadratic multiquadric inverse-multiquadric"
array formula[4] = ["Gaussian exp(−{/:Italic c}^2{/:Italic r}^2)", "inverse quadratic 1/(1 + ​{/:Italic c}^2{/:Italic r}^2)", \
                    "multiquadric (1 + ​{/:Italic c}^2{/:Italic r}^2)^{1/2}", "inverse multiquadric (1 + ​{/:Italic c}^2{/:Italic r}^2)^{−1/2}"]
of(name) = strcol("kernel") eq name ? column("distance") : NaN

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set xrange [-4:4]
set xtics 2
set xlabel "{/:Italic c r}"

set margins screen 0.10, screen 0.49, screen 0.13, screen 0.76
set ylabel "φ" norotate offset 2,0
set yrange [0:4.2]
set ytics 1
set key at screen 0.52, screen 0.92 center top maxrows 2 Left reverse samplen 3 spacing 1.3 width -6
plot for [i = 1:4] data using (of(word(kernels, i))):"value" with lines linestyle i title formula[i]

set margins screen 0.58, screen 0.98, screen 0.13, screen 0.76
set ylabel "φ'/{/:Italic c}" norotate offset 2,0
set yrange [-1.1:1.1]
set ytics 0.5
unset key
plot for [i = 1:4] data using (of(word(kernels, i))):"derivative" with lines linestyle i
unset multiplot
