# Every method on stiff problems: the largest usable step, or the digits at a tolerance, or the failure.
#
#   gnuplot -e "data='results/rbf_ivp/stability.csv'; rows_fixed='13'; rows_adaptive='14'; height='620'" \
#       figures/style.gp figures/templates/rbf_ivp-stability.gp > out.svg
#
# Variables: data, rows_fixed, rows_adaptive (required: rows of the two panels), heading (title; optional).
#
# Data: CSV with the header `panel,row,column,colour,mark,method,problem`. panel is fixed (colour: log10 of step times
# rate) or adaptive (colour: digits); colour is empty where the method is of no use; mark stands in the cell.

if (!exists("heading")) heading = "Every method on stiff problems"

of(name) = strcol("panel") eq name ? column("column") : NaN
small = "sans-serif,11"
# White on the dark half of the palette.
shade(c, low, high) = c != c || (c - low) / (high - low) > 0.45 ? 0x222222 : 0xffffff

set multiplot title heading font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
unset key
unset grid
unset border
set tics scale 0
set xrange [0.5:7.5]
set xtics ("Duffing 10^6" 1, "masses 10^8" 2, "v. d. Pol 10" 3, "v. d. Pol 100" 4, "v. d. Pol 1000" 5, \
    "Robertson" 6, "HIRES" 7) font small rotate by 35 right offset 0.8,0
set label 1 "—  refused      ×  no root found      ∞  blows up      ↓  step underflow      …  step limit      0  no digit" \
    at screen 0.5, screen 0.025 center font small
unset ytics  # names are labels: tics taken from a column would stay from panel to panel
set colorbox horizontal user origin 0,0 size 0.1,0.02

do for [panel in "fixed adaptive"] {
  rows = real(panel eq "fixed" ? rows_fixed : rows_adaptive)
  left = panel eq "fixed" ? 0.165 : 0.675
  set margins screen left, screen left + 0.32, screen 0.27, screen 0.87
  set yrange [rows + 0.5 : 0.5]
  set title (panel eq "fixed" ? "fixed step: largest usable step × rate" : "tolerance 10^{−6}: digits") \
      font sprintf("%s,%d", font_family, font_size) offset 0,0
  low = panel eq "fixed" ? -2 : 0
  high = panel eq "fixed" ? 4 : 8
  if (panel eq "fixed") { set cbrange [-2:4]; set cbtics 2; set format cb "10^{%.0f}" } else { set cbrange [0:8]; set cbtics 2; set format cb "%.0f" }
  set colorbox horizontal user origin screen left,screen 0.115 size screen 0.32,screen 0.02
  plot data using (of(panel)):"row":(0.5):(0.5):"colour" with boxxyerror fillcolor palette fillstyle solid, \
       data using (of(panel)):"row":5:(shade(column("colour"), low, high)) with labels font small textcolor rgb variable, \
       data using (column("column") == 1 && of(panel) > 0 ? 0.5 : NaN):"row":6 with labels right offset -1,0 font small
}
unset multiplot
