"""The spacecraft of Elgohary 2015, Table 3.1, with tips, under u = -k1 (theta - theta_f) - k3 theta' - k2 (root load): poles, peaks,
delays, costs of a turn by 1 rad and its history by residues."""
import cmath

from mpmath import mp

from shared.rows import head, row
from shared.spacecraft import PLAIN, AssumedModes, Craft, locked

mp.dps = 30
N = 61  # poles in the sums: the digits of the rows are those that 41 give too
UNIT, DESIGNED = (1, 1, 1), (12, 0, 16)


class Loop:
    """P(s) = s^2 (I_hub + (2 + k2) B) + k3 s + k1; theta/theta_f = k1/P; y = (y for theta = 1) theta."""

    def __init__(self, craft, gains):
        self.craft, (self.k1, self.k2, self.k3) = craft, gains

    def p(self, s, x=None):
        inertia, y, _ = self.craft.motion(s, x)
        return s * s * (self.craft.hub + (2 + self.k2) * inertia) + self.k3 * s + self.k1, y

    def delayed(self, s, tau):
        inertia, _, _ = self.craft.motion(s)
        law = self.k1 + self.k3 * s + self.k2 * s * s * inertia
        lag = cmath.exp(-s * tau) if self.craft.math is PLAIN else mp.exp(-s * tau)
        return s * s * (self.craft.hub + 2 * inertia) + lag * law

    def sensitivity(self, omega):
        s = 1j * omega
        inertia, _, _ = self.craft.motion(s)
        return abs(s * s * (self.craft.hub + 2 * inertia) / self.p(s)[0])


def root(f, start, share):
    """Newton's iteration with a difference for the derivative."""
    s = start
    for _ in range(60):
        h = s * share
        step = f(s) * h * 2 / (f(s + h) - f(s - h))
        s -= step
        if abs(step) <= abs(s) * share * share / 100:
            break
    return s


def rigid(craft, gains):
    """The pole of the undeformed craft."""
    k1, _, k3 = gains
    inertia = craft.hub + (2 + gains[1]) * (mp.quad(lambda x: craft.rho * (craft.radius + x) ** 2, [0, craft.length]) +
                                            craft.mass * (craft.radius + craft.length) ** 2 + craft.inertia)
    return (-k3 + mp.sqrt(mp.mpc(k3 * k3 - 4 * inertia * k1))) / (2 * inertia)


def poles(craft, gains, count):
    """The rigid one and those beside the zeros of I_hub + (2 + k2) B."""
    _, free = locked(craft, count, 2 + gains[1])

    def whole(s):  # without the poles of B, which lie near
        inertia, _, determinant = craft.motion(s)
        return (s * s * (craft.hub + (2 + gains[1]) * inertia) + gains[2] * s + gains[0]) * determinant

    starts = [rigid(craft, gains)] + [mp.mpc(-w * mp.mpf("1e-6"), w) for w in free[:count - 1]]
    return [root(whole, s, mp.mpf(10) ** -12) for s in starts]


# ---------------------------------------------------------------------------------- delays and sensitivity, in doubles

def followed(gains, starts, delays):
    """Poles with a positive real part under each delay; each is followed in small steps of the delay."""
    loop, counts = Loop(Craft(math=PLAIN), [float(k) for k in gains]), []
    for delay in delays:
        ends = []
        for s in starts:
            steps = 40
            for k in range(1, steps + 1):
                tau = delay * (k / steps)
                s = root(lambda z: loop.delayed(z, tau), s, 1e-6)
            ends.append(s)
        counts.append(sum(s.real > 0 for s in ends))
    return counts


def largest(f, low, high, steps=4000):
    """A maximum: a grid, then golden sections."""
    grid = [low + (high - low) * k / steps for k in range(steps + 1)]
    at = max(range(1, steps), key=lambda k: f(grid[k]))
    a, b, g = grid[at - 1], grid[at + 1], (5**0.5 - 1) / 2
    for _ in range(60):
        c, d = b - g * (b - a), a + g * (b - a)
        if f(c) > f(d):
            b = d
        else:
            a = c
    return (a + b) / 2, f((a + b) / 2)


def peak_near(loop, pole):
    w, width = pole.imag, max(8 * abs(pole.real), 1e-4 * abs(pole))
    return largest(loop.sensitivity, max(w - width, 0.05 * w), w + width)


def robustness(unit_poles, designed_poles, optimum, optimal_poles):
    plain = Craft(math=PLAIN)
    unit, designed = Loop(plain, UNIT), Loop(plain, DESIGNED)
    row("unit unstable of nine at 10 us", followed(UNIT, unit_poles[:9], [1e-5])[0], 1)
    for name, count in zip(("1 ms", "10 ms"), followed(DESIGNED, designed_poles[:9], [1e-3, 1e-2])):
        row(f"designed unstable of nine at {name}", count, 1)
    for name, count in zip(("1 us", "10 us", "100 us"), followed(optimum, optimal_poles[:10], [1e-6, 1e-5, 1e-4])):
        row(f"optimum unstable of ten at {name}", count, 1)
    for i in [*range(6), 19]:
        omega, value = peak_near(unit, unit_poles[i])
        row(f"unit sensitivity {i + 1}", value, (3, 3, 4, 4, 3, 4)[i] if i < 6 else 3)
    row("unit sensitivity 20 at", omega, 4)
    row("designed sensitivity", peak_near(designed, designed_poles[0])[1], 4)
    for name, loop in (("unit", unit), ("designed", designed)):
        omega, value = largest(lambda w: abs(loop.k1 / loop.p(1j * w)[0]), 0.02, 4)
        row(f"{name} resonance", value, 7)
        row(f"{name} resonance in dB", 20 * mp.log10(value), 4 if name == "unit" else 2)
        row(f"{name} resonance at", omega, 4)

        def flexible(w):
            p, y = loop.p(1j * w, 2)
            return abs(loop.k1 * y / p)

        row(f"{name} flexible peak", largest(flexible, 51.5, 53)[1], 3)


# ----------------------------------------------------------------------------------------------------- costs

def cost(inertias, gains, weight, price):
    """int e^2 + W int y(L)^2 + R int u^2 for a turn of 1 rad. By residues of the quotients of P(s) P(-s), with P(s) - P(-s) = 2 k3 s:
    k3/(2 k1) + (I_hub + kappa B0)/(2 k3); C k1^2/(k3 kappa); k1^2 (I_hub + 4 B0/kappa)/(2 k3), kappa = 2 + k2."""
    hub, b0, c = inertias
    k1, k2, k3 = gains
    kappa = 2 + k2
    return (k3 / (2 * k1) + (hub + kappa * b0) / (2 * k3) + weight * c * k1**2 / (k3 * kappa) +
            price * k1**2 * (hub + 4 * b0 / kappa) / (2 * k3))


def least(f, start):
    """The least value of a sum of products of powers, which is convex in the logarithms: Newton's iteration for a vanishing gradient in
    these, by differences in 60 digits. Returns the arguments."""
    with mp.workdps(60):
        n, h = len(start), mp.mpf(10) ** -15
        x = [mp.log(v) for v in start]

        def shifted(*moves):
            z = list(x)
            for i, d in moves:
                z[i] += d
            return mp.log(f([mp.exp(v) for v in z]))

        for _ in range(40):
            g = mp.matrix([(shifted((i, h)) - shifted((i, -h))) / (2 * h) for i in range(n)])
            m = mp.matrix(n)
            for i in range(n):
                for j in range(n):
                    m[i, j] = (shifted((i, h), (j, h)) - shifted((i, h), (j, -h)) - shifted((i, -h), (j, h)) +
                               shifted((i, -h), (j, -h))) / (4 * h * h)
            step = mp.lu_solve(m, g)
            x = [a - b / max(1, mp.norm(step)) for a, b in zip(x, step)]
            if mp.norm(step) < mp.mpf(10) ** -20:
                break
        return [mp.exp(v) for v in x]


def static_load(craft):
    """C(L) as in gss_control_plant: half of the mass integral of the cantilever's static deflection by a unit load at its end."""
    length, ei = craft.length, craft.stiffness
    bent = mp.quad(lambda x: (x * x * (3 * length - x) / (6 * ei)) ** 2, [0, length])
    return (craft.rho * bent + craft.mass * (length**3 / (3 * ei)) ** 2 + craft.inertia * (length**2 / (2 * ei)) ** 2) / 2


def optima(craft):
    arm = lambda x: craft.rho * (craft.radius + x) ** 2
    b0 = mp.quad(arm, [0, craft.length]) + craft.mass * (craft.radius + craft.length) ** 2 + craft.inertia
    inertias, price, at_hundred = (craft.hub, b0, static_load(craft)), mp.mpf(1) / 144, None
    for weight in (0, 100, 1000):
        k1, kappa, k3 = least(lambda k: cost(inertias, [k[0], k[1] - 2, k[2]], weight, price), [5, 2, 20])
        full = [k1, kappa - 2, k3]
        k1, k3 = least(lambda k: cost(inertias, [k[0], 0, k[1]], weight, price), [5, 20])
        pd = [k1, 0, k3]
        for name, gains in (("optimum", full), ("PD optimum", pd)):
            for k in ((0, 1, 2) if name == "optimum" else (0, 2)):
                value = gains[k] if abs(gains[k]) > 1e-15 else 0
                row(f"{name} k{k + 1} at W = {weight}", int(value) if value == 0 else value, 12)
            row(f"{name} cost at W = {weight}", cost(inertias, gains, weight, price), 12)
        row(f"designed cost at W = {weight}", cost(inertias, DESIGNED, weight, price), 10)
        row(f"unit cost at W = {weight}", cost(inertias, UNIT, weight, price), 10)
        at_hundred = full if weight == 100 else at_hundred
    return at_hundred


# ----------------------------------------------------------------------------------------------------- histories

class History:
    """theta(t) = 1 + 2 Re sum of residues of k1/(s P(s)) e^(st), its rate, and y(place) with its rate."""

    def __init__(self, loop, all_poles, place=2):
        self.terms = []
        for s in all_poles:
            h = s * mp.mpf(10) ** -12
            slope = (loop.p(s + h)[0] - loop.p(s - h)[0]) / (2 * h)
            _, y, _ = loop.craft.motion(s, place)
            a = loop.k1 / (s * slope)
            self.terms.append((complex(s), complex(2 * a), complex(2 * a * y)))

    def theta(self, t, order=0):
        return (order == 0) + sum((s**order * a * cmath.exp(s * t)).real for s, a, _ in self.terms)

    def y(self, t, order=0):
        return sum((s**order * b * cmath.exp(s * t)).real for s, _, b in self.terms)


def turning(f, low, high):
    """Where f' = f(., 1) vanishes, by bisection."""
    a, b, rising = low, high, f(low, 1) > 0
    for _ in range(60):
        c = (a + b) / 2
        a, b = (c, b) if (f(c, 1) > 0) == rising else (a, c)
    return (a + b) / 2


def extreme(name, f, low, high, sign, digits, time_digits=None):
    """The largest value of sign f between two times, to `digits`."""
    n = 4000
    step = (high - low) / n
    at = max(range(1, n), key=lambda k: sign * f(low + k * step))
    t = turning(f, low + (at - 1) * step, low + (at + 1) * step)
    row(name, f(t), digits)
    if time_digits:
        row(f"{name} at", t, time_digits)
    return f(t)


def settled(f, target, band, end, step):
    """The last time at which |f - target| = band, from `end` backwards in steps that no peak hides between."""
    t = end
    while abs(f(t) - target) <= band:
        t -= step
    low, high = t, t + step
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if abs(f(middle) - target) > band else (low, middle)
    return high


def histories(craft, unit_poles, designed_poles):
    d = History(Loop(craft, DESIGNED), designed_poles)
    rate = lambda t, order=0: d.theta(t, order + 1)
    bend = lambda t, order=0: d.y(t, order + 1)
    extreme("designed largest angle", d.theta, 3, 6, 1, 10, 5)
    row("designed angle settles", settled(d.theta, 1, 0.02, 20, 0.01), 5)
    extreme("designed largest rate", rate, 0.8, 1.6, 1, 7, 5)
    lowest = extreme("designed least deflection", d.y, 0.2, 0.8, -1, 7, 4)
    extreme("designed largest deflection", d.y, 1, 3, 1, 6, 5)
    row("designed deflection settles", settled(d.y, 0, -0.02 * lowest, 30, 0.005), 3)
    top = extreme("designed largest deflection rate", bend, 0.3, 1.2, 1, 4)
    extreme("designed least deflection rate", bend, 0.1, 0.5, -1, 4)
    row("designed deflection rate settles to 2 %", settled(bend, 0, 0.02 * top, 95, 2e-4), 3)
    row("designed deflection rate settles to 5 %", settled(bend, 0, 0.05 * top, 50, 2e-4), 3)
    few = History(Loop(craft, DESIGNED), designed_poles[:25])
    row("25 pairs theta at 4.508", few.theta(4.508), 10)
    row("25 pairs y at 0.4315", few.y(0.4315), 10)
    row("25 pairs rate of y at 0.69", few.y(0.69, 1), 10)
    row("25 pairs rate of y at 0.264", few.y(0.264, 1), 10)
    u = History(Loop(craft, UNIT), unit_poles)
    speed = lambda t, order=0: u.theta(t, order + 1)
    extreme("unit largest angle", u.theta, 10, 20, 1, 10, 3)
    row("unit angle settles", settled(u.theta, 1, 0.02, 300, 0.01), 5)
    extreme("unit largest rate", speed, 2, 12, 1, 7)
    extreme("unit least rate", speed, 15, 30, -1, 7)
    extreme("unit least deflection", u.y, 0, 4, -1, 6)
    extreme("unit largest deflection", u.y, 0, 30, 1, 6)


class ModalHistory(History):
    """The same of ten assumed modes: 1 + (k1 + k3 s) theta/u = 0 at the poles. k2 = 0."""

    def __init__(self, craft, gains, starts, place):
        model = AssumedModes(craft, 10)
        k1, _, k3 = gains
        modes = [(m[0], model.deflection(i, mp.mpf(place)), square) for i, (m, square) in enumerate(zip(model.modes, model.squares))]
        hub = lambda s: sum(a * a / (s * s + square) for a, _, square in modes)
        whole = lambda s: (1 + (k1 + k3 * s) * hub(s)) * mp.fprod(s * s + square for _, _, square in modes) / s ** (2 * len(modes))
        found = [root(whole, s, mp.mpf(10) ** -12) for s in starts[:2]]
        found += [root(whole, mp.mpc(-w * mp.mpf("1e-4"), w), mp.mpf(10) ** -12) for w in map(mp.sqrt, model.squares[2:])]
        self.terms = []
        for s in found:
            h = s * mp.mpf(10) ** -12
            slope = ((k1 + k3 * (s + h)) * hub(s + h) - (k1 + k3 * (s - h)) * hub(s - h)) / (2 * h)
            y = sum(a * b / (s * s + square) for a, b, square in modes)
            self.terms.append((complex(s), complex(2 * k1 * hub(s) / (s * slope)), complex(2 * k1 * y / (s * slope))))


def ten_modes(craft, designed_poles):
    """Greatest differences to the exact history at 4001 times to 40 s."""
    exact = {x: History(Loop(craft, DESIGNED), designed_poles, x) for x in (2, 4)}
    modal = {x: ModalHistory(craft, DESIGNED, designed_poles, x) for x in (2, 4)}
    times = [k / 100 for k in range(4001)]
    worst = lambda f: max(map(abs, map(f, times)))
    row("ten modes theta", worst(lambda t: modal[2].theta(t) - exact[2].theta(t)), 2)
    row("ten modes rate of theta", worst(lambda t: modal[2].theta(t, 1) - exact[2].theta(t, 1)), 2)
    row("ten modes y2", worst(lambda t: modal[2].y(t) - exact[2].y(t)), 2)
    row("ten modes rate of y2", worst(lambda t: modal[2].y(t, 1) - exact[2].y(t, 1)), 3)
    row("ten modes y4", worst(lambda t: modal[4].y(t) - exact[4].y(t)), 2)


def main():
    head()
    craft = Craft()
    of_unit, of_designed = poles(craft, UNIT, N), poles(craft, DESIGNED, N)
    for name, all_poles in (("unit", of_unit), ("designed", of_designed)):
        for i in range(8):
            row(f"{name} pole {i + 1} re", all_poles[i].real, 9 if name == "unit" and i > 4 else 12)
            row(f"{name} pole {i + 1} im", all_poles[i].imag, 12)
    optimum = optima(craft)
    plain = lambda some: [complex(s) for s in some]
    robustness(plain(of_unit), plain(of_designed), optimum, plain(poles(craft, optimum, 10)))
    ten_modes(craft, of_designed)
    histories(craft, of_unit, of_designed)


main()
