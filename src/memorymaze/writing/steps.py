"""A description of a way as typed steps, before it is put into words.

A plan can be walked (`following.py`), made wrong (`mistakes.py`) and told
(`telling.py`).
"""

from dataclasses import dataclass, replace
from typing import Literal

from memorymaze.writing.things import Thing
from memorymaze.writing.turning_point_graph import Side


@dataclass(frozen=True, slots=True)
class Passing:
    """Something beside the way."""

    thing: Thing
    side: str
    """`left` or `right` of the walker."""
    after: float
    """Metres since the leg began."""


@dataclass(frozen=True, slots=True)
class Leg:
    """What is true of the stretch before a turn or the destination."""

    length: float
    """Metres."""
    passing: tuple[Passing, ...] = ()
    """In the order they come."""
    openings: tuple[str, ...] = ()
    """Sides of the ways that one passes and does not take."""
    floor: str | None = None
    """Material underfoot where most of the stretch lies."""
    name: str | None = None
    """What people call it."""
    beyond: Thing | None = None
    """What one reaches who walks on at its end."""


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
    proper: bool = False
    """Whether the thing takes no article."""


@dataclass(frozen=True, slots=True)
class Turn:
    """One turn that is told."""

    key: str
    """Names the step in the clean and the wrong plan."""
    side: Side
    cue: Cue
    leg: Leg
    at: str
    """Turning point where the route turns; for an extra turn, where it is told."""
    told: bool = True
    """False for a forced corner that is left to the listener."""
    extra: bool = False
    """Whether the route does not turn there."""


@dataclass(frozen=True, slots=True)
class Arrival:
    """How the way ends."""

    goal: str
    """The destination in everyday words."""
    place: tuple[float, float]
    """Where the speaker says it is, metres."""
    leg: Leg
    side: str | None
    """`left` or `right` of who arrives; None for ahead."""
    beside: Thing | None = None
    """What it is said to be at."""
    claimed: str | None = None
    """The door or thing that the speaker wrongly takes for it."""


@dataclass(frozen=True, slots=True)
class StepPlan:
    """A whole description of one route."""

    site: str
    route_id: str
    turns: tuple[Turn, ...]
    arrival: Arrival
    around: bool = False
    """Whether the speaker first sends the listener back the other way."""

    def with_turn(self, key: str, **changes: object) -> "StepPlan":
        """Return the plan with one turn changed."""
        turns = tuple(
            replace(turn, **changes) if turn.key == key else turn  # type: ignore[arg-type]
            for turn in self.turns
        )
        return replace(self, turns=turns)

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
