"""Instructions, episodes and corpora as records; nothing here reads a file.

What the types of an instruction's fields allow is checked where files are read.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, Strict

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.input_files import writable
from memorymaze.world.sites.records import Site


def _said(text: str) -> str:
    if not text.strip():
        raise ValueError("expected a text that is not empty")
    return writable(text)


def _whole(value: object) -> object:
    """Refuse `true` and `1.0`, which compare equal to 1."""
    if type(value) is not int:
        raise ValueError("expected a whole number")
    return value


def _small_letters(name: str) -> str:
    if not re.fullmatch(r"[a-z0-9_]+", name):
        raise ValueError("expected a name in small letters such as 'dev' or 'test'")
    return name


StudyName = Literal["online", "memory", "onsite", "sail"]
Text = Annotated[str, Strict(), AfterValidator(_said)]
_AnyText = Annotated[str, Strict(), AfterValidator(writable)]
_Count = Annotated[int, Strict(), Field(ge=0)]

WRITTEN_BY = {
    "human": "people",
    "llm": "a LANGUAGE MODEL, not by people",
    "synthetic": "a program (synthetic), not by people",
}
"""Who wrote an instruction, by its source, as it is said wherever results are shown."""

DEVELOPED, HELD_OUT = "developed", "held_out"
"""Splits of the participants whose texts were read while the agents were developed,
and of the others; also those of `dev` and `test`, which say where prompts come from."""


def was_developed_on(participant: str) -> bool:
    """Return whether a participant's texts were read while the agents were developed.

    They are those with an even SHA-256, of the shipped corpus and of SAIL.
    """
    return sha256(participant.encode()).digest()[-1] % 2 == 0


def is_of_split(instruction: "Instruction", split: str) -> bool:
    """Return whether an instruction is of a split: its own, or one of the halves."""
    if split in {DEVELOPED, HELD_OUT}:
        return was_developed_on(instruction.participant) == (split == DEVELOPED)
    return instruction.split == split


@dataclass(frozen=True, slots=True)
class Failure:
    """A significant error in an instruction."""

    kind: Text
    """Such as `missing_turn`, `extra_turn`, `wrong_destination`."""
    where: _AnyText
    """Turning point id or place."""
    detail: _AnyText


@dataclass(frozen=True, slots=True)
class Span:
    """Labelled words of an instruction."""

    kind: Text
    """Of an error, or of a surface mark such as `filler`."""
    start: _Count
    """Character of the text."""
    end: _Count
    """Character after the last one; `start` where words are missing."""
    where: _AnyText = ""
    """Turning point id or place; empty for surface marks."""
    detail: _AnyText = ""


@dataclass(frozen=True, slots=True)
class Followers:
    """How people fared who followed an instruction themselves."""

    usable: Annotated[bool, Strict()]
    """Whether its corpus knows a legal path that the instruction tells."""
    tried: _Count | None
    """None where the corpus does not tell."""
    arrived: _Count | None
    """Of these those who reached the goal."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Instruction:
    """One person's description of a way, and what is known about it.

    Only `site`, `route` and `text` are needed; the rest has a default.
    """

    id: Text = ""
    """Empty until it is read from a file or becomes an episode."""
    site: Text
    route: Text
    """`R1`, `R2`, …"""
    study: StudyName = "online"
    """`online`: typed while a walkthrough can be watched; `memory`: typed after it;
    `onsite`: spoken."""
    iteration: Annotated[Literal[1, 2], BeforeValidator(_whole)] = 1
    participant: Text = ""
    """Who said it; as `id` where nothing is said."""
    text: Text
    reference_route: Text = ""
    """Route id in the site plan of the way described; empty for the reference route,
    until the instruction becomes an episode."""
    failures: tuple[Failure, ...] = ()
    """Empty when the instruction is right."""
    source: Literal["human", "llm", "synthetic"] = "human"
    language: Text = "en"
    split: Annotated[str, AfterValidator(_small_letters)] = "test"
    """`dev` (prompts may be built from it) or `test`."""
    original_text: _AnyText | None = None
    """What was said before translation or editing."""
    followers: Followers | None = None
    """None where nobody is known to have followed it."""
    pair: Text | None = None
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
    tellings: tuple[Instruction, ...] = ()
    """The first and the second telling, where the instruction is both; else empty."""


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
    was_half_read: bool = False
    """Whether half of its participants were read while the agents were developed."""

    @property
    def instructions(self) -> tuple[Instruction, ...]:
        """What is followed, each once, in order."""
        by_id = {each.instruction.id: each.instruction for each in self.episodes}
        return tuple(by_id.values())

    def of_split(self, split: str | None) -> tuple[Episode, ...]:
        """Return the episodes of a split, such as `test` or `held_out`; all for None.

        Raises:
            SettingsError: None is of this split; says which there are.
        """
        if split is None:
            return self.episodes
        known = sorted({each.instruction.split for each in self.episodes})
        known += [DEVELOPED, HELD_OUT] if self.was_half_read else []
        kept = [each for each in self.episodes if is_of_split(each.instruction, split)]
        if split not in known or not kept:
            raise SettingsError(
                f"split: expected one of {', '.join(known)}, got {split!r}"
                f"{did_you_mean(split, known)}"
            )
        return tuple(kept)

    def __repr__(self) -> str:
        """Return name and size."""
        return (
            f"Corpus({self.name!r}: {len(self.instructions)} instructions, "
            f"{len(self.episodes)} episodes on {', '.join(self.sites)})"
        )
