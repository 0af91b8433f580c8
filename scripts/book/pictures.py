"""A description of a picture in words, for readers who do not see it, from the SVG that gnuplot wrote: its title, then the
axes, their ranges and the names of the curves."""
import html
import re

LABEL = re.compile(r'<g transform="translate\(([\d.-]+),([\d.-]+)\)( rotate\([\d.-]+\))?"[^>]*?font-size="([\d.]+)"\s+'
                   r'text-anchor="(\w+)">\s*<text>(.*?)</text>', re.DOTALL)
RAISED = re.compile(r'<tspan[^>]*font-size="([\d.]+)" dy="-[\d.]+px"\s*>([^<]*)</tspan>')  # or back from a subscript, in full size
NUMBER = re.compile(r"[−+-]?[\d.,]+(?:\^[−-]?[\d.]+)?(?:e[−+-]?\d+)?|[−-]?∞")
SIZE = re.compile(r'<svg[^>]*?width="(\d+)" height="(\d+)"', re.DOTALL)
LEAST_WORDS = 8
MOST_NAMES = 12


class Label:
    """A text of the picture and its position."""

    def __init__(self, x, y, turned, size, anchor, markup):
        self.x, self.y, self.turned, self.anchor = float(x), float(y), bool(turned), anchor
        self.bold = 'font-weight="bold"' in markup and float(size) >= 15
        words = RAISED.sub(lambda up: ("^" if float(up[1]) < 0.95 * float(size) else "") + up[2], markup)
        words = re.sub(r"<!\[CDATA\[|\]\]>|<[^>]*>|[​‌]", "", words)
        self.text = " ".join(html.unescape(words).split())
        self.number = bool(NUMBER.fullmatch(self.text))


def labels_of(svg):
    return [label for label in (Label(*found) for found in LABEL.findall(svg)) if label.text]


def size_of(svg):
    """Width and height in pixels, as texts; None for a picture that does not say."""
    match = SIZE.search(svg)
    return match and match.groups()


def span(numbers):
    """The first and the last number at an axis."""
    return f", {numbers[0]} to {numbers[-1]}" if len(numbers) > 1 else ""


def unique(texts):
    return list(dict.fromkeys(texts))


def listed(names):
    """Names separated by commas; a long list is cut and ends with their number."""
    more = len(names) - MOST_NAMES
    return "; ".join(names[:MOST_NAMES]) + (f"; and {more} more" if more > 0 else "")


def described(svg):
    """What the picture shows."""
    labels = labels_of(svg)
    heading = " ".join(label.text for label in labels if label.bold)
    rest = [label for label in labels if not label.bold]
    upright = unique(label.text for label in rest if label.turned)
    ticks_y = [label.text for label in rest if label.number and label.anchor == "end"]
    below = [label for label in rest if label.number and label.anchor == "middle" and not label.turned]
    foot = max((label.y for label in below), default=None)
    across = unique(label.text for label in rest if foot is not None and not label.number and not label.turned
                    and label.anchor == "middle" and label.y > foot)
    ticks_x = [label.text for label in below if label.y == foot]
    names = unique(label.text for label in rest if not label.number and not label.turned and label.text not in across
                   and re.search(r"\w", label.text))
    parts = [f"{heading}." if heading else ""]
    if upright or across:
        one = len(upright) < 2 and len(across) < 2
        parts.append(f"Vertical axis: {listed(upright)}{span(ticks_y) if one else ''}." if upright else "")
        parts.append(f"Horizontal axis: {listed(across)}{span(ticks_x) if one else ''}." if across else "")
        parts.append(f"Shown: {listed(names)}." if names else "")
    elif names:
        parts.append(f"Drawn, with the labels: {listed(names)}.")
    return " ".join(part for part in parts if part)


def alternative(svg, given, caption):
    """The alternative text of the picture: the given one, else its description. Empty if that is too short or equals
    the caption."""
    text = given or described(svg)
    return text if len(text.split()) >= LEAST_WORDS and text.strip(". ") != caption.strip(". ") else ""
