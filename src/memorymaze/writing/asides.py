"""What speakers add to the turns: things they pass, lengths, warnings, chatter.

All of it is true of the way, apart from lengths from memory, which are labelled where
they are far off.
"""

from collections.abc import Collection, Iterator
from dataclasses import dataclass

import numpy as np

from memorymaze.writing.clauses import one_of, spoken_as
from memorymaze.writing.marked_text import mark
from memorymaze.writing.steps import Leg, Passing
from memorymaze.writing.things import is_plural, with_article
from memorymaze.writing.voices import Voice

STEP = 0.7
"""Metres."""
PACE = 1.2
"""Metres per second of a walker."""
FAR_OFF = 0.25
"""A length that is further off is labelled."""

TYPED_PASSING = (
    "you will pass {a} on your {side}",
    "there {is} {a} on the {side}",
    "you go past {a}, on the {side}",
    "{a} will be on your {side}",
    "on the {side} there {is} {a}",
    "keep going past {the}",
    "on your {side} you can see {a}",
    "pass {the} on the {side}",
)
SPOKEN_PASSING = (
    "there {is} {a} on your {side}",
    "you will see {a} on the {side}, just keep going",
    "you go past {the}, {that} on the {side}",
    "on the {side} there should be {a}",
    "you walk by {a}, on the {side}",
    "{the} {is} on your {side} then",
    "somewhere there on the {side} {is} {a}",
    "you have {a} on the {side}, and you leave that",
    "I always notice {the} there, on the {side}",
)
TWO_PASSING = (
    "you pass {a} on the {side} and then {b} on the {other}",
    "there {is} {a} on the {side}, and after that {b} on the {other}",
    "first comes {a} on the {side}, then {b} on the {other}",
)
OPENINGS = (
    "ignore the opening on the {side}",
    "do not take the way on the {side}",
    "there is a turning on the {side} before that, leave it",
    "you will come past a way off to the {side}, just go straight there",
    "a corridor goes off to the {side}, but that is not yours",
)
BEYOND = (
    "if you get to {the}, you have gone too far",
    "if you reach {the}, you have passed it",
    "{the} would be too far",
)
TYPED_LENGTHS = (
    "go straight for {length}",
    "walk {length}",
    "this stretch is {length} long",
    "continue for {length}",
)
SPOKEN_LENGTHS = (
    "it is {length}, maybe",
    "that is {length}, roughly",
    "you walk for {length} or so",
    "I would say {length}",
    "straight for {length} perhaps",
)
FLOORS = (
    "the floor is {floor} here",
    "you are on {floor} there",
    "you will have {floor} under your feet",
)
FLOOR_WORDS = {"tile": "tiles", "wood": "wood", "carpet": "carpet", "linoleum": "lino"}
QUICK = ("that one comes up quickly", "it is only a few steps", "it is very short")
LONG = ("this is a long one", "that takes a while", "it is quite a long way, that part")


@dataclass(frozen=True, slots=True)
class Aside:
    """A sentence beside a turn."""

    key: str
    """Of the step it is told with."""
    order: float
    """Below 0 before the turn, above 0 after it."""
    text: str
    """Marked, without capital or full stop."""
    sure: bool = False
    """Whether it takes no hedge."""


def stated_length(metres: float, voice: Voice, rng: np.random.Generator) -> str:
    """Return a length as a speaker remembers it, labelled where it is far off."""
    factor = float(np.exp(rng.normal(0.0, voice.surface.distance)))
    said = metres * factor
    if voice.unit == "steps":
        count = _rounded(said / STEP)
        words, meant = f"{count} steps", count * STEP
    elif voice.unit == "seconds":
        count = _rounded(said / PACE)
        words, meant = f"{count} seconds", count * PACE
    else:
        count = _rounded(said)
        words, meant = f"{count} metres", float(count)
    words = words.removesuffix("s") if count == 1 else words
    about = not voice.spoken and rng.random() < 0.35
    told = f"about {words}" if about else words
    if metres > 3 and abs(meant - metres) > FAR_OFF * metres:
        return mark(f"distance|says {words}; it is {metres:.0f} m", told)
    return told


def leg_asides(
    leg: Leg,
    key: str,
    side: str | None,
    voice: Voice,
    rng: np.random.Generator,
    known: Collection[str] = (),
) -> Iterator[Aside]:
    """Yield all that could be said of a stretch, in no order of importance.

    Args:
        leg: The stretch.
        key: Of the step at its end.
        side: Of the turn at its end; None for the destination.
        voice: Who speaks.
        rng: Source of chance.
        known: Words for things that are told anyway.
    """

    def aside(order: float, pattern: str, **words: str) -> Aside:
        text = spoken_as(pattern.format(**words), voice)
        return Aside(key, order, text)

    if leg.length > 3:
        lengths = SPOKEN_LENGTHS if voice.spoken else TYPED_LENGTHS
        length = stated_length(leg.length, voice, rng)
        yield aside(-90, one_of(lengths, rng), length=length)
    if leg.floor in FLOOR_WORDS:
        yield aside(-80, one_of(FLOORS, rng), floor=FLOOR_WORDS[leg.floor])
    yield from _passings(leg, key, voice, rng, known)
    for number, opening in enumerate(dict.fromkeys(leg.openings)):
        if opening != side:
            yield aside(-10 + number, one_of(OPENINGS, rng), side=opening)
    if leg.beyond is not None and leg.beyond.words not in known:
        the = with_article(leg.beyond, definite=True)
        yield aside(50, one_of(BEYOND, rng), the=the)
    if leg.length < 6 and side is not None:
        yield aside(40, one_of(QUICK, rng))
    elif leg.length > 25:
        yield aside(-85, one_of(LONG, rng))


def _passings(
    leg: Leg,
    key: str,
    voice: Voice,
    rng: np.random.Generator,
    known: Collection[str],
) -> Iterator[Aside]:
    patterns = SPOKEN_PASSING if voice.spoken else TYPED_PASSING
    told: list[Passing] = [
        each for each in leg.passing if each.thing.words not in known
    ]
    number, turn = 0, int(rng.integers(len(patterns)))
    while number < len(told):
        here = told[number]
        words = {
            "a": with_article(here.thing, definite=False),
            "the": with_article(here.thing, definite=True),
            "side": here.side,
            "is": "are" if is_plural(here.thing) else "is",
            "that": "they are" if is_plural(here.thing) else "that is",
        }
        turn += 1
        pattern = patterns[turn % len(patterns)]
        if number + 1 < len(told) and rng.random() < 0.3:
            following = told[number + 1]
            words["b"] = with_article(following.thing, definite=False)
            words["other"] = following.side
            pattern = one_of(TWO_PASSING, rng)
            if following.side == here.side:
                pattern = "you pass {a} and then {b}, both on the {side}"
            number += 1
        order = -70 + 55 * here.after / max(leg.length, 1.0)
        yield Aside(key, order, spoken_as(pattern.format(**words), voice))
        number += 1


def _rounded(value: float) -> int:
    """Round as people do: to ones below ten, then to fives and tens."""
    if value < 10:
        return max(1, round(value))
    step = 5 if value < 60 else 10
    return int(step * round(value / step))
