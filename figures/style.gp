# The look of every figure: loaded before each template (gnuplot 5.4).
#
#   gnuplot -e "data='results/geodesy/fig-2.22.csv'" \
#       figures/style.gp figures/templates/geodesy-fig-2.22.gp > out.svg
#
# Variables that may be set before it is loaded:
#   width, height   size of the picture in pixels; 760 x 520 without them
#   png             if it exists, the picture is a PNG at twice the size instead of an SVG (by pngcairo)
#
# Nothing here depends on the machine, the locale or the time: the same data give the same bytes. In the C
# locale gnuplot 5.4 warns of a degree sign that iconv cannot convert: on standard error, without effect.

if (!exists("width"))  width = 760
if (!exists("height")) height = 520

# The generic family, which every browser has. In sub- and superscripts gnuplot would drop the end of a list of families.
font_family = "sans-serif"
font_size = 14

if (exists("png")) {
  if (strstrt(" " . GPVAL_TERMINALS . " ", " pngcairo ") == 0) {
    print "style.gp: this gnuplot has no pngcairo terminal: leave out the variable png and convert the SVG"
    exit status 2
  }
  set terminal pngcairo size 2*width,2*height font sprintf("%s,%d", font_family, font_size) fontscale 1.5 \
      linewidth 2 pointscale 2 enhanced butt background "#ffffff" dashlength 1
} else {
  # The name replaces gnuplot's own in <title>, which browsers show as a tooltip.
  set terminal svg size width,height fixed font sprintf("%s,%d", font_family, font_size) enhanced butt \
      background "#ffffff" dashlength 1 name "nlmech"
}

set encoding utf8
set minussign                       # a true minus sign in the numbers at the tics
set decimalsign "."

# Data: CSV with one header line. An empty cell is a value that does not exist: the line goes on past it. A
# cell "nan" is a value that could not be computed: the line breaks there.
set datafile separator ","
set datafile columnheaders
set datafile missing ""

# Colours: Okabe & Ito's eight, with a grey in place of their yellow, which is too faint on white.
# Their order puts colours of unlike lightness next to each other, and each has its own dashes and its own
# point, so that a curve can be told from the others without colour.
ink      = "#222222"                # text, axes, outlines of drawings
grid_ink = "#dcdcdc"                # grid
soft_ink = "#707070"                # construction lines, notes
pale     = "#e4eef6"                # filled areas of drawings
colours  = "#0072B2 #E69F00 #000000 #009E73 #D55E00 #56B4E9 #CC79A7 #7F7F7F"
points   = "7 4 9 12 5 10 13 2"
colour(n) = word(colours, n)
set dashtype 1 solid
set dashtype 2 (14,6)
set dashtype 3 (4,4)
set dashtype 4 (14,5,3,5)
set dashtype 5 (24,6)
set dashtype 6 (8,4)
set dashtype 7 (14,4,3,4,3,4)
set dashtype 8 (2,6)
point(n) = int(word(points, n))
do for [n = 1:8] {
  set style line n linecolor rgb colour(n) linewidth 2 dashtype n pointtype point(n) pointsize 0.75
  set linetype n linecolor rgb colour(n) linewidth 2 dashtype n pointtype point(n) pointsize 0.75
}
set linetype cycle 8
set style line 10 linecolor rgb ink linewidth 1.2 dashtype solid             # outlines
set style line 11 linecolor rgb soft_ink linewidth 1 dashtype 6              # construction lines
set style line 12 linecolor rgb grid_ink linewidth 0.8 dashtype solid        # grid, graticule
set style line 13 linecolor rgb soft_ink linewidth 1 dashtype solid          # thin reference lines

# Frame. One line for left and bottom; a heat map or a drawing sets its own border.
set border 3 linecolor rgb ink linewidth 1
set tics out nomirror scale 0.7,0.4 textcolor rgb ink
set xlabel textcolor rgb ink
set ylabel textcolor rgb ink
set grid linestyle 12
set title font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink offset 0,0.2
set key inside top right Left reverse noautotitle opaque fillcolor "#ffffff"
set key samplen 4 spacing 1.25 textcolor rgb ink
set style data lines
set style fill solid 1.0 noborder

# Numbers. Axes on a log scale take `set format y power_of_ten`.
set format "%g"
power_of_ten = "10^{%T}"
bold(text)   = "{/:Bold " . text . "}"
italic(text) = "{/:Italic " . text . "}"

# Lists in a text. entry("a|b|c", 2) is "b", entries("a|b|c") is 3, field("x@y", 1) is "x".
part(list, separator, i) = i > 1 ? part(list[strstrt(list, separator) + 1:*], separator, i - 1) \
    : (strstrt(list, separator) > 0 ? list[1:strstrt(list, separator) - 1] : list)
entry(list, i) = part(list, "|", i)
field(text, i) = part(text, "@", i)
entries(list) = 1 + (strstrt(list, "|") > 0 ? entries(list[strstrt(list, "|") + 1:*]) : 0)

# Heat maps: viridis, twelve samples. Its lightness rises steadily, so it stays ordered in grey.
set palette model RGB defined ( \
    0 "#440154",  1 "#482173",  2 "#433E85",  3 "#38598C",  4 "#2D708E",  5 "#25858E", \
    6 "#1E9B8A",  7 "#2BB07F",  8 "#51C56A",  9 "#85D54A", 10 "#C2DF23", 11 "#FDE725")
