"""What the guide believes of its way, on small maps."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from memorymaze.agents.guide.alignments import AssumedStart, Segment
from memorymaze.agents.guide.arriving import Arrivals
from memorymaze.agents.guide.belief import MOST_ALIGNMENTS, Belief
from memorymaze.agents.guide.likelihoods import Likelihoods, untold_length
from memorymaze.agents.guide.starts import starts_ahead
from memorymaze.agents.guide.things import Things
from memorymaze.agents.walking.floor_map import Crossing, FloorMap, Sighting, Stretch
from memorymaze.language.plans import Arrival, Leg, Mention, RoutePlan, Turn
from memorymaze.language.reading import ANY_FLOOR, parse_route_description

AHEAD, LEFT, RIGHT, BACK = 0.0, math.pi / 2, -math.pi / 2, math.pi
EAST, NORTH, SOUTH, WEST = AHEAD, LEFT, RIGHT, BACK
ALL_SIDES = (EAST, NORTH, SOUTH, WEST)
MODEL = Likelihoods()
STRETCH = 10.0
"""Metres between two crossings."""

Cell = tuple[int, int]


class Grid:
    """A map of crossings 10 m apart, walked in part; one starts at (0, 0), facing east."""

    def __init__(self, exits: dict[Cell, Sequence[float]]) -> None:
        self.floor = FloorMap()
        self._numbers = {cell: number for number, cell in enumerate(exits)}
        for cell, headings in exits.items():
            number, place = self._numbers[cell], (STRETCH * cell[0], STRETCH * cell[1])
            self.floor.crossings[number] = Crossing(number, place, list(headings))

    def at(self, x: int, y: int) -> int:
        return self._numbers[x, y]

    def exit(self, x: int, y: int, heading: float) -> tuple[int, int]:
        crossing = self.floor.crossings[self.at(x, y)]
        found = crossing.find_exit(heading)
        assert found is not None
        return crossing.number, found

    def walk(self, *cells: Cell, asked: frozenset[str] = frozenset()) -> "Grid":
        """Note ways as walked, in both directions."""
        for here, there in pairwise(cells):
            heading = math.atan2(there[1] - here[1], there[0] - here[0])
            for start, end, along in (
                (here, there, heading),
                (there, here, heading + math.pi),
            ):
                key = self.exit(*start, along)
                self.floor.stretches[key] = Stretch(
                    *key, self.at(*end), along, STRETCH, asked
                )
            self.floor.metres += STRETCH
        return self

    def see(self, phrase: str, x: float, y: float, by: Cell | None = None) -> None:
        """Note a thing beside a place, in cells, seen from there or from a crossing."""
        place = STRETCH * x, STRETCH * y + 1.5
        eye = by or (x, y)
        seen_from = STRETCH * eye[0], STRETCH * eye[1]
        self.floor.note(
            Sighting(phrase, phrase, 1.0, place, seen_from, 1.5, 1, (0, 0), "left")
        )

    def look(self, x: int, y: int, heading: float, floor: str) -> None:
        """Note the floor that one sees along a way out, asked for all floors."""
        seen = [
            Sighting(
                phrase, phrase, 1.0, (0.0, 0.0), (0.0, 0.0), 2.0, 1, (0, 0), "ahead"
            )
            for phrase in (ANY_FLOOR, floor)
        ]
        asked = (ANY_FLOOR, "brick floor", "grass floor")
        self.floor.note_view(*self.exit(x, y, heading), asked, seen)


def _hall(crossings: int) -> Grid:
    """Return a hall to the east with a crossing each 10 m, walked up to the last."""
    cells: dict[Cell, Sequence[float]] = {(0, 0): (EAST,)}
    cells |= {(x, 0): ALL_SIDES for x in range(1, crossings + 1)}
    return Grid(cells).walk(*cells)


def _believe(
    plan: RoutePlan | str, grid: Grid, starts: list[AssumedStart] | None = None
) -> Belief:
    if isinstance(plan, str):
        plan = parse_route_description(plan)
    belief = Belief(plan, grid.floor, MODEL, Things(plan, grid.floor, MODEL))
    belief.update(starts or starts_ahead(MODEL, grid.floor, 0))
    return belief


def _shares(belief: Belief) -> dict[tuple[int, int], float]:
    """Return how likely each way out is that was not walked."""
    masses = {key: each.mass for key, each in belief.frontiers.items()}
    return {key: mass / sum(masses.values()) for key, mass in masses.items()}


def _best(belief: Belief) -> tuple[int, int]:
    shares = _shares(belief)
    return max(shares, key=lambda key: shares[key])


# -- turns told


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("Turn left.", (1, 0, NORTH)),
        ("Turn right.", (1, 0, SOUTH)),
        ("Take the first left.", (1, 0, NORTH)),
        ("Take the second left.", (2, 0, NORTH)),
        ("Take the third right.", (3, 0, SOUTH)),
        ("Walk 20 metres and turn left.", (2, 0, NORTH)),
        ("Go to the end and turn left.", (3, 0, EAST)),
        ("Walk 150 metres and turn left.", (3, 0, EAST)),
        ("Take the fifth left.", (3, 0, EAST)),
    ],
)
def test_the_way_told_is_the_likeliest(text: str, way: tuple[int, int, float]) -> None:
    grid = _hall(3)
    assert _best(_believe(text, grid)) == grid.exit(*way)


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("Take the first left after the clock.", (3, 0, NORTH)),
        ("Take a left two junctions after the clock.", (4, 0, NORTH)),
        ("Take the first left.", (1, 0, NORTH)),
    ],
)
def test_openings_are_counted_from_the_thing_that_is_told(
    text: str, way: tuple[int, int, float]
) -> None:
    grid = _hall(5)
    grid.see("clock", 2.3, 0)
    assert _best(_believe(text, grid)) == grid.exit(*way)


def test_before_the_thing_is_met_no_opening_is_counted() -> None:
    grid = _hall(2)
    from_the_clock = _shares(_believe("Take the first left after the clock.", grid))
    from_the_start = _shares(_believe("Take the first left.", grid))
    on = grid.exit(2, 0, EAST)
    assert from_the_clock[on] > from_the_start[on]


def _here_to_going_on(text: str, grid: Grid, x: int) -> float:
    """Weigh arriving at the last crossing of a hall against going on beyond it."""
    belief = _believe(text, grid)
    endings = Arrivals(belief.plan, grid.floor, MODEL, belief.things).endings(belief)
    here = sum(each.mass for each in endings if each.at == grid.at(x, 0))
    return here / belief.frontiers[grid.exit(x, 0, EAST)].mass


def test_one_has_not_arrived_one_junction_after_a_thing_that_was_not_passed() -> None:
    told = "One intersection past the clock you have arrived."
    before, after = _hall(1), _hall(3)
    after.see("clock", 2.2, 0)
    here = _here_to_going_on(told, after, 3)
    assert 4 * _here_to_going_on(told, before, 1) < here


def test_a_thing_passed_on_the_last_stretch_speaks_as_well_for_going_on() -> None:
    told = "Go past the clock to the end."
    without, passed = _hall(2), _hall(2)
    passed.see("clock", 1.5, 0)
    assert _here_to_going_on(told, passed, 2) < 1.5 * _here_to_going_on(
        told, without, 2
    )


def test_a_thing_a_little_way_ahead_is_still_to_come() -> None:
    cells: dict[Cell, Sequence[float]] = {(0, 0): (EAST,), (1, 0): (EAST, NORTH, WEST)}
    grid = Grid(cells).walk((0, 0), (1, 0))
    grid.see("clock", 1.35, -0.1, by=(1, 0))
    assert _best(_believe("Turn left at the clock.", grid)) == grid.exit(1, 0, EAST)


@pytest.mark.parametrize(("side", "cell"), [("left", 1), ("right", 2)])
def test_a_floor_told_on_a_side_is_looked_for_on_that_side(
    side: str, cell: int
) -> None:
    grid = _hall(3)
    for x, left, right in ((1, "brick", "grass"), (2, "grass", "brick")):
        grid.look(x, 0, NORTH, f"{left} floor")
        grid.look(x, 0, SOUTH, f"{right} floor")
    plan = parse_route_description(f"Go on. You see brick floor to your {side}.")
    belief = _believe(plan, grid)
    arrivals = Arrivals(plan, grid.floor, MODEL, belief.things)
    best = max(arrivals.endings(belief), key=lambda each: each.mass)
    assert (best.at, best.exit) == (grid.at(cell, 0), None)


def test_turns_are_found_one_after_the_other() -> None:
    cells: dict[Cell, Sequence[float]] = {(0, 0): (EAST,)}
    cells |= {(x, y): ALL_SIDES for x in (1, 2) for y in (0, 1, 2)}
    grid = Grid(cells).walk((0, 0), (1, 0), (1, 1), (1, 2)).walk((1, 1), (2, 1))
    belief = _believe("Turn left. Take the first right. Then turn left.", grid)
    best = belief.frontiers[_best(belief)]
    assert (best.at, best.exit) == grid.exit(2, 1, NORTH)
    assert best.best.leg == 3
    assert [at for _, at in best.best.turns] == [grid.at(*c) for c in ((1, 0), (1, 1), (2, 1))]  # fmt: skip


def test_a_corner_without_a_choice_is_followed_though_nobody_told_of_it() -> None:
    cells: dict[Cell, Sequence[float]] = {
        (0, 0): (EAST,),
        (1, 0): (NORTH, WEST),
        (1, 1): ALL_SIDES,
    }
    grid = Grid(cells).walk(*cells)
    belief = _believe("Turn right at the crossing.", grid)
    assert _best(belief) == grid.exit(1, 1, EAST)
    assert not belief.frontiers[_best(belief)].best.slips


def test_a_closed_way_is_not_believed_in() -> None:
    grid = _hall(2)
    at, exit = grid.exit(1, 0, NORTH)
    grid.floor.crossings[at].closed.add(exit)
    assert (at, exit) not in _believe("Turn left.", grid).frontiers


# -- sums


def test_what_may_be_begun_in_two_ways_has_the_weight_of_both() -> None:
    grid, plan = _hall(2), parse_route_description("Take the second left.")
    alone = _believe(plan, grid, [AssumedStart(0, EAST, 0, 0.4)])
    twice = _believe(
        plan, grid, [AssumedStart(0, EAST, 0, 0.4), AssumedStart(0, EAST, 0, 0.4)]
    )
    assert alone.frontiers.keys() == twice.frontiers.keys()
    for key, frontier in alone.frontiers.items():
        assert twice.frontiers[key].mass == pytest.approx(2 * frontier.mass, rel=0.01)


def test_two_alignments_that_meet_become_one_with_the_weight_of_both() -> None:
    """Round a block either way and out by the same exit: what was told fits both."""
    grid = Grid(dict.fromkeys([(0, 0), (1, 0), (1, 1), (0, 1)], ALL_SIDES))
    grid.walk((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))
    turn = Leg(Turn("either"))
    plan = RoutePlan(legs=(turn, replace(turn)))
    starts = [AssumedStart(0, EAST, grid.exit(0, 0, EAST)[1], 0.5)]
    starts += [AssumedStart(0, NORTH, grid.exit(0, 0, NORTH)[1], 0.5)]
    both = _believe(plan, grid, starts)
    each = [_believe(plan, grid, [start]) for start in starts]
    for key in both.frontiers:
        apart = sum(b.frontiers[key].mass for b in each if key in b.frontiers)
        assert both.frontiers[key].mass == pytest.approx(apart, rel=0.05)


def test_all_that_is_believed_is_in_ways_not_walked_and_in_places_to_arrive_at() -> (
    None
):
    grid = _hall(3)
    belief = _believe("Turn left and walk to the end.", grid)
    done = [each for each in belief.visits if each.stretch is None]
    weights = [*(w for f in belief.frontiers.values() for _, w, _ in f.alignments)]
    weights += [visit.segment.weights for visit in done]
    assert all(np.isfinite(each).all() and (each >= 0).all() for each in weights)
    assert sum(f.mass for f in belief.frontiers.values()) > 0


def test_an_ending_is_found_where_the_way_told_ends() -> None:
    cells: dict[Cell, Sequence[float]] = {
        (0, 0): (EAST,),
        (1, 0): ALL_SIDES,
        (1, 1): (SOUTH,),
        (1, -1): (NORTH,),
    }
    grid = Grid(cells).walk((0, 0), (1, 0), (1, 1)).walk((1, 0), (1, -1))
    plan = parse_route_description("Turn left at the crossing and walk to the end.")
    belief = _believe(plan, grid)
    endings = Arrivals(plan, grid.floor, MODEL, belief.things).endings(belief)
    best = max(endings, key=lambda each: each.mass)
    assert best.at == grid.at(1, 1)
    assert best.mass > _most_elsewhere(belief)


def _most_elsewhere(belief: Belief) -> float:
    return max((f.mass for f in belief.frontiers.values()), default=0.0)


# -- errors


def test_that_nothing_told_is_right_is_always_possible() -> None:
    belief = _believe("Take the second left.", _hall(2))
    for frontier in belief.frontiers.values():
        [lost] = [each for each, _, _ in frontier.alignments if each.lost]
        assert 0 < lost.weights.sum() <= frontier.mass


# -- no way told


def test_where_only_the_place_is_told_all_ways_are_alike_and_none_is_an_error() -> None:
    grid = _hall(2)
    told = _believe("Walk 30 metres to the piano.", grid)
    assert _shares(told)[grid.exit(2, 0, EAST)] > 0.9
    belief = _believe("The piano, near the kiosk.", grid)
    shares = _shares(belief)
    assert _best(belief) == grid.exit(2, 0, EAST)
    assert max(shares.values()) < 2 * min(shares.values())
    doubts = [each.best.slips for each in belief.frontiers.values()]
    assert not any(doubts)


def test_a_search_follows_each_hall_from_where_it_begins() -> None:
    cells: dict[Cell, Sequence[float]] = {
        (0, 0): (EAST,),
        (1, 0): (NORTH, SOUTH, WEST),
        (1, 1): ALL_SIDES,
        (1, 2): (SOUTH,),
        (1, -1): (NORTH,),
    }
    grid = Grid(cells).walk((0, 0), (1, 0), (1, 1), (1, 2)).walk((1, 0), (1, -1))
    belief = _believe("The piano, near the kiosk.", grid)
    halls = {
        visit.segment.line
        for visit in belief.visits
        if visit.segment.lost and visit.stretch is None
    }
    southmost, middle = (STRETCH, -STRETCH), (STRETCH, STRETCH)
    north = southmost, (STRETCH, 0.0), middle, (STRETCH, 2 * STRETCH)
    assert {north, north[::-1]} <= halls
    assert {line[0] for line in halls if line[-1] == middle} == {southmost, north[-1]}


def test_a_ring_of_halls_is_searched_as_well() -> None:
    around: list[Cell] = [
        (1, 0),
        (2, 1),
        (2, 2),
        (1, 3),
        (0, 3),
        (-1, 2),
        (-1, 1),
        (0, 0),
    ]
    eighths = [number * math.pi / 4 for number in range(8)]
    grid = Grid(dict.fromkeys([(0, 0), *around], eighths)).walk(*around, around[0])
    belief = _believe("The piano, near the kiosk.", grid)
    walked = {
        (visit.stretch.start, visit.stretch.end)
        for visit in belief.visits
        if visit.segment.lost and visit.stretch is not None
    }
    assert {(grid.at(*a), grid.at(*b)) for a, b in pairwise(around)} <= walked


def _fork(*, dead_end: bool) -> tuple[Grid, str]:
    """Return a T of which the way told was walked, to a crossing or to a dead end."""
    cells: dict[Cell, Sequence[float]] = {
        (0, 0): (EAST,),
        (1, 0): (NORTH, SOUTH, WEST),
        (1, 1): (SOUTH,) if dead_end else ALL_SIDES,
    }
    grid = Grid(cells).walk(*cells)
    return grid, "At the T junction turn left. At the crossing turn right."


def test_a_wrong_side_is_unlikely_while_the_one_told_goes_on() -> None:
    grid, text = _fork(dead_end=False)
    belief = _believe(text, grid)
    assert _best(belief) == grid.exit(1, 1, EAST)
    assert 0 < _shares(belief)[grid.exit(1, 0, SOUTH)] < 0.2


def test_a_wrong_side_is_believed_once_the_one_told_proves_a_dead_end() -> None:
    grid, text = _fork(dead_end=True)
    belief = _believe(text, grid)
    assert _best(belief) == grid.exit(1, 0, SOUTH)
    best = belief.frontiers[_best(belief)].best
    assert [(slip.kind, slip.leg) for slip in best.slips] == [("wrong side", 0)]
    assert best.weights[1].sum() > best.weights[0].sum()


def test_a_turn_is_likelier_told_to_the_wrong_side_if_it_is_the_first() -> None:
    tee: dict[Cell, Sequence[float]] = {(0, 0): (EAST,), (1, 0): (NORTH, SOUTH, WEST)}
    first = Grid(tee).walk(*tee)
    later: dict[Cell, Sequence[float]] = {
        (0, 0): (EAST,),
        (1, 0): (NORTH, WEST),
        (1, 1): (EAST, WEST, SOUTH),
    }
    second = Grid(later).walk(*later)
    told_first = _shares(_believe("At the T turn left.", first))
    told_later = _shares(
        _believe("At the corner turn left. At the T turn left.", second)
    )
    wrong = told_first[first.exit(1, 0, SOUTH)]
    assert wrong > told_later[second.exit(1, 1, EAST)] > 0


def test_a_turn_that_is_not_there_is_left_out_in_the_end() -> None:
    cells: dict[Cell, Sequence[float]] = {
        (0, 0): (EAST,),
        (1, 0): (NORTH, WEST),
        (1, 1): (NORTH, SOUTH),
        (1, 2): (SOUTH,),
    }
    grid = Grid(cells).walk(*cells)
    plan = parse_route_description("Turn right, then turn left. The clock is there.")
    belief = _believe(plan, grid)
    done = [visit for visit in belief.visits if visit.segment.leg == 2]
    assert any("no such turn" in _kinds(visit.segment) for visit in done)


def test_a_turn_that_its_reader_doubts_may_be_none_without_an_error() -> None:
    cells: dict[Cell, Sequence[float]] = {(0, 0): (EAST,), (1, 0): (NORTH, EAST, WEST)}
    grid = Grid(cells).walk(*cells)

    def straight_on(unclear: float) -> tuple[float, float]:
        legs = (Leg(Turn("left"), unclear=unclear),)
        belief = _believe(RoutePlan(legs=legs, arrival=Arrival(("clock",))), grid)
        key = grid.exit(1, 0, EAST)
        ahead = belief.frontiers[key].alignments
        done = [
            each.segment for each in ahead if each.segment.leg and not each.segment.lost
        ]
        assert any("no such turn" in _kinds(each) for each in done) == (not unclear)
        return _shares(belief)[key], sum(float(each.weights[0].sum()) for each in done)

    (sure, right), (doubted, no_error) = straight_on(0.0), straight_on(0.5)
    assert sure < 0.4 < doubted
    assert right == 0.0 < no_error


def _kinds(segment: Segment) -> set[str]:
    return {slip.kind for slip in segment.slips}


def test_the_way_may_have_begun_in_the_other_direction() -> None:
    cells: dict[Cell, Sequence[float]] = {(0, 0): (EAST, WEST), (1, 0): (WEST,)}
    grid = Grid(cells).walk(*cells)
    belief = _believe("Go straight on and take the second left.", grid)
    assert _best(belief) == grid.exit(0, 0, WEST)
    assert "wrong start" in _kinds(belief.frontiers[_best(belief)].best)


# -- what is seen late


def test_a_thing_seen_late_tells_which_turn_was_meant() -> None:
    text = "Turn left. Pass the clock and take the first right."
    cells: dict[Cell, Sequence[float]] = {(0, 0): (EAST,)}
    cells |= {(x, y): ALL_SIDES for x in (1, 2) for y in (0, 1)}
    asked = frozenset({"clock"})
    grid = Grid(cells).walk((0, 0), (1, 0), (2, 0), asked=asked)
    grid.walk((1, 0), (1, 1), asked=asked).walk((2, 0), (2, 1), asked=asked)
    first, second = grid.exit(1, 1, EAST), grid.exit(2, 1, EAST)
    before = _shares(_believe(text, grid))
    grid.see("clock", 2, 0.5)
    after = _shares(_believe(text, grid))
    assert after[second] / after[first] > 3 * before[second] / before[first]


def test_a_thing_in_sight_ahead_speaks_for_going_on_to_it() -> None:
    text = "Turn left at the clock. Walk to the piano."
    grid = _hall(2)
    on, side = grid.exit(2, 0, EAST), grid.exit(2, 0, NORTH)
    before = _shares(_believe(text, grid))
    grid.see("clock", 2.6, 0, by=(2, 0))
    after = _shares(_believe(text, grid))
    assert after[on] / after[side] > 3 * before[on] / before[side]


def test_what_was_seen_from_another_way_is_not_in_sight_along_this_one() -> None:
    text = "Turn left at the clock. Walk to the piano."
    grid = _hall(2)
    on = grid.exit(2, 0, EAST)
    before = _shares(_believe(text, grid))[on]
    grid.see("clock", 2.6, 0, by=(2, 2))
    assert _shares(_believe(text, grid))[on] == pytest.approx(before, rel=0.01)


@pytest.mark.parametrize(("told", "turns"), [("brick", True), ("grass", False)])
def test_a_turn_is_where_the_floor_told_of_it_is(told: str, turns: bool) -> None:
    grid = _hall(2)
    for side in (NORTH, SOUTH):
        grid.look(2, 0, side, "brick floor")
    left = grid.exit(2, 0, NORTH)
    before = _shares(_believe("Turn left.", grid))[left]
    after = _shares(_believe(f"Turn left at the {told} floor.", grid))[left]
    assert (after > before) == turns


def test_a_way_of_which_no_length_was_told_gets_unlikely_as_it_gets_long() -> None:
    assert untold_length(MODEL, 20.0) == 1.0
    assert 1.0 > untold_length(MODEL, 40.0) > untold_length(MODEL, 80.0) > 0.0


def test_a_length_that_proves_wrong_speaks_against_the_turns_before_it() -> None:
    text = "Turn left. Walk 10 metres and turn right."
    cells: dict[Cell, Sequence[float]] = {(0, 0): (EAST,)}
    cells |= {(1, 0): ALL_SIDES, (2, 0): ALL_SIDES, (2, 1): ALL_SIDES}
    cells |= {(1, y): (NORTH, SOUTH) for y in range(1, 6)}
    up = [(1, y) for y in range(6)]
    hall = Grid(cells).walk((0, 0), (1, 0), (2, 0)).walk((2, 0), (2, 1))
    second = hall.exit(2, 1, EAST)
    before = _shares(_believe(text, hall))[second]
    hall.walk(*up)
    assert _shares(_believe(text, hall))[second] > before


# -- signs


def test_a_sign_that_points_speaks_for_its_way() -> None:
    grid = _hall(1)
    plan = RoutePlan(arrival=Arrival(("library",)))
    belief = _believe(plan, grid)
    before = _shares(belief)
    belief.pointers = {grid.at(1, 0): [NORTH]}
    belief.update(starts_ahead(MODEL, grid.floor, 0))
    after = _shares(belief)
    north, south = grid.exit(1, 0, NORTH), grid.exit(1, 0, SOUTH)
    assert after[north] > before[north]
    assert after[north] / after[south] > before[north] / before[south]


# -- no explosion


class CountedStretches(dict[tuple[int, int], Stretch]):
    """Stretches that count how often one is looked up."""

    looked_up = 0

    def get(self, key: tuple[int, int], default: object = None) -> Stretch | None:  # type: ignore[override]
        self.looked_up += 1
        return super().get(key)


def _town(size: int) -> Grid:
    """Return a grid of streets of which all between crossings were walked."""
    cells: dict[Cell, Sequence[float]] = {
        (x, y): ALL_SIDES for x in range(size) for y in range(size)
    }
    grid = Grid(cells)
    for k in range(size):
        grid.walk(*((x, k) for x in range(size)))
        grid.walk(*((k, y) for y in range(size)))
    return grid


def test_a_long_plan_in_a_grid_of_streets_is_weighed_in_bounded_work() -> None:
    grid = _town(5)
    grid.floor.stretches = counted = CountedStretches(grid.floor.stretches)
    plan = RoutePlan(legs=_zigzag(10))
    at, exit = grid.exit(0, 0, NORTH)
    belief = _believe(plan, grid, [AssumedStart(at, NORTH, exit, 1.0)])
    assert belief.frontiers
    assert counted.looked_up < 25 * MOST_ALIGNMENTS


def test_many_turns_on_one_spot_are_weighed_in_bounded_work(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    turn, turned = Belief._turn, 0

    def counted(*given: Any) -> None:
        nonlocal turned
        turned += 1
        turn(*given)

    monkeypatch.setattr(Belief, "_turn", counted)
    ahead = (Mention("clock", place="target", side="ahead"),)
    spin = Leg(Turn("either"), on_the_spot=True, mentions=ahead)
    _believe(RoutePlan(legs=(spin,) * 8), _hall(2))
    assert turned < 25 * MOST_ALIGNMENTS


def _zigzag(legs: int) -> tuple[Leg, ...]:
    return tuple(Leg(Turn("left" if n % 2 else "right")) for n in range(legs))


def test_a_way_in_a_circle_ends() -> None:
    corners: dict[Cell, Sequence[float]] = {
        (0, 0): (EAST, NORTH),
        (1, 0): (NORTH, WEST),
        (1, 1): (SOUTH, WEST),
        (0, 1): (SOUTH, EAST),
    }
    grid = Grid(corners).walk(*corners, (0, 0))
    plan = "Take the ninth left. Then turn right."
    belief = _believe(
        plan, grid, [AssumedStart(0, EAST, grid.exit(0, 0, EAST)[1], 1.0)]
    )
    assert not belief.frontiers
    lines = [visit.segment.line for visit in belief.visits]
    assert all(len(set(line)) >= len(line) - 1 for line in lines)


def _on_floors(**cells: Sequence[float]) -> Grid:
    """Walk a hall and see pieces of floor along it, at places in cells."""
    grid = _hall(2)
    grid.walk((0, 0), (1, 0), (2, 0), asked=frozenset({ANY_FLOOR, "brick floor"}))
    places = [(name, x) for name, xs in cells.items() for x in xs]
    for track, (name, x) in enumerate(places):
        for phrase in (ANY_FLOOR, f"{name} floor"):
            here = (STRETCH * x, 0.0)
            grid.floor.note(
                Sighting(phrase, phrase, 1.0, here, here, 1.9, track, (0, 0), "ahead")
            )
    return grid


def _odds_of_the_second_left(grid: Grid) -> float:
    brick = Mention("brick floor", place="along", kind="floor")
    plan = RoutePlan(legs=(Leg(Turn("left"), mentions=(brick,)),))
    shares = _shares(_believe(plan, grid))
    return shares[grid.exit(2, 0, NORTH)] / shares[grid.exit(1, 0, NORTH)]


def test_the_floor_told_of_a_leg_is_one_that_was_walked_on() -> None:
    on_both = _odds_of_the_second_left(_on_floors(brick=(0.5, 1.5), grass=(2.1, 2.4)))
    on_second = _odds_of_the_second_left(_on_floors(brick=(1.5,), grass=(0.5, 2.1)))
    assert on_second > 1.5 * on_both


def test_a_covering_that_is_nearly_everywhere_tells_less() -> None:
    rare = _odds_of_the_second_left(_on_floors(brick=(1.5,), grass=(0.5, 2.1, 2.4)))
    usual = _odds_of_the_second_left(_on_floors(brick=(1.5,)))
    assert usual < rare


def test_a_floor_that_may_be_the_one_told_tells_nothing() -> None:
    grid = _on_floors(brick=(0.5, 1.5), grass=(2.1,))
    before = _odds_of_the_second_left(grid)
    unsure = _on_floors(grass=(0.5, 1.5, 2.1))
    unsure.floor.note(
        Sighting(
            "brick floor",
            "floor",
            0.75,
            (5.0, 0.0),
            (5.0, 0.0),
            1.9,
            0,
            (0, 0),
            "ahead",
        )
    )
    assert _odds_of_the_second_left(unsure) == pytest.approx(before, rel=0.01)
