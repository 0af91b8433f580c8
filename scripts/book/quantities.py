"""Numbers of results/<chapter>/<scene>.json as text for a page."""
import decimal
import json
import math
import re

from book import Complaint

THIN_SPACE = "\u202f"  # narrow and unbreakable
PURE = ("", "1", "-", "count")  # units that are not shown


def grouped(whole, tex):
    """Groups of three from the right, for whole numbers of five figures and more."""
    return whole if len(whole) < 5 else f"{int(whole):,}".replace(",", r"\," if tex else THIN_SPACE)


def formatted(number, digits=None, tex=False):
    """A Decimal in so many significant digits (1 to 17), half away from zero; three without a wish for digits. A whole number (5 or
    5.0) is shown without decimals, and without a wish in full."""
    minus = "" if number >= 0 else "-" if tex else "&minus;"
    number = number.copy_abs()
    if number == 0:
        return "0"
    if number < 10**(digits or 17) and number == int(number):
        return minus + grouped(str(int(number)), tex)
    digits = digits or 3
    number = decimal.Context(prec=digits, rounding=decimal.ROUND_HALF_UP).plus(number)
    exponent = number.adjusted()  # of the first digit; after the rounding, which may make 10.0 of 9.99
    if -4 < exponent < 6:
        whole, point, fraction = f"{number:.{max(digits - 1 - exponent, 0)}f}".partition(".")
        return minus + grouped(whole, tex) + point + fraction
    mantissa = f"{number.scaleb(-exponent):.{digits - 1}f}"
    if tex:
        return rf"{minus}{mantissa} \times 10^{{{exponent}}}"
    return f"{minus}{mantissa}&nbsp;&times;&nbsp;10<sup>{exponent}</sup>".replace("<sup>-", "<sup>&minus;")


def unit_text(unit, tex):
    """" deg", " m/s<sup>2</sup>"; nothing for pure numbers."""
    if unit in PURE:
        return ""
    if tex:
        return r"\,\mathrm{" + re.sub(r"\^(-?[0-9]+)", r"^{\1}", unit) + "}"
    return "&nbsp;" + re.sub(r"\^(-?[0-9]+)", r"<sup>\1</sup>", unit).replace(" ", "&nbsp;")


def load(book, scene):
    """The file of a scene's quantities, as a page would name it, and what it lists."""
    name, file, command = f"results/{scene}.json", book.out / f"results/{scene}.json", scene.replace("/", " run ", 1)
    if scene == "ratios":  # measured only on an idle machine, therefore tracked with the sources
        name, file, command = "tables/ratios.json", book.source / "tables/ratios.json", "make bench"
    if scene not in book.scenes:
        if not file.exists():
            raise Complaint(f"there is no {name}; `{command}` writes it")
        try:
            book.scenes[scene] = json.loads(book.text(file))["quantities"]
        except (ValueError, LookupError, TypeError) as error:
            raise Complaint(f"{name} has no list of quantities ({error!r})") from None
    return name, book.scenes[scene]


def read_options(options):
    """Options of a mark, "5 | no unit": number of digits, and whether the unit is shown."""
    digits, with_unit = None, True
    for option in options.split("|") if options else []:
        option = option.strip()
        if re.fullmatch("[0-9]+", option) and 0 < int(option) < 18:
            digits = int(option)
        elif option == "no unit":
            with_unit = False
        else:
            raise Complaint(f"'{option}' is neither a number of digits (1 to 17) nor 'no unit'")
    return digits, with_unit


def quantity_text(book, scene, name, options, tex):
    """The quantity with its unit."""
    digits, with_unit = read_options(options)
    file, quantities = load(book, scene)
    found = [quantity for quantity in quantities if quantity["name"] == name]
    if not found:
        known = ", ".join(f"'{quantity['name']}'" for quantity in quantities)
        raise Complaint(f"{file} has no quantity '{name}'; it has {known}")
    if len(found) > 1:
        raise Complaint(f"{file} has several quantities '{name}'")
    value = found[0].get("value")
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise Complaint(f"'{name}' of {file} has no value ({json.dumps(value)})")
    if value == "" or isinstance(value, float) and not math.isfinite(value):
        raise Complaint(f"'{name}' of {file} is {value!r}, which is no number and no text")
    text = value if isinstance(value, str) else formatted(decimal.Decimal(value), digits, tex)  # a text: "not stated"
    return text + (unit_text(found[0].get("unit") or "", tex) if with_unit else "")
