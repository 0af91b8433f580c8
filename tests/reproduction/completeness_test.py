"""What stands behind each figure and table of the sources."""
import pytest
from conftest import CHECKED, PLACES, PUBLISHED

import completeness
from lists import Refused

CURVE = '<svg><g id="nlmech_plot_1a" ><path d=\'M0,0 L1,1\'/></g></svg>'
PASSING = '{"quantities": [{"name": "a", "passes": true}]}'


@pytest.fixture
def shown(folder):
    """Of one figure and one table of a chapter that is built, one figure of a chapter that is not; all complete."""
    for name, text in (("tables/places.csv", f"{PLACES}roy,fig-1,moon,figure,craters,\nroy,table-1,moon,table,tides,\n"
                        "roy,claim-1,moon,claim,none of these,\nlaier,fig-9,sun,figure,spots,\n"),
                       ("tables/published/roy.csv", f"{PUBLISHED}table-1,r,q,1,1,value,,,context,,,,,,\n"),
                       ("results/moon/check.csv", f"{CHECKED}roy/table-1/r/q,,,context,1,\n"),
                       ("results/moon/fig-1.csv", "x,y\n0,0\n\n1,1\n"), ("results/moon/fig-1.json", PASSING),
                       ("figures/moon/fig-1.svg", CURVE), ("tables/moon/table-1.csv", "x\n1\n"), ("results/moon/table-1.json", PASSING)):
        folder.put(name, text)
    return lambda: completeness.collect(folder.places(), folder.values("moon"), folder.path, ["moon"])


def test_counts_what_is_there(shown):
    figure, table, foreign = shown()  # a claim is neither
    assert (figure.numbers, figure.checked, figure.passed, table.published, foreign.built) == (2, 1, 1, 1, False)
    assert [s.lacks() for s in shown()] == ["", "", ""]
    page = completeness.page(shown(), [])
    for line in ("| roy | 1 | 1 | 2 | 0 |", "| [fig-1](../docs/chapters/moon.md#fig-1) | moon | craters | 2 | 1 | 0 | complete |",
                 "| [table-1](../docs/chapters/moon.md#table-1) |", "| fig-9 | sun | spots | 0 | 0 | 0 | not built |"):
        assert line in page


def test_of_a_figure_that_several_scenes_show(folder, shown):
    """A paper that repeats figures of another source: all of the scenes that show one have to be there."""
    folder.put("tables/places.csv", f"{PLACES}roy,table-1,moon,table,tides,\npaper,fig-7,moon,figure,craters again,fig-1 fig-2\n")
    assert shown()[1].lacks() == "nothing is drawn"
    folder.put("results/moon/fig-2.csv", "x,y\n0,0\n")
    folder.put("results/moon/fig-2.json", PASSING)
    folder.put("figures/moon/fig-2.svg", CURVE)
    figure = shown()[1]
    assert (figure.lacks(), figure.numbers, figure.checked) == ("", 3, 2)
    assert ("| fig-7: [fig-1](../docs/chapters/moon.md#fig-1), [fig-2](../docs/chapters/moon.md#fig-2) | moon |"
            in completeness.page(shown(), []))


@pytest.mark.parametrize("file, text, lacks", [
    ("figures/moon/fig-1.svg", '<svg><g id="nlmech_plot_1a" ></g></svg>', "nothing is drawn"),  # axes without a curve
    ("figures/moon/fig-1.svg", "<svg></svg>", "nothing is drawn"),
    ("results/moon/fig-1.json", '{"quantities": [{"passes": true}, {"passes": false}]}', "a check fails"),
    ("results/moon/fig-1.json", '{"quantities": []}', "nothing is checked"),
    ("results/moon/fig-1.csv", "x,y\n", "nothing is drawn")])
def test_sees_what_is_missing(folder, shown, file, text, lacks):
    folder.put(file, text)
    assert shown()[0].lacks() == lacks
    assert "| INCOMPLETE |" in completeness.page(shown(), [])


def test_refuses_a_broken_record(folder, shown):
    file = folder.put("results/moon/fig-1.json", "{")
    with pytest.raises(Refused, match=f"{file}: is not JSON"):
        shown()


@pytest.mark.parametrize("row, wanted", [
    ("roy,5,more,moon,fig-1,done,", None), ("roy,5,more,sun,fig-9,done,", None), ("roy,5,more,moon,,not done,no craters", None),
    ("roy,5,more,moon,fig-1,later,", "'later' is no state"), ("roy,5,more,moon,fig-7,done,", "no scene 'fig-7' of moon"),
    ("roy,5,more,moon,,not done,", "a reason for all that is not done, and for nothing else"),
    ("roy,5,more,moon,,done,", "done, and no scene")])
def test_future_work_has_a_scene_or_a_reason(folder, shown, row, wanted):
    file = folder.put("tables/future_work.csv", f"{','.join(completeness.FUTURE_HEADER)}\n{row}\n")
    if wanted:
        with pytest.raises(Refused) as refused:
            completeness.read_future(folder.path, folder.path, ["moon"])
        assert str(refused.value) == f"{file}: line 2: {wanted}"
    else:
        page = completeness.page(shown(), completeness.read_future(folder.path, folder.path, ["moon"]))
        assert "## Future work of the sources" in page and "| roy | 5 | more |" in page
