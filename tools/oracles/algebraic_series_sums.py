"""Truncated series of Filipich and Rosales, section 2.5 and 3: fifth roots by the binomial series of their factors, Bessel functions by their
derivatives."""
from mpmath import mp

from shared.rows import head, row

mp.dps = 60


def fifth_root():
    """1 + 0.3 t + 0.2 t^2 = (1 - t/a)(1 - t/b), so its root is a product of two binomial series."""
    a, b = mp.polyroots([mp.mpf("0.2"), mp.mpf("0.3"), 1], maxsteps=200, extraprec=200)
    power = lambda root: [mp.binomial(mp.mpf(1) / 5, k) * (-1 / root) ** k for k in range(60)]
    p, q = power(a), power(b)
    total = sum(p[i] * q[k - i] for k in range(60) for i in range(k + 1))
    return abs(total - mp.mpf("1.5") ** (mp.mpf(1) / 5))


def bessel(nu, length, tau, terms):
    """Error of so many terms of J_nu(T tau) about tau = 1. Coefficients are a Fourier transform of values on a circle."""
    radius, n = mp.mpf(1) / 2, 256
    points = [radius * mp.expjpi(mp.mpf(2 * k) / n) for k in range(n)]
    values = [mp.besselj(nu, length * (1 + z)) for z in points]
    total = mp.mpf(0)
    for i in range(terms):
        c = sum(v * mp.expjpi(-mp.mpf(2 * k * i) / n) for k, v in enumerate(values)) / n / radius**i
        total += mp.re(c) * (mp.mpf(tau) - 1) ** i
    return abs(total - mp.besselj(nu, length * mp.mpf(tau)))


def main():
    head()
    row("fifth root of 1 + 0.3 t + 0.2 t^2: error of 60 terms", fifth_root(), 1)
    # Partial sums of a binomial series at t = 1 are binomials: sum of (-1)^k C(p, k) for k < n is (-1)^(n-1) C(p - 1, n - 1).
    row("fifth root of 1 - t: error of 3000 terms", abs(mp.binomial(-mp.mpf(4) / 5, 2999)), 3)
    row("J_2 with T = 5: error of 20 terms at 0.9", bessel(2, 5, "0.9", 20), 1)
    row("J_2 with T = 5: error of 20 terms at 0.01", bessel(2, 5, "0.01", 20), 1)
    row("J_0 with T = 10: error of 20 terms at 0.01", bessel(0, 10, "0.01", 20), 2)


main()
