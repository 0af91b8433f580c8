"""Open loop of the spacecraft of Elgohary 2015, Table 3.1: frequencies, responses, static integrals, errors of assumed modes."""
from mpmath import mp

from shared.rows import head, row
from shared.spacecraft import AssumedModes, Craft, deflection_zeros, locked

mp.dps = 40


def responses(craft, name):
    for omega in ("0.1", "1", "10", "100", "1000"):
        s = mp.mpc(0, omega)
        values = {x: craft.motion(s, x) for x in (2, 4)}
        theta = 1 / (s * s * (craft.hub + 2 * values[2][0]))
        row(f"{name} theta at {omega}", mp.re(theta), 15)
        for x in (2, 4):
            row(f"{name} y{x} at {omega}", mp.re(values[x][1] * theta), 15)


def assumed(craft, count):
    """Frequencies by assumed modes, without the rigid one."""
    return [mp.sqrt(v) for v in AssumedModes(craft, count).squares[1:]]


def statics(craft, x):
    """C(x): half of the mass integral of G(x, xi)^2, G the static deflection of a cantilever by a unit load."""
    def green(a, b):
        a, b = min(a, b), max(a, b)
        return a * a * (3 * b - a) / (6 * craft.stiffness)

    length = craft.length
    slope = mp.mpf(x) ** 2 / (2 * craft.stiffness)
    beam = mp.quad(lambda xi: green(mp.mpf(x), xi) ** 2, [0, x, length] if x < length else [0, length])
    return (craft.rho * beam + craft.mass * green(mp.mpf(x), length) ** 2 + craft.inertia * slope**2) / 2


def main():
    head()
    for tip, name in ((False, "bare"), (True, "tip")):
        craft = Craft(tip)
        zeros, poles = locked(craft, 10)
        for i in range(10):
            row(f"{name} pole {i + 1}", poles[i], 13)
            row(f"{name} locked {i + 1}", zeros[i], 13)
        responses(craft, name)
        for i, value in enumerate(assumed(craft, 10)):
            row(f"{name} error of assumed mode {i + 1}", value / poles[i] - 1, 2)
    for x in (2, 4):
        row(f"tip first zero of y{x}", deflection_zeros(craft, x, 60)[0], 13)
        row(f"statics {x}", statics(craft, x), 15)


main()
