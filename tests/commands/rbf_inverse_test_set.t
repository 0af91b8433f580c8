Mazzia and Cash's test set, and transfers, as typed problems
===========================================================

  $ set=$TESTDIR/../../common/nlmech/problems/bvp
  $ problem() { rbf_inverse bvp --file $set/bvpT$1.ode "${@:2}" 2> said.txt; }

Closed forms, with the parameters of the files and with smaller ones. The tolerance is 1e-9, and the largest value is 1 or 2:

  $ problem 1 --every 0.1 | holds --each 'n = 11' 'y = sinh((1 - t)/sqrt(1e-3))/sinh(1/sqrt(1e-3)) +- 1e-8'
  $ problem 6 --set eps=1e-6 --every 0.125 | holds --each 'n = 17' 'y = cos(pi*t) + erf(t/sqrt(2e-6))/erf(1/sqrt(2e-6)) +- 1e-8'
  $ problem 8 --set eps=1e-6 --every 0.25 | holds --each 'n = 5' 'y = 2 - exp(-t*1e6) +- 1e-8'
  $ problem 15 --set eps=1e-6 --every 0.5 |
  >   holds --each 'a := airyai(-100)' 'b := airybi(-100)' 'c := airyai(100)' 'd := airybi(100)' 'n = 5' \
  >     'y = ((d - b)*airyai(100*t) + (a - c)*airybi(100*t))/(a*d - b*c) +- 1e-8'
  $ problem 20 --every 0.25 | holds --each 'n = 5' 'y = 1 + 0.01*log(cosh(100*(t - 0.745))) +- 1e-8'

A guess, and continuation in the parameter where Newton's iteration does not converge from zeros (values of multiple shooting in 24
digits, tools/bvp_test_set_references.py):

  $ problem 24 --guess 'y = 0.9129 - 0.5379 t' --every 0.1 | holds --where t=0.10000000000000001 'y = 0.99623688484060 +- 1e-8'
  $ problem 28 --from-parameter 'eps = 0.1 : 1e-3' --every 0.1 | holds --where t=0.10000000000000001 "y = 0.6 +- 1e-8"

Problem 35 multiplies errors by exp(1/(2 eps)), 5e21 at eps = 0.01, which rounding decides: it is refused.

  $ problem 35 --set eps=0.01
  [1]
