"""Instruction and Episode records; reading files lives in `corpus.py`."""

from dataclasses import dataclass, field
from typing import Literal

from memorymaze.geometry.pose import Pose

WRITTEN_BY = {
    "human": "people",
    "llm": "a LANGUAGE MODEL, not by people",
    "synthetic": "a program (synthetic), not by people",
}
"""Who wrote an instruction, by its source, as it is said wherever results are shown."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A significant error in an instruction."""

    kind: str
    """Such as `missing_turn`, `extra_turn`, `wrong_destination`."""
    where: str
    """Turning point id or place."""
    detail: str


@dataclass(frozen=True, slots=True)
class Span:
    """Labelled words of an instruction."""

    kind: str
    """Of an error, or of a surface mark such as `filler`."""
    start: int
    """Character of the text."""
    end: int
    """Character after the last one; `start` where words are missing."""
    where: str
    """Turning point id or place; empty for surface marks."""
    detail: str


@dataclass(frozen=True, slots=True)
class Followers:
    """How people fared who followed an instruction themselves."""

    usable: bool
    """Whether its corpus knows a legal path that the instruction tells."""
    tried: int | None
    """None where the corpus does not tell."""
    arrived: int | None
    """Of these those who reached the goal."""


@dataclass(frozen=True, slots=True)
class Instruction:
    """One person's description of a way, and what is known about it."""

    id: str
    site: str
    route: str
    """`R1`, `R2`, …"""
    study: Literal["online", "onsite", "sail"]
    iteration: Literal[1, 2]
    participant: str
    text: str
    reference_route: str
    """Route id in the site plan of the way described."""
    failures: tuple[Failure, ...]
    """Empty when the instruction is right."""
    source: Literal["human", "llm", "synthetic"]
    language: str
    split: str
    """`dev` (prompts may be built from it) or `test`."""
    original_text: str | None = None
    """What was said before translation or editing."""
    followers: Followers | None = None
    """None where nobody is known to have followed it."""
    pair: str | None = None
    """Shared by a text with errors and the same text without; None where it has no
    counterpart."""
    spans: tuple[Span, ...] = ()
    """Words that are labelled; in the text without errors where its counterpart errs."""
    method: Literal["told", "retold", "edited"] | None = None
    """How it was made: from a route, from a route in place of a person's text, or by
    editing that text; None where no generator made it."""
    origin: str = field(default="", compare=False)
    """`file:line` it was read from, for messages; empty when made in memory."""


@dataclass(frozen=True, slots=True)
class Episode:
    """One task: follow an instruction from a start pose; scored against a route."""

    id: str
    instruction: Instruction
    start: Pose
    goal: tuple[float, float]
    """Metres."""
    reference_path: tuple[tuple[float, float], ...]
    """Vertices of the route's middle line, metres."""
