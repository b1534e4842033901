"""What is told of a route is in sight of who walks it."""

import math
from dataclasses import replace

import pytest
from shapely import LineString, Point

from memorymaze.language.reading import parse_route_description
from memorymaze.texts.writing import cells_of, parse_rates, sample_outlines, write_texts
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.world.sites import Site

FLOOR_ENDS = 0.8
"""Metres before a thing where the floor may end: things stand in niches and on walls."""
STEP = 0.2


def _is_in_sight(facts: RouteFacts, eye: Point, spot: Point) -> bool:
    """Look along the line step by step, another way than the code does."""
    floor = facts.graph.site.walkable_floor.buffer(0.06)
    sight = LineString([eye, spot])
    steps = max(math.floor((sight.length - FLOOR_ENDS) / STEP), 0)
    return all(floor.covers(sight.interpolate(n * STEP)) for n in range(steps + 1))


def test_no_thing_behind_a_wall_is_passed(all_facts: list[RouteFacts]) -> None:
    hidden: list[str] = []
    for facts in all_facts:
        starts = (0.0, *facts.stops)
        for start, stretch in zip(starts, facts.stretches, strict=True):
            for each in stretch.beside:
                eye = facts.route.line.interpolate(start + each.after)
                if not _is_in_sight(facts, eye, Point(each.thing.position)):
                    hidden.append(f"{facts.route.id}: {each.thing.words}")
    assert hidden == []


def test_a_thing_that_marks_a_turn_is_seen_from_there(
    all_facts: list[RouteFacts],
) -> None:
    for facts in all_facts:
        for turn, cues in zip(facts.route.turns, facts.cues, strict=True):
            here = facts.graph.points[turn.at]
            for cue in cues:
                if cue.kind == "thing":
                    named = [t for t in facts.graph.things if t.words == cue.words]
                    assert any(facts.graph.is_seen_from(here, t) for t in named)


def test_a_corner_hides_what_is_round_it(university_r1: RouteFacts) -> None:
    line = university_r1.route.line
    before, after = university_r1.stops[0] - 5.0, university_r1.stops[0] + 5.0
    around = line.interpolate(before), line.interpolate(after)
    along = line.interpolate(before), line.interpolate(before + 3.0)
    assert not university_r1.graph.sees(*around)
    assert university_r1.graph.sees(*along)


@pytest.mark.parametrize("part", ["legs", "arrival"])
def test_what_is_said_of_a_route_is_in_the_plan_language(
    university_r1: RouteFacts, part: str
) -> None:
    said = university_r1.plan.said
    if part == "arrival":
        assert said.arrival.destinations == (university_r1.route.goal,)
        return
    assert [leg.turn.way for leg in said.legs] == ["right", "left", "right", "left"]
    lengths = [leg.length.metres if leg.length else 0.0 for leg in said.legs]
    assert sum(lengths) == pytest.approx(university_r1.stops[-1])


def _to_kitchen(
    corridor: Site, labels: str, door: int = 3, start: float = 2.0
) -> RouteFacts:
    """Return a walk past doors with these labels to one of them, the kitchen's."""
    labelled = zip(corridor.doors, labels, strict=True)
    doors = tuple(replace(each, label=label) for each, label in labelled)
    goal = doors[door]
    line = LineString([(start, 0), (goal.line.centroid.x, 0)])
    way = replace(
        corridor.routes[0], line=line, goal="the kitchen", goal_landmark=goal.id
    )
    site = replace(corridor, doors=doors, routes=(way,))
    return cells_of(site)[0].reference


@pytest.mark.parametrize(
    ("labels", "door", "start", "nth"),
    [
        pytest.param("KABK", 3, 2.0, 2, id="behind another"),
        pytest.param("KKKK", 3, 2.0, 4, id="behind three others"),
        pytest.param("BAAK", 3, 2.0, None, id="the only one"),
        pytest.param("AKBK", 1, 2.0, None, id="the first"),
        pytest.param("KABK", 3, 5.0, None, id="another behind the start"),
        pytest.param("KABK", 3, 2.9, 2, id="another right at the start"),
    ],
)
def test_doors_of_one_label_are_counted_up_to_the_goal(
    corridor_site: Site, labels: str, door: int, start: float, nth: int | None
) -> None:
    facts = _to_kitchen(corridor_site, labels, door, start)
    assert facts.plan.said.arrival.nth == nth


@pytest.mark.parametrize(("labels", "nth"), [("KABK", 2), ("KACD", None)])
def test_a_door_counted_in_a_text_is_read_so(
    corridor_site: Site, labels: str, nth: int | None
) -> None:
    site = _to_kitchen(corridor_site, labels).graph.site
    for cell in cells_of(site):
        for outline in sample_outlines(cell, parse_rates("failure=0"), 3, 0):
            (made,) = write_texts(outline, paired=False)
            told = "the second door of the kitchen" in made.text.lower()
            assert told == (nth is not None), made.text
            assert parse_route_description(made.text).arrival.nth == nth
