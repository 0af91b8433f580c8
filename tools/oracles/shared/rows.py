"""What the programs share: a row of their output, `name,value,digits`."""
import mpmath


def head():
    print("name,value,digits")


def row(name, value, digits):
    """A named value; `digits` of its decimals are significant, and all of them are meant."""
    with mpmath.mp.workdps(60):
        text = str(value) if isinstance(value, int) else mpmath.nstr(mpmath.mpf(str(value)), digits, strip_zeros=False)
    print(f"{name},{text},{digits}")

