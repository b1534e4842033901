"""Who speaks: the habits that a made-up participant keeps in every sentence."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Literal

import numpy as np

_Layout = Literal["prose", "numbered", "lines"]
SpokenUnit = Literal["metres", "steps", "seconds"]


@dataclass(frozen=True, slots=True)
class SpeechMarks:
    """How often speech is marked by what does not make it wrong; shares, 0 to 1."""

    filler: float
    """Of sentences, with a filler, by speakers who use them."""
    restart: float
    """Of turns, told with a correction."""
    hedge: float
    """Of sentences, with a hedge."""
    distance: float
    """Spread of the factor by which a stated distance is off (log-normal sigma)."""
    merged_turns: float
    """Of pairs of turns within a few metres, told as one."""
    skipped_corner: float
    """Of corners without a choice, not told."""


ONLINE = SpeechMarks(0.0, 0.0, 0.02, 0.15, 0.35, 0.15)
ONSITE = SpeechMarks(0.22, 0.06, 0.1, 0.4, 0.45, 0.3)
"""Of typed and spoken texts; not from the paper, which counts none of them."""
FILLERS = (
    ("um", "uh"),
    ("uh", "um"),
    ("er", "er"),
    ("so", "you know"),
    ("well", "like"),
)
"""Pairs at the beginning and in the middle of sentences; a speaker uses one pair."""


@dataclass(frozen=True, slots=True)
class Voice:
    """One speaker."""

    spoken: bool
    """Whether it is transcribed speech, not typing."""
    again: bool
    """Whether it is the second description."""
    layout: _Layout
    marker: str
    """Before the items of a numbered list, with `{n}`."""
    unit: SpokenUnit
    please: bool
    fillers: tuple[str, ...]
    """At the beginning and in the middle of sentences; empty for a speaker without."""
    contracted: bool
    """Says "you'll", not "you will"."""
    surface: SpeechMarks

    @property
    def manner(self) -> Literal["spoken", "typed"]:
        """The name of its phrases."""
        return "spoken" if self.spoken else "typed"


def make_voice(
    study: str,
    iteration: int,
    rng: np.random.Generator,
    changes: Mapping[str, float] | None = None,
) -> Voice:
    """Make up a speaker; the same chance makes the same one for both iterations.

    `changes` are shares by the names of `SpeechMarks`' fields that differ from the defaults.
    """
    spoken = study == "onsite"
    layouts: list[_Layout] = ["prose", "numbered", "lines"]
    weights = [1.0, 0.0, 0.0] if spoken else [0.68, 0.24, 0.08]
    layout = layouts[int(rng.choice(3, p=weights))]
    markers = ["{n}.", "{n})", "Step {n}:", "({n})"]
    marker = str(rng.choice(markers, p=[0.55, 0.2, 0.15, 0.1]))
    units: list[SpokenUnit] = ["metres", "steps", "seconds"]
    shares = [0.55, 0.3, 0.15] if spoken else [0.7, 0.22, 0.08]
    unit = units[int(rng.choice(3, p=shares))]
    please = bool(rng.random() < 0.15)
    with_fillers = bool(rng.random() < 0.55)
    fillers = FILLERS[int(rng.choice(len(FILLERS)))]
    contracted = bool(rng.random() < (0.9 if spoken else 0.5))
    known = {field.name for field in fields(SpeechMarks)}
    given = {name: share for name, share in (changes or {}).items() if name in known}
    surface = replace(ONSITE if spoken else ONLINE, **given)
    forced = "filler" in given and given["filler"] > 0
    return Voice(
        spoken=spoken,
        again=iteration == 2,
        layout=layout,
        marker=marker,
        unit=unit,
        please=please,
        fillers=fillers if forced or (spoken and with_fillers) else (),
        contracted=contracted,
        surface=surface,
    )
