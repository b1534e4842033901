"""Where a walk may end: at what was named, at the length said, or at the end."""

import pytest

from memorymaze.agents.rules.arriving import RulesArrivals, RulesEnding
from memorymaze.agents.rules.evidence import Standing
from memorymaze.agents.walking.choices import Choices
from memorymaze.agents.walking.floor_map import Crossing, FloorMap, Sighting, Stretch
from memorymaze.understanding import parse_route_description

NEXT = 3
STRETCH = Stretch(0, 0, NEXT, 0.0, 20.0, frozenset({"red sofa", "door"}))
BEGUN = Standing(0, 0.0, 0, line=((0.0, 0.0),), exit=0)


def _floor() -> FloorMap:
    floor = FloorMap()
    floor.crossings[NEXT] = Crossing(NEXT, (20.0, 0.0))
    floor.add_stretch(STRETCH)
    return floor


def _see(
    floor: FloorMap, phrase: str, x: float, label: str = "", track: int = 1
) -> None:
    """Note a thing on the left that is seen from right beside it."""
    floor.note(
        Sighting(
            phrase, label or phrase, 1.0, (x, 2.0), (x, 0.0), 2.0, track, (0, 0), "left"
        )
    )


def _best(text: str, floor: FloorMap) -> RulesEnding:
    arrivals = RulesArrivals(parse_route_description(text), floor)
    at_end = Standing(NEXT, 0.0, 0, walked=20.0, line=((0.0, 0.0), (20.0, 0.0)))
    endings = [*arrivals.on_stretch(BEGUN, STRETCH)]
    endings += arrivals.at_crossing(at_end, Choices(()))
    return min(endings, key=lambda each: each.cost)


def test_it_stops_where_the_destination_was_seen() -> None:
    floor = _floor()
    _see(floor, "red sofa", 8.0)
    best = _best("Go straight. The red sofa is on your left.", floor)
    assert best.reason == "red sofa seen"
    assert best.distance == pytest.approx(8.0)


def test_of_two_alike_the_one_at_the_length_said_is_meant() -> None:
    floor = _floor()
    for track, x in enumerate((3.0, 15.0)):
        _see(floor, "red sofa", x, track=track)
    text = "Go straight for {} metres. The red sofa is on your left."
    assert _best(text.format(3), floor).distance == pytest.approx(3.0)
    assert _best(text.format(15), floor).distance == pytest.approx(15.0)


def test_without_the_destination_it_goes_to_the_end_of_the_way() -> None:
    best = _best("Walk to the end. The red sofa is there.", _floor())
    assert (best.standing.at, best.exit, best.reason) == (NEXT, None, "end of the way")


def test_without_a_name_it_stops_after_the_length_said() -> None:
    best = _best("Walk 12 metres.", _floor())
    assert best.reason == "12 m walked"
    assert best.distance == pytest.approx(12.0)


def test_a_sign_that_names_the_destination_is_not_the_destination() -> None:
    floor = _floor()
    _see(floor, "library", 5.0, label="sign that says library")
    assert _best("The library is at the end.", floor).reason == "end of the way"


def test_a_turn_still_to_come_speaks_against_stopping() -> None:
    floor = _floor()
    _see(floor, "red sofa", 8.0)
    now = _best("Go straight to the red sofa.", floor).cost
    later = _best("Go straight, then turn left, then go to the red sofa.", floor).cost
    assert later > now + 1.0
