"""The pages of `make bench`, of made-up times."""
import json

import speed

MACHINE = {"processor": "abacus", "compiler": "GNU 12", "commit": "abc", "dirty": False}


def verdict(printed, reproduced):
    """As common/nlmech/scene/evidence/ratios.cpp judges."""
    apart, same = max(printed / reproduced, reproduced / printed), (printed > 1) == (reproduced > 1)
    return {"printed": printed, "reproduced": reproduced, "low": reproduced / 2, "high": reproduced * 2, "apart": apart, "same_faster": same,
            "holds": same and apart <= 3, "lost": printed > 1 and not same}


def rows(place, *ratios):
    return [{"place": place, "row": f"row {i}", "reference": "own", "printed_seconds": printed, "seconds": 1e-6,
             "verdict": verdict(printed, reproduced)} for i, (printed, reproduced) in enumerate(ratios)]


def ratios(claims=(), **programs):
    return speed.Ratios({name: {**MACHINE, "allowed_factor": 3, "rows": found, "claims": list(claims)} for name, found in programs.items()})


def quoted(found):
    return {quantity["name"]: quantity["value"] for quantity in json.loads(speed.quantities(found))["quantities"]}


def test_what_is_lost_comes_first_and_the_worst_of_it_at_the_top():
    page = speed.ratios_page(ratios(b=rows("table-1", (7, 0.5), (700, 0.5), (5, 4))))
    assert (page.index("## Faster in print, slower here") < page.index("| 1 | row 1 |") < page.index("| 1 | row 0 |")
            < page.index("## Table 1"))
    assert "| 1 | row 2 |" not in page, "this one is won"
    assert "at most a factor of 3 apart" in page and "Of 3 ratios 1 hold; with factors of 2, 5 and 10 it would be 1, 1 and 1." in page
    assert page.endswith("## Measured on\n\n- b: abacus, GNU 12, commit abc.\n")


def test_all_programs_stand_on_one_page_in_the_order_of_their_tables():
    page = speed.ratios_page(ratios(a=rows("table-4.2", (7, 5)), b=rows("table-3.2", (7, 5))))
    assert page.index("## Table 3.2") < page.index("## Table 4.2")
    assert "## Faster in print, slower here\n\nIn no row.\n" in page


def test_the_reference_is_not_compared_with_itself():
    own = {**rows("table-1", (1, 1))[0], "row": "own"}
    found = ratios(a=[own, *rows("table-1", (7, 5))])
    assert quoted(found)["ratios"] == 1
    assert "| own | 1 | 1e-6 | 1 | 1 | 0.5 | 2 | 1 | reference |" in speed.ratios_page(found)


def test_ratios_can_be_quoted():
    claim = {"place": "claim-3.2.2", "row": "LEO", "quantity": "faster by", "verdict": verdict(24, 1.5)}
    found = ratios([claim], a=rows("table-1", (7, 5), (5, 0.5)))
    names = quoted(found)
    for name, value in (("table-1, row 0, printed", 7), ("table-1, row 0, reproduced", 5), ("table-1, row 0, verdict", "holds"),
                        ("table-1, row 0, printed over measured seconds", 7 / 1e-6), ("ratios", 2), ("ratios that hold", 1),
                        ("faster in print, slower here", 1), ("claim-3.2.2, LEO, faster by, verdict", "does not hold")):
        assert names[name] == value, name
    assert "| 3.2.2 | LEO | faster by | 24 | 1.5 | 0.75 | 3 | 16 | does not hold |" in speed.ratios_page(found)


def test_claims_about_speed_stand_with_their_times():
    claim = {"claim": "a|b", "promised": 3, "ratio": 3.25, "low": 2.5, "high": 4e6, "held": True}
    page = speed.speed_page({"geodesy": {**MACHINE, "dirty": True, "claims": [claim, {**claim, "held": False}],
                                         "series": [{"name": "w", "unit": "us a run", "median": 2.0, "repetitions": [3.0, 2.0, 0.5]}]}})
    assert "## geodesy\n\nabacus, GNU 12, commit abc with changes.\n\n| claim |" in page
    assert "| a\\|b | 3 | 3.25 | 2.5 | 4e6 | yes |\n| a\\|b | 3 | 3.25 | 2.5 | 4e6 | NO |\n" in page
    assert page.endswith("| work | median | from | to | unit |\n| :--- | ---: | ---: | ---: | :--- |\n| w | 2 | 0.5 | 3 | us a run |\n")
