"""What a belief is made of: ways to begin, alignments, and where they lead."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from memorymaze.agents.guide.likelihoods import Weights
from memorymaze.agents.walking.floor_map import Point, Stretch


class AssumedStart(NamedTuple):
    """A way to begin."""

    at: int
    """Crossing."""
    heading: float
    exit: int
    """-1 where one has still to choose."""
    chance: float
    walked: float = 0.0
    """Metres of the first way that one needs not walk; negative."""


@dataclass(frozen=True, slots=True)
class Slip:
    """Something told that an alignment takes for an error."""

    kind: str
    leg: int
    """Number of the leg, from 0; as many as the plan has for the arrival."""
    at: int
    """Crossing."""


class Segment(NamedTuple):
    """An alignment that has walked some way since the last turn of the plan."""

    at: int
    heading: float
    leg: int
    """Legs done; as many as the plan has when only the arrival is left."""
    weights: Weights
    walked: float = 0.0
    """Metres since the last turn."""
    left: int = 0
    """Openings passed on the left since then."""
    right: int = 0
    junctions: int = 0
    """Places passed since then where one has to choose."""
    openings: tuple[tuple[int, bool, bool, bool], ...] = ()
    """Of each place passed since then: its number in the line, and whether there are
    openings on the left, on the right, and a choice."""
    line: tuple[Point, ...] = ()
    """Corners of the walk since then."""
    passed: tuple[int, ...] = ()
    """Crossings since then, the present one included."""
    asked: frozenset[str] | None = None
    """What was looked for all along since then; None before the first stretch."""
    story: tuple[str, ...] = ()
    """What it takes for the turns, in words; of the heaviest alignment."""
    slips: tuple[Slip, ...] = ()
    """The errors it believes in; of the heaviest alignment."""
    lost: bool = False
    """It goes by nothing that was told of the way."""
    turns: tuple[tuple[int, int], ...] = ()
    """Leg and crossing of each turn; of the heaviest alignment."""
    telling: int = 0
    """Number of the telling that it is an alignment of."""

    @property
    def places(self) -> int:
        """Places where one can turn that were come to since the last turn."""
        return len(self.line) - 1


def mass_of(weights: Weights) -> float:
    """Sum over all speakers; asked too often for the detour that `weights.sum()` takes."""
    return float(np.add.reduce(weights, axis=None))


def summed(segments: list[Segment]) -> list[Segment]:
    """Sum the alignments of a way out that differ in nothing but how they came there."""
    begun = [each for each in segments if not each.walked]
    others = [each for each in segments if each.walked]
    if len(begun) < 2:
        return segments
    heaviest = max(begun, key=lambda each: mass_of(each.weights))
    weights = np.sum([each.weights for each in begun], axis=0)
    return [heaviest._replace(weights=weights), *others]


class Leading(NamedTuple):
    """An alignment that leads into a way, with what its present leg has still to expect."""

    segment: Segment
    weights: Weights
    mass: float


@dataclass
class Frontier:
    """A way out that was not walked yet, and all alignments that lead into it."""

    at: int
    exit: int
    alignments: list[Leading] = field(default_factory=list[Leading])
    mass: float = 0.0
    """How much of the belief goes that way, unnormalised."""

    def add(self, segment: Segment, weights: Weights) -> None:
        """Let an alignment lead into the way."""
        mass = mass_of(weights)
        self.alignments.append(Leading(segment, weights, mass))
        self.mass += mass

    @property
    def best(self) -> Segment:
        """The heaviest alignment."""
        return max(self.alignments, key=lambda each: each.mass).segment


@dataclass(frozen=True, slots=True)
class Visit:
    """An alignment with all legs done that passes, or comes to, places to arrive at."""

    segment: Segment
    """As it was where the stretch begins, or at the crossing."""
    stretch: Stretch | None
    """Walked after it; None at the crossing itself."""
