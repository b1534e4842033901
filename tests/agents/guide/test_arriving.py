"""What is said of the last stretch speaks for the right place to end."""

import math

import pytest

from memorymaze.agents.guide.alignments import AssumedStart, Segment
from memorymaze.agents.guide.arriving import Arrivals
from memorymaze.agents.guide.belief import Belief
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.things import Things
from memorymaze.agents.walking.floor_map import (
    Crossing,
    FloorMap,
    Point,
    Sighting,
    Stretch,
)
from memorymaze.language.plans import Arrival, Length, Mention, RoutePlan, Totals

EAST, WEST = (12.0, 0.0), (-12.0, 0.0)
BOTH_WAYS = [AssumedStart(0, 0.0, 0, 0.5), AssumedStart(0, math.pi, 1, 0.5)]


def _floor(phrases: frozenset[str], *seen: tuple[str, Point]) -> FloorMap:
    """One hall from west to east, with dead ends, in whose middle one starts."""
    floor = FloorMap()
    floor.crossings[0].add_exit(math.pi)
    for exit, (place, heading) in enumerate(((EAST, 0.0), (WEST, math.pi))):
        end: Crossing = floor.new_dead_end(place)
        floor.add_stretch(Stretch(0, exit, end.number, heading, 12.0, phrases))
    for track, (phrase, place) in enumerate(seen):
        note = Sighting(phrase, phrase, 1.0, place, place, 5.0, track, (0, 0), "left")
        floor.note(note)
    return floor


def _share_in_the_east(floor: FloorMap, arrival: Arrival) -> float:
    """Of those who tell a way, straight on; who tells the place alone has it searched."""
    plan, model = RoutePlan(arrival=arrival, totals=Totals(turns=0)), Likelihoods()
    things = Things(plan, floor, model)
    belief = Belief(plan, floor, model, things)
    belief.update(BOTH_WAYS)
    endings = Arrivals(plan, floor, model, things).endings(belief)
    east = sum(each.mass for each in endings if each.place[0] > 0)
    return east / sum(each.mass for each in endings)


def _told(phrase: str, kind: str = "object") -> Arrival:
    return Arrival(mentions=(Mention(phrase, kind, "turn"),), at_end=True)  # type: ignore[arg-type]


def test_a_thing_at_the_destination_tells_where_it_is() -> None:
    floor = _floor(frozenset({"lamp"}), ("lamp", (11.0, 1.0)))
    assert _share_in_the_east(floor, _told("lamp")) > 0.8


def test_a_thing_nearer_to_another_place_is_not_at_this_one() -> None:
    floor = _floor(frozenset({"lamp"}), ("lamp", (8.0, 1.0)))
    floor.crossings[9] = Crossing(9, (8.0, 0.0))
    floor.farthest = 40.0
    assert _share_in_the_east(floor, _told("lamp")) == pytest.approx(0.5)


def test_what_is_heard_is_not_missed_in_the_picture() -> None:
    floor = _floor(frozenset({"music"}))
    floor.stretches[0, 0] = Stretch(0, 0, -1, 0.0, 12.0, frozenset())
    assert _share_in_the_east(floor, _told("music")) > 0.6
    assert _share_in_the_east(floor, _told("music", "sound")) == pytest.approx(0.5)


def test_a_side_is_meant_as_one_walks_whichever_way_the_thing_was_seen_from() -> None:
    seen = [("sofa", (8.0, 1.5)), ("sofa", (-8.0, 1.5))]
    floor = _floor(frozenset({"sofa"}), *seen)
    left = _share_in_the_east(floor, Arrival(("sofa",), side="left"))
    right = _share_in_the_east(floor, Arrival(("sofa",), side="right"))
    assert left > 0.6
    assert right == pytest.approx(1 - left)


def test_a_corner_to_arrive_at_is_one_where_the_way_does_not_go_on() -> None:
    floor = _floor(frozenset())
    floor.crossings[-1].exits.extend([0.0, math.pi / 2])
    floor.crossings[-2].exits.append(math.pi / 2)
    corner = Arrival(mentions=(Mention("corner", "place", "turn"),), at_end=False)
    plain = _share_in_the_east(floor, Arrival())
    assert _share_in_the_east(floor, corner) < plain


def test_a_destination_that_was_seen_is_likelier_than_one_that_was_not() -> None:
    floor = _floor(frozenset({"piano"}), ("piano", (8.0, 1.0)))
    assert _share_in_the_east(floor, Arrival(("piano",))) > 0.8


@pytest.mark.parametrize(
    ("told", "written", "is_it"),
    [
        ("movies", "Cinema", True),
        ("food", "Restaurant", True),
        ("chemistry", "Chemistry Lab", True),
        ("movies", "Chapel", False),
        ("movies", "Cinema →", False),
        ("statue", "Sculpture Hall", False),
    ],
)
def test_a_sign_may_name_what_one_wants_there_in_other_words(
    told: str, written: str, is_it: bool
) -> None:
    floor = _floor(frozenset({told}))
    place, here = (8.0, 1.0), (7.0, 0.0)
    floor.note_text(
        Sighting(written, written, 1.0, place, here, 1.5, 7, (0, 0), "left")
    )
    share = _share_in_the_east(floor, Arrival((told,)))
    assert share > 0.6 if is_it else share == pytest.approx(0.5)


def test_what_bears_a_doubtful_name_counts_less() -> None:
    def share(doubt: float) -> float:
        floor = _floor(frozenset({"piano"}), ("piano", (8.0, 1.0)))
        told = Arrival(("piano",), unclear_names=(doubt,))
        return _share_in_the_east(floor, told)

    assert share(0.0) > 0.8
    assert share(0.0) > share(0.6) > share(0.9) > share(1.0)


@pytest.mark.parametrize(("doubts", "expected"), [((0.1,), True), ((0.8,), False)])
def test_a_destination_by_a_doubtful_name_alone_has_none(
    doubts: tuple[float, ...], expected: bool
) -> None:
    plan = RoutePlan(arrival=Arrival(("piano",), unclear_names=doubts))
    floor, model = _floor(frozenset()), Likelihoods()
    arrivals = Arrivals(plan, floor, model, Things(plan, floor, model))
    assert arrivals.is_told == expected
    assert arrivals.destination.at_once == (("piano",) if expected else ())
    assert arrivals.destination.names == ("piano",)


def test_where_a_number_is_told_only_that_door_will_do() -> None:
    model = Likelihoods()
    floor = _floor(frozenset())
    plan = RoutePlan(arrival=Arrival(("office", "door that says 2347")))
    arrivals = Arrivals(plan, floor, model, Things(plan, floor, model))
    assert arrivals.destination.names == ("door that says 2347",)


def test_a_sign_told_by_what_it_says_is_not_any_sign() -> None:
    def share(told: str, seen: str) -> float:
        floor = _floor(frozenset({told, seen}), (seen, (8.0, 1.0)))
        return _share_in_the_east(floor, Arrival((told,)))

    assert share("robot of human shape", "robot") > 0.6
    assert share("exit sign that says Gate 4", "exit sign") == pytest.approx(0.5)


def test_what_was_found_not_to_be_the_destination_is_no_place_to_arrive_at() -> None:
    floor = _floor(frozenset({"piano"}), ("piano", (8.0, 1.0)))
    plan, model = RoutePlan(arrival=Arrival(("piano",))), Likelihoods()
    things = Things(plan, floor, model)
    belief = Belief(plan, floor, model, things)
    belief.update(BOTH_WAYS)
    arrivals = Arrivals(plan, floor, model, things)
    assert any(each.sighting for each in arrivals.endings(belief))
    floor.refuted.add(0)
    assert not any(each.sighting for each in arrivals.endings(belief))


def test_the_length_of_the_last_stretch_tells_where_on_it_one_arrives() -> None:
    floor = _floor(frozenset())
    plan = RoutePlan(arrival=Arrival(length=Length(6.0, "metres")))
    model = Likelihoods()
    things = Things(plan, floor, model)
    belief = Belief(plan, floor, model, things)
    belief.update(BOTH_WAYS)
    endings = Arrivals(plan, floor, model, things).endings(belief)
    best = max(endings, key=lambda each: each.mass)
    assert abs(best.place[0]) == pytest.approx(6.0)


def test_a_destination_beyond_the_next_crossing_is_not_at_this_one() -> None:
    floor = FloorMap()
    plan, model = RoutePlan(arrival=Arrival(("piano",))), Likelihoods()
    floor.crossings[5] = Crossing(5, EAST, [math.pi, 0.0])
    floor.add_stretch(Stretch(0, 0, 5, 0.0, 12.0, frozenset()))
    floor.note(
        Sighting("piano", "piano", 1.0, (15.5, 0.5), EAST, 3.5, 9, (5, 1), "ahead")
    )
    things = Things(plan, floor, model)
    belief = Belief(plan, floor, model, things)
    belief.update([AssumedStart(0, 0.0, 0, 1.0)])
    endings = Arrivals(plan, floor, model, things).endings(belief)
    seen = {(each.at, each.exit) for each in endings if each.sighting}
    assert seen == {(5, 1)}
    best = max(endings, key=lambda each: each.mass)
    assert best.reason == "piano seen ahead"
    assert best.distance == pytest.approx(3.5, abs=0.1)


def test_nobody_is_sent_to_where_they_set_off() -> None:
    floor = _floor(frozenset(), ("piano", (1.0, 0.5)), ("piano", (9.0, 0.5)))
    plan, model = RoutePlan(arrival=Arrival(("piano",))), Likelihoods()
    things = Things(plan, floor, model)
    belief = Belief(plan, floor, model, things)
    belief.update(BOTH_WAYS)
    endings = Arrivals(plan, floor, model, things).endings(belief)
    masses = {round(each.place[0]): each.mass for each in endings if each.sighting}
    assert masses[9] > 10 * masses[1]


def test_a_name_weighs_more_than_a_thing_of_which_there_are_many() -> None:
    def share(phrase: str) -> float:
        floor = _floor(frozenset({phrase}), (phrase, (8.0, 1.0)))
        return _share_in_the_east(floor, Arrival((phrase,)))

    assert share("door") < 0.9 < 0.99 < share("planetarium")


def test_a_place_with_a_door_and_a_sign_is_no_two_places() -> None:
    def ratio(*seen: Point) -> float:
        floor = _floor(frozenset({"cafe"}), *(("cafe", each) for each in seen))
        plan, model = RoutePlan(arrival=Arrival(("cafe",))), Likelihoods()
        arrivals = Arrivals(plan, floor, model, Things(plan, floor, model))
        return arrivals.destination.seen(floor.seen("cafe")[0])

    door, sign, another = (8.0, 1.0), (6.5, 1.0), (-8.0, 1.0)
    assert ratio(door, sign) == pytest.approx(ratio(door))
    assert ratio(door, another) < ratio(door)


def test_the_second_door_told_is_not_the_first_one_seen_nor_a_sign() -> None:
    phrase = "Laboratory"
    floor = _floor(frozenset({phrase}))
    for track, (label, x) in enumerate((("door", 3.0), ("sign", 5.0), ("door", 8.0))):
        place = x, 1.0
        note = Sighting(phrase, label, 1.0, place, place, 1.0, track, (0, 0), "left")
        floor.note(note)
    plan, model = RoutePlan(arrival=Arrival((phrase,), nth=2)), Likelihoods()
    things = Things(plan, floor, model)
    belief = Belief(plan, floor, model, things)
    belief.update(BOTH_WAYS)
    endings = Arrivals(plan, floor, model, things).endings(belief)
    best = max(endings, key=lambda each: each.mass)
    assert best.place == (8.0, 1.0)


def test_a_place_of_one_name_may_lie_further_on_where_a_length_says_so() -> None:
    def chance_further_on(metres: float) -> float:
        told = Arrival(("Laboratory",), length=Length(metres, "metres"))
        plan, model = RoutePlan(arrival=told), Likelihoods()
        floor = _floor(frozenset())
        arrivals = Arrivals(plan, floor, model, Things(plan, floor, model))
        start = Segment(0, 0.0, 0, model.speakers, line=((0.0, 0.0),))
        door = Sighting(
            "Laboratory", "door", 1.0, (3.0, 1.0), (2.0, 0.0), 1.5, 1, (0, 0), "left"
        )
        here = arrivals.here(start, door, 2.0).sum()
        beyond = arrivals.beyond(start, door, 2.0).sum()
        return float(beyond / (here + beyond))

    assert chance_further_on(3.0) < 0.2 < 0.5 < chance_further_on(12.0)


def test_what_is_called_by_another_word_is_found_by_its_kin() -> None:
    def share(label: str) -> float:
        floor = _floor(frozenset({"counter", "furniture"}))
        place = 8.0, 1.0
        note = Sighting("furniture", label, 1.0, place, place, 1.0, 1, (0, 0), "left")
        floor.note(note)
        return _share_in_the_east(floor, Arrival(("counter",)))

    assert share("desk") > 0.7
    assert share("piano") == pytest.approx(0.5)
