"""The scalar fixed-point homotopy for one unknown: (2.15) of Elgohary 2015 with a minus, Q = e^t, by Euler's rule."""
import math


def on_falling_branch(curve, load, start, maximum, minimum):
    """Does it come from the drop `start` to a root of W(d)/2 - load/2 between the limit points? `curve` gives W and dW/dd; steps of
    0.895 until |F| is 1e-6."""
    d, t = start, 0.0
    for _ in range(1000):
        total, slope = (float(v) for v in curve(d))
        f, b = (total - load) / 2, slope / 2
        if abs(f) <= 1e-6:
            return maximum < d < minimum and b < 0
        d -= 0.895 * f * f / 2 / (b * f - math.exp(-t) * (d - start))
        t += 0.895
    return False
