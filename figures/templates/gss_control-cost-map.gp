# The cost over two gains, the third at its best: chapter gss_control, scene optimal-gains.
#
#   gnuplot -e "data='results/gss_control/optimal-gains.csv'; optimum='4.8,32'; pd='0,13'" \
#       figures/style.gp figures/templates/gss_control-cost-map.gp > out.svg
#
# Variables: data, optimum and pd ("k2,k3", required); heading.
#
# Data: CSV with the header `k2,k3,excess`, a blank line after each k2.

if (!exists("heading")) heading = ""
set title heading
set xlabel "{/:Italic k}_2"
set ylabel "{/:Italic k}_3\U+200B (ft lb s/rad)" offset 0.5,0
set xrange [-2.01:15.11]
set yrange [3.58:70.42]
set border 15
unset grid
set lmargin at screen 0.11
set rmargin at screen 0.82
set palette model RGB defined (0 "#f7fbff", 1 "#6baed6", 2 "#08306b")
set logscale cb
set cbrange [0.01:3]
set cbtics ("1 %%" 0.01, "3 %%" 0.03, "10 %%" 0.1, "30 %%" 0.3, "100 %%" 1, "300 %%" 3)
set cblabel "cost above the optimum" offset 1.5,0
before(s) = real(s[1:strstrt(s, ",") - 1])
after(s) = real(s[strstrt(s, ",") + 1:*])
set label "optimum" at before(optimum) + 0.4, after(optimum) + 1.5 front textcolor rgb ink
set label "PD" at before(pd) + 0.4, after(pd) + 1.5 front textcolor rgb ink
set label "designed" at 0.4, 17.8 front textcolor rgb ink
plot data using "k2":"k3":(column("excess") < 0.01 ? 0.01 : column("excess")) with image, \
     "+" using (before(optimum)):(after(optimum)) every ::0::0 with points pointtype 7 pointsize 1 linecolor rgb ink, \
     "+" using (before(pd)):(after(pd)) every ::0::0 with points pointtype 5 pointsize 1 linecolor rgb ink, \
     "+" using (0):(16) every ::0::0 with points pointtype 9 pointsize 1.2 linecolor rgb ink
