"""A description of a way as steps on a site, before it is put into words.

A step says what a speaker says in the records of `memorymaze.language.plans` (`Step.leg`) and
where on the site that is meant. Plans can be followed (`following.py`), made wrong
(`mistakes.py`) and told (`telling.py`).
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from memorymaze.language.plans import (
    Arrival,
    Leg,
    Length,
    Mention,
    Passing,
    RoutePlan,
    Turn,
)
from memorymaze.texts.writing.things import Thing
from memorymaze.texts.writing.turning_point_graph import TurnSide

SIDES: tuple[Literal["left", "right"], ...] = ("left", "right")


@dataclass(frozen=True, slots=True)
class Beside:
    """Something beside the way."""

    thing: Thing
    side: Literal["left", "right"]
    """Of the walker."""
    after: float
    """Metres since the stretch began."""


@dataclass(frozen=True, slots=True)
class ToldStretch:
    """What is true of the stretch before a turn or the destination."""

    length: float
    """Metres."""
    beside: tuple[Beside, ...] = ()
    """In the order they come."""
    openings: tuple[Literal["left", "right"], ...] = ()
    """Sides of the ways that one passes and does not take."""
    floor: str | None = None
    """Material underfoot where most of the stretch lies."""
    name: str | None = None
    """What people call it."""
    beyond: Thing | None = None
    """What one reaches who walks on at its end."""

    @property
    def said_length(self) -> Length | None:
        """How far it is."""
        return Length(self.length, "metres") if self.length else None

    @property
    def mentions(self) -> Iterator[Mention]:
        """The floor, the name and the things on it."""
        if self.floor is not None:
            yield Mention(f"{self.floor} floor", "floor", "along")
        if self.name is not None:
            yield Mention(self.name, "place", "along")
        for each in self.beside:
            thing = each.thing
            yield Mention(
                thing.words,
                thing.kind,
                "passed",
                side=each.side,
                after_metres=each.after,
            )

    @property
    def passings(self) -> tuple[Passing, ...]:
        """The openings that one leaves alone."""
        return tuple(Passing(1, side, "opening") for side in self.openings)


@dataclass(frozen=True, slots=True)
class Cue:
    """How a speaker says where to turn."""

    kind: Literal["ordinal", "end", "thing", "forced"]
    """The n-th way on that side; where it goes no further; where a thing is; or where
    there is no other way."""
    ordinal: int = 1
    """Counted from the last turn told, for `ordinal`."""
    words: str = ""
    """The thing without article, for `thing`."""


@dataclass(frozen=True, slots=True)
class Step:
    """One turn that is told."""

    key: str
    """Names the step in the clean and the wrong plan."""
    side: TurnSide
    cue: Cue
    stretch: ToldStretch
    at: str
    """Turning point where the route turns; for an extra turn, where it is told."""
    told: bool = True
    """False for a forced corner that is left to the listener."""
    extra: bool = False
    """Whether the route does not turn there."""

    @property
    def leg(self) -> Leg:
        """What there is to say of it."""
        cue, stretch = self.cue, self.stretch
        thing = [Mention(cue.words, "object", "turn")] if cue.kind == "thing" else []
        return Leg(
            Turn(
                self.side,
                ordinal=cue.ordinal if cue.kind == "ordinal" else None,
                at_end=cue.kind == "end",
                junction="corner" if cue.kind == "forced" else None,
                forced=cue.kind == "forced",
            ),
            length=stretch.said_length,
            mentions=(*stretch.mentions, *thing),
            passings=stretch.passings,
            too_far=(stretch.beyond.words,) if stretch.beyond else (),
        )


@dataclass(frozen=True, slots=True)
class ToldEnding:
    """How the way ends."""

    goal: str
    """The destination in everyday words."""
    place: tuple[float, float]
    """Where the speaker says it is, metres."""
    stretch: ToldStretch
    side: Literal["left", "right"] | None
    """Of who arrives; None for ahead."""
    by: Thing | None = None
    """What it is said to be at."""
    nth: int | None = None
    """Which of the doors of that name on the last stretch; None for the only one, or the
    first."""
    claimed: str | None = None
    """The door or thing that the speaker wrongly takes for it."""

    @property
    def arrival(self) -> Arrival:
        """What there is to say of it."""
        by = [Mention(self.by.words, self.by.kind, "beside")] if self.by else []
        return Arrival(
            destinations=(self.goal,),
            side=self.side or "ahead",
            nth=self.nth,
            length=self.stretch.said_length,
            mentions=(*self.stretch.mentions, *by),
            passings=self.stretch.passings,
        )


@dataclass(frozen=True, slots=True)
class StepPlan:
    """A whole description of one route."""

    turns: tuple[Step, ...]
    ending: ToldEnding
    things: Mapping[str, Thing] = field(compare=False, repr=False)
    """The things of the site by their words."""
    around: bool = False
    """Whether the speaker first sends the listener back the other way."""

    @property
    def said(self) -> RoutePlan:
        """What there is to say of it, in the order of the walk."""
        back = [Leg(Turn("around"), on_the_spot=True)] if self.around else []
        legs = (step.leg for step in self.turns if step.told)
        return RoutePlan(legs=(*back, *legs), arrival=self.ending.arrival)

    def with_turn(self, key: str, **changes: object) -> "StepPlan":
        """Return the plan with one turn changed."""
        turns = tuple(
            replace(turn, **changes) if turn.key == key else turn  # type: ignore[arg-type]
            for turn in self.turns
        )
        return replace(self, turns=turns)

    def with_another(self, turn: Step, place: int) -> "StepPlan":
        """Return the plan with one turn more, before the one at a place."""
        return replace(self, turns=(*self.turns[:place], turn, *self.turns[place:]))

    def without(self, key: str) -> "StepPlan":
        """Return the plan without one turn."""
        return replace(self, turns=tuple(t for t in self.turns if t.key != key))


@dataclass(frozen=True, slots=True)
class Mistake:
    """One significant error in a plan."""

    kind: str
    key: str
    """The step it is in: a turn's key, `start` or `arrival`."""
    part: str
    """What of the step is wrong: `side`, `cue`, `step`, or `gone` for a step that is
    missing."""
    where: str
    """Turning point id or place."""
    detail: str
    plan: StepPlan
    """The plan with this error."""
