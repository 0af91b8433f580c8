# What each step from the dissertation's algorithm to the adaptive integrator saves: time a run at nine digits.
#
#   gnuplot -e "data='results/rbf_ivp/ladder.csv'; width=720; height=360" \
#       figures/style.gp figures/templates/rbf_ivp-ladder.gp > out.svg
#
# Variables: data (required), heading (title; optional).
# Data: CSV with the header problem,rung,time_s,time_low_s,time_high_s,error; problem 1 the free oscillator, 2 the three
# masses; rungs 1 to 5, 6 for comparison.

if (!exists("heading")) heading = "Time a run"
set title bold(heading)
set logscale x
set format x power_of_ten
set xlabel "median run time at nine digits (s); the Gaussians have fewer"
set yrange [6.6:0.4]
set ytics ("Gaussians, 35 LGL nodes" 1, "polynomials, same nodes" 2, "left end, 16 Radau nodes" 3, \
           "sweeps, step control" 4, "adaptive-collocation" 5, "beside: odeint-dopri5" 6)
set lmargin 27
set key at graph 0.02, graph 0.99 left top Left reverse samplen 2
set arrow from graph 0, first 5.5 to graph 1, first 5.5 nohead linestyle 11
plot for [p = 1:2] data using (int(column("problem")) == p && int(column("rung")) < 6 ? column("time_s") : NaN):"rung" \
       with linespoints linecolor rgb (p == 1 ? "#D55E00" : "#0072B2") linewidth 2 pointtype (p == 1 ? 7 : 5) \
       title (p == 1 ? "free oscillator, 500 s" : "three masses, 200 s"), \
     for [p = 1:2] data using (int(column("problem")) == p && int(column("rung")) == 6 ? column("time_s") : NaN):"rung" \
       with points linecolor rgb (p == 1 ? "#D55E00" : "#0072B2") pointtype (p == 1 ? 7 : 5) notitle
