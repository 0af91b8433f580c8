"""Each picture of README and docs/chapters, docs/gallery/<chapter>-<scene>.svg, is what that scene draws today."""
import bisect
import math
import pathlib
import re
import shutil
import tempfile

import pytest

from nlmech_tree import SOURCE, program, run, text_of

PICTURES = sorted(file.stem for file in (SOURCE / "docs/gallery").iterdir())


def picture(file):
    """A picture without the line that says which program drew it."""
    return re.sub(r"^<!-- drawn from .*\n", "", text_of(file), flags=re.MULTILINE)


def labels(svg):
    """The texts of a picture in their order, without the numbers at ticks."""
    texts = [re.sub(r"<!\[CDATA\[|\]\]>|<[^>]*>", "", text) for text in re.findall("<text[^>]*>(.*)</text>", svg)]
    return [text for text in texts if re.search("[A-Za-z]", text)]


def places(svg):
    """Places that lines go through, in units of the picture, sorted."""
    return sorted({(float(x), float(y)) for x, y in re.findall(r"(-?\d+(?:\.\d+)?),(-?\d+(?:\.\d+)?)", svg)})


def strays(these, others, distance):
    """Those of these places that have none of the others within a distance along both axes."""
    def near(x, y):
        first, last = bisect.bisect_left(others, (x - distance, -math.inf)), bisect.bisect_right(others, (x + distance, math.inf))
        return any(abs(other - y) <= distance for _, other in others[first:last])

    return [place for place in these if not near(*place)]


@pytest.mark.parametrize("name", PICTURES)
def test_scene_draws_the_picture(name):
    """The same labels and, to 3 of some 700 units of length, lines through the same places, in whatever pieces: where gnuplot cuts a
    contour differs from machine to machine. Measured times decide even which methods a picture names: of such a picture, axes and
    captions of panels alone."""
    chapter, _, scene = name.partition("-")
    if not program(chapter).exists():
        pytest.skip(f"{chapter} is not built")
    folder = pathlib.Path(tempfile.mkdtemp(prefix=f"nlmech-{name}-"))  # not deleted after a failure, so that a differing picture can be viewed
    kept, drawn = SOURCE / f"docs/gallery/{name}.svg", folder / f"figures/{chapter}/{scene}.svg"
    advice = (f"{kept} differs from {drawn}.\nWhere you changed the scene: make gallery, and look at the picture. Where you did not, it "
              "depends on rounding: draw the median of perturbed runs, or remove it from docs/gallery.")
    run(program(chapter), "run", scene, "--out", folder, "--quick")
    if ",time_" in "," + text_of(folder / f"results/{chapter}/{scene}.csv").partition("\n")[0]:
        script = text_of(folder / f"results/{chapter}/{scene}.gp")
        stays = [label for line in re.findall("(?:set xlabel|captions =) '([^']+)'", script) for label in line.split("|")]
        assert stays
        assert [label for label in stays if labels(picture(kept)).count(label) != 1] == [], advice
    else:
        run(program(chapter), "run", scene, "--out", folder)
        now, then = picture(drawn), picture(kept)
        assert labels(now)
        assert labels(then) == labels(now), advice
        assert len(places(now)) > 20
        assert strays(places(then), places(now), 3) == [], f"places of docs/gallery that are not drawn now\n{advice}"
        assert strays(places(now), places(then), 3) == [], f"places drawn now that are not in docs/gallery\n{advice}"
    shutil.rmtree(folder)
