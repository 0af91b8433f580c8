# How many printed errors each reading of the text explains.
#
#   gnuplot -e "data='results/rbf_ivp/readings.csv'; questions='11'" \
#       figures/style.gp figures/templates/rbf_ivp-readings.gp > out.svg
#
# Variables: data and questions (their number), heading (title; optional).
#
# Data: CSV with the header `question,name,share,offset,kind,option`: questions numbered from 1 and named, the share of the
# printed rows that an option explains, how far to move its point up so that options of one share stand side by side, and
# `chosen`, `literal` (what the text says) or `tried`.

if (!exists("heading")) heading = "Printed errors explained by each reading"

set title heading offset 0,1.6
set xrange [-0.03:1.03]
set yrange [real(questions) + 0.6:0.4]
set xtics 0.2
set format x "%.1f"
set xlabel "share of the rows explained to all printed digits"
set ytics scale 0
set margins screen 0.40, screen 0.97, screen 0.13, screen 0.84
set key at screen 0.685, screen 0.91 center top horizontal maxrows 1 Left reverse samplen 1

of(kind) = strcol("kind") eq kind ? column("share") : NaN
plot data using (of("tried")):(column("question") + column("offset")) \
       with points pointtype 6 pointsize 0.55 linecolor rgb soft_ink title "tried", \
     data using (of("literal")):(column("question") + column("offset")) \
       with points pointtype 4 pointsize 1.3 linewidth 2 linecolor rgb colour(5) title "as printed", \
     data using (of("chosen")):(column("question") + column("offset")) \
       with points pointtype 7 pointsize 1.3 linecolor rgb colour(1) title "chosen", \
     data using (NaN):"question":ytic(stringcolumn("name")) notitle
