"""Instructions, episodes and corpora as records; nothing here reads a file."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from memorymaze.geometry.pose import Pose
from memorymaze.sites.records import Site

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


@dataclass(frozen=True, slots=True, repr=False)
class Corpus:
    """Episodes, the sites they take place on, and the limits that belong to them.

    A limit of None leaves it to the run.
    """

    name: str
    """Such as `memorymaze` or `SAIL`."""
    episodes: tuple[Episode, ...]
    sites: Mapping[str, Site]
    """By name; there may be more than episodes take place on."""
    files: tuple[Path, ...]
    """What the instructions were read from."""
    success_distance: float | None = None
    """Metres from the goal within which one has arrived."""
    time_budget: float | None = None
    """Simulated seconds per episode."""
    detection_range: float | None = None
    """Metres within which things are detected."""
    start_heading_is_told: bool = True
    """Whether a text may build on the way one faces at the start; False where each is
    followed from several headings."""

    @property
    def instructions(self) -> tuple[Instruction, ...]:
        """What is followed, each once, in order."""
        by_id = {each.instruction.id: each.instruction for each in self.episodes}
        return tuple(by_id.values())

    def __repr__(self) -> str:
        """Return name and size."""
        return (
            f"Corpus({self.name!r}: {len(self.instructions)} instructions, "
            f"{len(self.episodes)} episodes on {', '.join(self.sites)})"
        )
