"""Public cases about orbits: Kepler's motion by universal variables, the time inverted by bisection; a day with J_2 by extrapolation of the
midpoint rule; states of elements with angles near 180 degrees."""
from decimal import Decimal as D

from mpmath import mp

from shared.extrapolation import Extrapolation, digits
from shared.rows import head, row

digits(30)
mp.dps = 80
EARTH_KM, EARTH, MOON_KM = mp.mpf("398600.4418"), mp.mpf("3.986004418e14"), mp.mpf("4902.8")


def double(text):
    """The double that a program reads: public inputs are typed in decimals, and beside the parabola their rounding counts."""
    return mp.mpf(float(text))


def vector(text):
    return mp.matrix([double(word) for word in text.split(",")])


def stumpff(psi):
    """c_0 to c_3, by series where they would cancel."""
    if abs(psi) < 1:
        return [mp.nsum(lambda k: (-psi) ** int(k) / mp.factorial(2 * int(k) + n), [0, 40]) for n in range(4)]
    x = mp.sqrt(abs(psi))
    c, s = (mp.cos(x), mp.sin(x)) if psi > 0 else (mp.cosh(x), mp.sinh(x))
    return [c, s / x, (1 - c) / psi, (x - s) / (psi * x)]


def kepler(position, velocity, time, mu):
    """Position and velocity after a time of either sign: t = r s c_1 + (r.v/sqrt mu) s^2 c_2 + s^3 c_3 grows with s."""
    r, alpha = mp.norm(position), 2 / mp.norm(position) - mp.fdot(velocity, velocity) / mu
    sigma, wanted = mp.fdot(position, velocity) / mp.sqrt(mu), mp.sqrt(mu) * abs(time)
    sign = -1 if time < 0 else 1

    def u(s):
        c = stumpff(alpha * s * s)
        return [c[n] * s**n for n in range(4)]

    def late(s):
        u_s = u(s)
        return r * u_s[1] + sign * sigma * u_s[2] + u_s[3] > wanted

    low, high = mp.mpf(0), mp.sqrt(r)
    while not late(high):
        high *= 2
    for _ in range(240):
        middle = (low + high) / 2
        low, high = (low, middle) if late(middle) else (middle, high)
    u0, u1, u2, u3 = u(low)
    u1, u3 = sign * u1, sign * u3
    end = (1 - u2 / r) * position + (time - u3 / mp.sqrt(mu)) * velocity
    distance = mp.norm(end)
    return end, -mp.sqrt(mu) / (r * distance) * u1 * position + (1 - u2 / distance) * velocity


MOTIONS = {
    "K2": ("8000,1000,0", "-0.5,-0.5,0", 3600, EARTH_KM),
    "K5": ("61445.76498656,24827.93010168,0", "-0.42581645,-0.18867869,0", 3600, MOON_KM),
    "K8": ("0,11681,0", "5.134,4.226,2.787", 1000, EARTH_KM),
    "K10": ("-500,1500,4012.09", "5021.38,-2900.7,1000.354", 150, EARTH_KM),
    "K11": ("1,-1,0", "-1,-1,0", 1, mp.mpf(1)),
    "W1a at 1e12": ("1,0,0", "0,1.4142135623730951,0", 10**12, mp.mpf(1)),
    "W5": ("7e6,0,0", "0,7500,0", 86400, EARTH),
    "A13": ("7e6,0,0", "0,7500,0", 5850000000, EARTH),
}


def motions():
    for name, (position, velocity, time, mu) in MOTIONS.items():
        end, _ = kepler(vector(position), vector(velocity), mp.mpf(time), mp.mpf(float(mu)))
        for axis, value in zip("xyz", end):
            if value:
                row(f"{name} {axis}", value, 16)


def distances():
    """Distances at true anomalies near 180 degrees, r = p/(1 + e cos nu)."""
    for name, p, e, nu in (("W2a", 2, "1", "179.999999"), ("W2a 5", 2, "1", "179.99999"), ("W2a 4", 2, "1", "179.9999"),
                           ("W2c", 1, "1", "179.99999999999")):
        row(f"{name} x", p / (1 + double(e) * mp.cos(mp.radians(double(nu)))) * mp.cos(mp.radians(double(nu))), 16)
    e = double("0.9999999999999999")
    row("W2b vy", -mp.sqrt((1 - e) / (1 + e)), 16)


def oblate(_, s):
    """J_2 = 1.08262668e-3 and R = 6378137 m about the Earth."""
    x, y, z, vx, vy, vz = s
    r2 = x * x + y * y + z * z
    pull, bulge, polar = -D("3.986004418e14") / (r2 * r2.sqrt()), D("1.62394002e-3") * D(6378137) ** 2 / r2, 5 * z * z / r2
    return [vx, vy, vz, pull * x * (1 + bulge * (1 - polar)), pull * y * (1 + bulge * (1 - polar)), pull * z * (1 + bulge * (3 - polar))]


def day():
    """Elements 8000 km, 0.015, 28.5, 100, 200, 45 degrees; the state rounded to micrometres."""
    start = "6788575.355678", "-2199297.918500", "-3422541.649608", "1550.905884010", "6807.005327308", "-1471.066911616"
    for axis, value in zip("xyz", Extrapolation(oblate, "1e-24", 12, "300").run(0, start, 86400)):
        row(f"Z2 {axis}", value, 16)


def main():
    head()
    day()
    motions()
    distances()


main()
