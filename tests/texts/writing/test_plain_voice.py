"""What the plain voice tells of a canonical plan is read back as that plan."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.texts.writing.canonical_plans import why_not_canonical
from tests.texts.writing.plain_voice import tell_plainly

from memorymaze.basics.errors import PlanFileError
from memorymaze.language.plans import (
    Arrival,
    Kind,
    Leg,
    Length,
    Mention,
    Passing,
    Place,
    RoutePlan,
    Side,
    Start,
    Totals,
    Turn,
)
from memorymaze.language.reading import parse_route_description

THINGS: dict[str, Kind] = {
    "red sofa": "object",
    "clock": "object",
    "blue bench": "object",
    "vending machine": "object",
    "piano": "object",
    "fish tank": "object",
    "statue": "object",
    "telescope": "object",
    "drinking fountain": "object",
    "world map": "object",
    "trophy case": "object",
    "copier": "object",
    "yellow poster": "object",
    "sign that says library": "sign",
    "glass door": "door",
    "wooden door": "door",
    "kitchen": "place",
    "lobby": "place",
    "meeting room": "place",
    "bridge": "place",
}
DESTINATIONS = ("library", "space station", "conference room", "robot", "copy shop")
SIDES: tuple[Side | None, ...] = (None, "left", "right")
AT_THE_TURN: tuple[Place, ...] = (
    "turn",
    "beside",
    "before_turn",
    "after_turn",
    "opposite",
)

lengths = st.one_of(
    st.none(),
    st.integers(1, 600).map(lambda n: Length(n / 10, "metres")),
    st.integers(1, 90).map(lambda n: Length(n * 0.7, "steps")),
    st.integers(1, 90).map(lambda n: Length(n * 1.0, "time")),
    st.integers(1, 6).map(lambda n: Length(n * 8.0, "places", float(n))),
    st.sampled_from([4.0, 6.0, 12.0, 25.0]).map(lambda m: Length(m, "vague")),
)


def _passing(count: int | None, side: Side | None) -> Passing:
    assert side in {None, "left", "right"}
    return Passing(count, side, "opening" if count == 1 else "openings")  # type: ignore[arg-type]


passings = st.lists(
    st.builds(_passing, st.none() | st.integers(1, 9), st.sampled_from(SIDES)),
    max_size=1,
).map(tuple)


@st.composite
def canonical_plans(draw: Callable[..., object]) -> RoutePlan:
    """Draw canonical plans of up to five legs."""

    def some(strategy: st.SearchStrategy[object]) -> object:
        return draw(strategy)

    names = list(some(st.permutations(list(THINGS))))  # type: ignore[call-overload]

    def chance(percent: int) -> bool:
        return some(st.integers(0, 99)) < percent  # type: ignore[operator]

    def one_of(*values: object) -> object:
        return some(st.sampled_from(values))

    def thing(place: Place, *sides: Side | None, **more: object) -> Mention:
        name = names.pop()
        nth = one_of(2, 3) if chance(10) and sides != (None,) else None
        return Mention(name, THINGS[name], place, one_of(*sides), nth=nth, **more)  # type: ignore[arg-type]

    def on_the_way() -> list[Mention]:
        found: list[Mention] = []
        if chance(25):
            found.append(thing("passed", *SIDES))
        if chance(25):
            found.append(thing("along", *SIDES, "ahead"))
        if chance(10):
            found.append(thing("passed", None, ignored=True))
        return found

    legs: list[Leg] = []
    for number in range(some(st.integers(0, 5))):  # type: ignore[call-overload]
        if len(names) < 11:
            break
        spot = not number and chance(15)
        mentions = [] if spot else on_the_way()
        if not spot and chance(40):
            mentions.append(thing(one_of(*AT_THE_TURN), *SIDES))  # type: ignore[arg-type]
        way = one_of(
            "left", "right", "left", "right", "slight_left", "either", "around"
        )
        plain = way in {"left", "right"}
        forced = not spot and (plain or way == "either") and chance(10)
        counted = plain and not forced and not spot and chance(30)
        ordinal = one_of(1, 2, 3, 6, -1) if counted else None
        open_ = ordinal in {1, 2} and chance(20)
        before = [each.phrase for each in mentions if each.place == "before_turn"]
        if way != "around" and chance(15):
            mentions.append(thing("target", None))
        junction = one_of("t", "crossing", "corner") if chance(15) else None
        turn = Turn(
            way,  # type: ignore[arg-type]
            ordinal=ordinal,  # type: ignore[arg-type]
            or_ordinal=ordinal + 1 if open_ else None,  # type: ignore[operator]
            counted_after=before[-1] if before and counted else None,
            at_end=not spot and (junction == "t" or chance(15)),
            junction=None if spot else junction,  # type: ignore[arg-type]
            immediate=bool(number) and plain and not forced and chance(10),
            forced=forced,
            doubt=one_of(0.0, 0.0, 0.0, 0.4, 0.7),  # type: ignore[arg-type]
        )
        legs.append(
            Leg(
                turn,
                on_the_spot=spot,
                length=None if spot else some(lengths),  # type: ignore[arg-type]
                mentions=tuple(mentions),
                passings=() if spot else some(passings),  # type: ignore[arg-type]
                too_far=tuple(names.pop() for _ in range(int(chance(15)))),
                wrong_way=tuple(names.pop() for _ in range(int(chance(10)))),
            )
        )
    far = lengths.filter(lambda each: each is None or each.unit != "places")
    arrival = Arrival(
        (one_of(*DESTINATIONS),),  # type: ignore[arg-type]
        side=one_of("left", "right", "ahead"),  # type: ignore[arg-type]
        nth=one_of(None, None, 2, 3),  # type: ignore[arg-type]
        at_end=chance(20),
        length=some(far),  # type: ignore[arg-type]
        mentions=tuple(replace(each, nth=None) for each in on_the_way()),
        passings=some(passings),  # type: ignore[arg-type]
    )
    return RoutePlan(
        start=Start(from_="lifts" if chance(15) else None),
        legs=tuple(legs),
        arrival=arrival,
        totals=Totals(
            one_of(3, 6) if chance(10) else None,  # type: ignore[arg-type]
            one_of(40.0, 85.0) if chance(10) else None,  # type: ignore[arg-type]
        ),
    )


@pytest.mark.proof
@given(canonical_plans())
def test_a_canonical_plan_told_plainly_is_read_back_whole(plan: RoutePlan) -> None:
    assert why_not_canonical(plan) is None
    assert parse_route_description(tell_plainly(plan)) == plan


@pytest.mark.parametrize(
    ("plan", "problem"),
    [
        pytest.param(RoutePlan(), "arrival: there is not one", id="no destination"),
        pytest.param(
            RoutePlan(legs=(Leg(Turn("around", ordinal=2)),)),
            "legs.0: a turn is counted",
            id="a second turning back",
        ),
        pytest.param(
            RoutePlan(arrival=Arrival(("Room 12",), side="left")),
            "'Room 12' is no plain name",
            id="a name with a number",
        ),
    ],
)
def test_a_plan_that_is_not_canonical_is_not_told(
    plan: RoutePlan, problem: str
) -> None:
    with pytest.raises(PlanFileError, match=problem):
        tell_plainly(plan)
