The example of the page on radial basis functions
=================================================

A damped pendulum after 10 s, against the Taylor series of mpmath. Twelve digits are printed; Radau IIA of order 21 in ten steps has no visible error:

  $ rbf_ivp_example | sed 's/success: x = \([^,]*\), v = \([^,]*\).*/x,v\n\1,\2/' > end.csv
  $ holds 'z := odefun(lambda t, z: [z[1], -sin(z[0]) - z[1]/10], 0, [1, 0])(10)' 'x = z[0] +- 2e-12' 'v = z[1] +- 2e-12' < end.csv
