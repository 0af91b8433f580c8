# Outcome of each solver (row) under each load (column).
#
#   gnuplot -e "data='results/homotopy/solvers.csv'; solvers='20'; width='900'; height='700'" \
#       figures/style.gp figures/templates/homotopy-solvers.gp > out.svg
#
# Variables: data and solvers (their number), heading (optional).
#
# Data: CSV with the header `solver,row,column,end,iterations`: rows and columns numbered from 1; end is `equilibrium`,
# `at limit point` (no root, close to the limit point, where |F| has a minimum) or `elsewhere`.

if (!exists("heading")) heading = "Every solver on every load"

set label 1 heading at screen 0.5, screen 0.965 center font sprintf("%s:Bold,%d", font_family, font_size + 1) textcolor rgb ink
set margins screen 0.20, screen 0.985, screen 0.02, screen 0.80
set xrange [0.6:8.7]
set yrange [real(solvers) + 0.7:0.4]
set border 0
set ytics scale 0
set x2range [0.6:8.7]
unset xtics
unset grid
set x2tics scale 0 ("1 el.\n0.44 in\n43.79 lb" 1, "1 el.\n0.44 in\n44 lb" 2, "4 el.\n0.32 in\n27.11 lb" 3, \
                    "4 el.\n0.44 in\n43.79 lb" 4, "4 el.\n0.44 in\n44 lb" 5, "4 el.\n0.44 in\n(1–10^{–9}){/:Italic W_L}" 6, \
                    "4 el.\n0.44 in\n(1+10^{–9}){/:Italic W_L}" 7, "4 el.\n0.44 in\n60 lb" 8)
unset key
array kind[3] = ["equilibrium, with iterations", "no equilibrium, at the limit point", "no equilibrium, elsewhere"]
array place[3] = [0.12, 0.40, 0.74]
array shape[3] = [7, 6, 2]
array ink_of[3] = [colour(1), colour(2), soft_ink]
do for [k = 1:3] {
  set label 1 + k kind[k] at screen place[k], screen 0.925 left offset 1,0 textcolor rgb ink \
      point pointtype shape[k] pointsize (k == 3 ? 0.9 : 1.3) linewidth 2 linecolor rgb ink_of[k]
}

of(end) = strcol("end") eq end ? column("column") : NaN
count(end) = strcol("end") eq end ? stringcolumn("iterations") : ""
plot data using (of("equilibrium")):"row" with points pointtype 7 pointsize 1.3 linecolor rgb colour(1), \
     data using (of("at limit point")):"row" with points pointtype 6 pointsize 1.3 linewidth 2 linecolor rgb colour(2), \
     data using (of("elsewhere")):"row" with points pointtype 2 pointsize 0.9 linewidth 1.5 linecolor rgb soft_ink, \
     data using (of("equilibrium") + 0.17):"row":(count("equilibrium")) with labels left textcolor rgb ink notitle, \
     data using (NaN):"row":ytic(stringcolumn("solver")) notitle
