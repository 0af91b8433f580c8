The cheapest force on a Duffing oscillator
==========================================

test_boundary_values.py compares all cases at all final times with extremals in 40 digits.

  $ duffing() { rbf_inverse duffing "$@"; }

Without a target in the cost there is no force:

  $ duffing --case free --final-time 2 --weights 0,0 > idle.csv
  $ head -1 idle.csv
  cost,x1_0,x2_0,lambda1_0,lambda2_0,x1_T,x2_T,miss
  $ holds 'cost <= 1e-18' < idle.csv

A linear oscillator, beta = 0 from a fixed x(0) = 0, costs c^T W^-1 c/2 with the controllability Gramian W of cos and sin:

  $ duffing --case fixed --final-time 2 --beta 0 | holds 'a := 1 - sin(4)/4' 'b := sin(2)^2/2' 'c := 1 + sin(4)/4' \
  >   'J := (25*c - 20*b + 4*a)/(a*c - b*b)/2' 'cost = J +- 1e-9*J'

|f| <= 15 costs more than no bound, 122.0837680864659; recorded: 122.3004593 with its own smoothing:

  $ duffing --case fixed --final-time 2 --bound 15 | holds 'cost = 122.3004593 +- 1e-4' 'miss <= 1e-6'

The linear oscillator in another unit: forces and co-states 1e-4 times as large, the cost 1e-8 times. What may differ is what the smoothing of the bound
makes, 1e-5 of it; 1e-4 would be a third of the small bound:

  $ duffing --case fixed --final-time 2 --beta 0 --target 3,0 --bound 3 > large.csv
  $ duffing --case fixed --final-time 2 --beta 0 --target 3e-4,0 --bound 3e-4 | paste -d, large.csv - |
  >   sed '1s/.*/cost,x,v,l,m,X,V,miss,COST,x,v,L,M,X,V,MISS/' | holds 'COST*1e8 = cost +- 1e-6*cost' 'M*1e4 = m +- 1e-4*abs(m)'
  $ duffing --case fixed --final-time 1 --bound 3
  rbf_inverse: infeasible: tighten: no extremal is found at * of the path to the bounds (*); the bounds admit none near the last one, or none at all; loosen them or start from another extremal (glob)
  [1]

The example of the page moves a cart by 1 in a second with f = 6 - 12 t, J = 6:

  $ rbf_inverse_example | grep -o 'cost 6.000000000, first force 6.000000000'
  cost 6.000000000, first force 6.000000000

Mistakes
--------

  $ wrong() { refused rbf_inverse duffing "$@"; }
  $ wrong --final-time 2
  --case is required
  Run with --help for more information.
  $ wrong --case free
  --final-time is required
  Run with --help for more information.
  $ wrong --case wrong --final-time 2
  rbf_inverse: --case wrong: must be one of free, fixed, x1x1, x1x2, x2x1, x2x2, final-only, harmonic
  $ wrong --case free --final-time 0
  rbf_inverse: --final-time 0: must be from 1e-06 to 1000
  $ wrong --case free --final-time -1
  rbf_inverse: --final-time -1: must be from 1e-06 to 1000
  $ wrong --case free --final-time nan
  rbf_inverse: --final-time nan: not a finite number
  $ free() { refused rbf_inverse duffing --case free --final-time 2 "$@"; }
  $ free --beta x
  rbf_inverse: --beta x: not a finite number
  $ free --beta -1
  rbf_inverse: --beta -1: must be from 0 to 1e+06
  $ free --target 5
  rbf_inverse: --target 5: needs two finite numbers, separated by a comma
  $ free --target 5,inf
  rbf_inverse: --target 5,inf: 'inf' is not a finite number
  $ wrong --case harmonic --final-time 2 --target 5,2
  rbf_inverse: --target 5,2: --case harmonic takes its target from Eq. 5.34; leave it out
  $ free --weights 1,-1
  rbf_inverse: --weights 1,-1: must not be negative
  $ free --weights '1;1'
  rbf_inverse: --weights 1;1: '1;1' is not a finite number
  $ free --bound 0
  rbf_inverse: --bound 0: must be positive
  $ free --bound many
  rbf_inverse: --bound many: not a finite number

Where the end is prescribed there is no miss to weight:

  $ for case in fixed harmonic final-only; do wrong --case $case --final-time 2 --weights 1,1; done
  rbf_inverse: --weights 1,1: --case fixed prescribes both states at the end, so there is no miss to weight; leave it out
  rbf_inverse: --weights 1,1: --case harmonic prescribes both states at the end, so there is no miss to weight; leave it out
  rbf_inverse: --weights 1,1: --case final-only prescribes both states at the end, so there is no miss to weight; leave it out
