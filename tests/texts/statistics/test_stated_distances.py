from collections.abc import Callable

import pytest

from memorymaze.language.reading import parse_route_description
from memorymaze.texts.corpus import Failure, Instruction
from memorymaze.texts.statistics.stated_distances import (
    by_unit,
    route_legs,
    stated_distances,
    summarise_distances,
)
from memorymaze.world.sites import Site

Told = Callable[..., Instruction]


def test_the_legs_of_a_route_are_those_between_its_turns(
    loop_site: Site, slanted_crossing_site: Site
) -> None:
    legs = route_legs(loop_site, loop_site.find_route("route_r1_alternative"))
    assert legs == [(3.0, "left"), (12.0, "left"), (12.0, "left"), (6.0, "")]
    [first, last] = (
        route_legs(slanted_crossing_site, slanted_crossing_site.find_route("R1")) or []
    )
    assert first == (10.0, "left")
    assert last[0] == pytest.approx(11.0, abs=1e-3)


def test_every_route_of_the_benchmark_falls_into_legs_that_sum_to_its_length(
    builtin_sites: dict[str, Site],
) -> None:
    for site in builtin_sites.values():
        for route in site.routes:
            legs = route_legs(site, route)
            assert legs is not None
            assert sum(metres for metres, _ in legs) == pytest.approx(route.line.length)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        pytest.param(
            "Go 18 metres, turn right, and 6 metres on is the door.",
            [("metres", 18.0, 9.0), ("metres", 6.0, 6.0)],
            id="both legs",
        ),
        pytest.param(
            "Walk ten steps and turn right.", [("steps", 7.0, 9.0)], id="steps"
        ),
        pytest.param("Go 9 metres and turn left.", [], id="another turn"),
        pytest.param(
            "Go 9 metres, turn right, then turn left.", [], id="one turn too many"
        ),
        pytest.param("Turn right at the corner.", [], id="no length"),
    ],
)
def test_lengths_are_compared_where_the_turns_agree(
    told: Told, loop_site: Site, text: str, found: list[tuple[str, float, float]]
) -> None:
    legs = stated_distances(told(text), parse_route_description(text), loop_site)
    assert [(leg.unit, pytest.approx(leg.stated), leg.true) for leg in legs] == found


def test_texts_with_errors_are_left_out(told: Told, loop_site: Site) -> None:
    text = "Go 18 metres and turn right."
    wrong = told(text, failures=(Failure("extra_turn", "tp_nw", ""),))
    assert stated_distances(wrong, parse_route_description(text), loop_site) == []


def test_a_summary_has_median_quartiles_and_spread(told: Told, loop_site: Site) -> None:
    legs = [
        leg
        for metres in ("4.5 metres", "9 metres", "18 metres")
        for text in [f"Go {metres} and turn right."]
        for leg in stated_distances(
            told(text), parse_route_description(text), loop_site
        )
    ]
    groups = by_unit(legs)
    assert [unit for _, unit in groups] == ["metres", "numbers"]
    for group in groups.values():
        assert summarise_distances(group) == pytest.approx({
            "legs": 3,
            "texts": 3,
            "median": 1.0,
            "low": 0.75,
            "high": 1.5,
            "factor": 2 ** (2 / 3) ** 0.5,
        })
