The first peak of Laier's oscillators
=====================================

  $ hermitian peak --problem laier-duffing --method laier --step 0.2
  t,peak
  2.4505*,0.53826455* (glob)

With steps of 0.001 a method of order 4 leaves rounding of the motion's peak; at an extremum its time has half of the digits:

  $ peak() { hermitian peak --problem "$@"; }
# oracle: transversal_motions Laier's *
  $ for method in laier argyris; do
  >   peak laier-duffing --method $method --step 0.001 |
  >     holds 't = 2.4505135743840013 +- 1e-9' 'peak = 0.53826530480163 +- 2e-14'
  >   peak laier-van-der-pol --method $method --step 0.001 |
  >     holds 't = 4.60362115304892 +- 1e-9' 'peak = -0.31932967523380 +- 2e-14'
  > done

With longer steps it is that of the difference equations:

# oracle: hermitian_peaks Duffing Laier h = 0.2, Duffing Argyris h = 0.05, Duffing Newmark h = 0.1, van der Pol Newmark h = 0.2
  $ peak laier-duffing --method laier --step 0.2 | holds 't = 2.4505 +- 1e-4' 'peak = 0.538264556 +- 1e-9'
  $ peak laier-duffing --method argyris --step 0.05 | holds 't = 2.4505 +- 1e-4' 'peak = 0.538265305 +- 1e-9'
  $ for method in newmark hoff bazzi; do
  >   peak laier-duffing --method $method --step 0.1 | holds 't = 2.4525 +- 1e-4' 'peak = 0.538046 +- 5e-7'
  > done
  $ peak laier-van-der-pol --method newmark --step 0.2 | holds 't = 4.5895 +- 1e-4' 'peak = -0.312725 +- 5e-7'

Mistakes:

  $ refused hermitian peak --problem laier-duffing --method laier --step 0
  hermitian: --step 0: must be positive
  $ refused hermitian peak --problem laier-duffing --method laier --step x
  hermitian: --step x: not a finite number
  $ refused hermitian peak --problem laier-duffing --method laire --step 0.1
  hermitian: --method laire: must be one of laier, argyris, newmark, hoff, bazzi
  $ refused hermitian peak --problem lorenz --method laier --step 0.1
  hermitian: --problem lorenz: must be one of laier-duffing, laier-van-der-pol
  $ refused hermitian peak --problem laier-duffing --step 0.1
  --method is required
  Run with --help for more information.
