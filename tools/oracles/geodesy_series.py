"""Truncation of the perturbation series of Elgohary 2015, section 2.4, without its coefficients.

With b and a point (r, z) fixed, the parametric latitude t and the height h of the point over the ellipse with a = b (1 + p) are analytic
functions of p, real and complex: (z - b sin t) b cos t = (r - a cos t) a sin t. Their Taylor coefficients at p = 0 come from values on a
circle round it; the sums of the first terms at the p of WGS 84 are compared with the place that the point was made from. Points stand at 200 km, where the errors are greatest."""
from mpmath import mp

from shared.rows import head, row

mp.dps = 40
A, F = mp.mpf(6378137), 1 / mp.mpf("298.257223563")
B = A * (1 - F)
P = A / B - 1
CIRCLE = [mp.mpf("0.08") * mp.expjpi(mp.mpf(2 * k) / 24) for k in range(24)]
DEGREE = mp.pi / 180


def foot(r, z, p, t):
    """Newton's iteration for t from a guess; and the height."""
    a = B * (1 + p)
    for _ in range(60):
        c, s = mp.cos(t), mp.sin(t)
        f = (z - B * s) * B * c - (r - a * c) * a * s
        slope = -B * B * c * c - (z - B * s) * B * s - a * a * s * s - (r - a * c) * a * c
        step = f / slope
        t -= step
        if abs(step) < mp.mpf(10) ** -36:
            break
    c, s = mp.cos(t), mp.sin(t)
    d = mp.sqrt((B * c) ** 2 + (a * s) ** 2)
    return t, ((r - a * c) * B * c + (z - B * s) * a * s) / d


def errors(latitude, height, orders):
    """Of latitude in degrees and height in metres, for each order."""
    lat = mp.mpf(latitude) * DEGREE
    n = A / mp.sqrt(1 - F * (2 - F) * mp.sin(lat) ** 2)
    r, z = (n + height) * mp.cos(lat), (n * (1 - F) ** 2 + height) * mp.sin(lat)
    start = mp.atan2(z, r)
    values, t = [], start
    for p in CIRCLE[:13]:  # the others are conjugates
        t, h = foot(r, z, p, t)
        values.append((t, h))
    found = []
    t, h = start, mp.sqrt(r * r + z * z) - B
    for k in range(1, max(orders) + 1):
        turn = [mp.expjpi(-mp.mpf(2 * k * i) / 24) for i in range(13)]
        share = (P / mp.mpf("0.08")) ** k / 24
        weight = [1 if i in (0, 12) else 2 for i in range(13)]
        t += share * sum(w * mp.re(v[0] * e) for w, v, e in zip(weight, values, turn))
        h += share * sum(w * mp.re(v[1] * e) for w, v, e in zip(weight, values, turn))
        if k in orders:
            found.append((abs(mp.atan2(A * mp.sin(t), B * mp.cos(t)) - lat) / DEGREE, abs(h - height)))
    return found


def printed():
    """C6 with -110 for -10 and C3 with 4 for 1, C8 with 431 for 421 and without its last term: differences of h_4, phi_3 and phi_4."""
    height = latitude = literal = mp.mpf(0)
    for kilometres in range(200, 35001, 100):
        h = mp.mpf(kilometres) * 1000
        for degrees in range(20, 71):
            radius, w, s = B + h, mp.cos(degrees * DEGREE) ** 2, mp.sin(2 * degrees * DEGREE)
            height = max(height, B * s * s / (32 * radius**3) * 4 * B * 100 * B * h * P**4)
            third = s / (6 * radius**3) * 9 * B * h * h * P**3
            fourth = s / (4 * radius**4) * (10 * B**3 * h + 2 * h**4) * w * w * P**4
            latitude = max(latitude, abs(third + fourth) / DEGREE)
            # C9: 135 b^3 h0^2 for 135 b^2 h0^2, b in metres.
            ninth = s / (4 * radius**4) * 135 * (B**3 - B**2) * h * h * w * P**4
            literal = max(literal, abs(third + fourth + ninth) / DEGREE)
    row("order 4 as printed: height", height, 4)
    row("order 4 as printed: latitude", latitude, 3)
    row("order 4 with C9 in metres: latitude", literal, 3)


def main():
    head()
    orders = [2, 3, 4, 5, 6]
    quarter = [errors(mp.mpf(i) / 4, 200000, orders) for i in range(361)]
    worst = lambda found, k, what: max(e[k][what] for e in found)
    for k, order in enumerate(orders):
        row(f"order {order}: latitude", worst(quarter, k, 0), 4 if order < 6 else 3)
        if order < 6:
            row(f"order {order}: height", worst(quarter, k, 1), 4)
    row("order 4: height at whole degrees", worst(quarter[::4], 2, 1), 4)
    for order in (4, 5):
        row(f"order {order}: latitude at whole degrees", worst(quarter[::4], order - 2, 0), 4)
    printed()


main()
