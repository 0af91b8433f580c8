Sections of Duffing's oscillator
================================

The first section is the initial state. After 31 sections the orbit is back on its island, which is 2.7e-4 by 4.7e-4 large
(chapters/algebraic_series/poincare.cpp):

  $ algebraic_series poincare --sections 1 --initial 0.25,0.5
  section,x,v
  0,0.25,0.5
  $ algebraic_series poincare --sections 32 > sections.csv
  $ wc -l < sections.csv
  33
  $ head -2 sections.csv
  section,x,v
  0,-0.5,0
  $ holds 'section = 31' 'x = -0.5 +- 3e-4' 'v = 0 +- 3e-4' < sections.csv

Mistakes:

  $ refused algebraic_series poincare
  --sections is required
  Run with --help for more information.
  $ refused algebraic_series poincare --sections 0
  algebraic_series: --sections 0: must be a whole number from 1 to 10000000
  $ refused algebraic_series poincare --sections 1.5
  algebraic_series: --sections 1.5: must be a whole number from 1 to 10000000
  $ refused algebraic_series poincare --sections 3 --initial 1
  algebraic_series: --initial 1: 1 numbers for the 2 components x,x' of oscillator: x'' = -stiffness x - epsilon (x' x^2 sin(2 t))

The example of the chapter's page: the energy v^2/2 - log(1 - x^2)/2 is that of its start (0.9, 0):

  $ algebraic_series_example | sed 's/success: x = \(.*\), v = \(.*\)/x,v\n\1,\2/' > end.csv
  $ holds 'v^2 - log(1 - x^2) = -log(1 - 0.81) +- 1e-10' < end.csv
