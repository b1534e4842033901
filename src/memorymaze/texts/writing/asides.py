"""What speakers say beside the turns: things they pass, lengths, warnings, chatter.

What they say of the way is true of it, apart from lengths from memory, which are labelled
where they are far off.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.language.plans import SECOND_METRES, STEP_METRES, Arrival, Leg
from memorymaze.texts.writing.clauses import (
    is_command,
    metres_of,
    one_of,
    spoken_as,
)
from memorymaze.texts.writing.marked_text import mark, without_marks
from memorymaze.texts.writing.phrases import phrases, words_for
from memorymaze.texts.writing.things import Thing, is_plural, thing_called, with_article
from memorymaze.texts.writing.voices import SpokenUnit, Voice

UNIT_METRES: Mapping[SpokenUnit, float] = {
    "metres": 1.0,
    "steps": STEP_METRES,
    "seconds": SECOND_METRES,
}
"""Metres that a walker makes in one."""
FAR_OFF = 0.25
"""A length that is further off is labelled."""


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
    count = rounded_as_told(said / UNIT_METRES[voice.unit])
    meant = count * UNIT_METRES[voice.unit]
    words = f"{count} {voice.unit.removesuffix('s') if count == 1 else voice.unit}"
    about = not voice.spoken and rng.random() < 0.35
    told = f"about {words}" if about else words
    if metres > 3 and abs(meant - metres) > FAR_OFF * metres:
        return mark(f"distance|says {words}; it is {metres:.0f} m", told)
    return told


def leg_asides(
    part: Leg | Arrival,
    key: str,
    side: str | None,
    voice: Voice,
    rng: np.random.Generator,
    things: Mapping[str, Thing],
    known: Collection[str] = (),
) -> Iterator[Aside]:
    """Yield all that could be said of a stretch, in no order of importance.

    `key` and `side` are of the step at its end, None for the destination's side; the
    `known` things are told anyway.
    """

    def aside(order: float, pattern: str, **words: str) -> Aside:
        text = spoken_as(pattern.format(**words), voice)
        return Aside(key, order, text)

    metres = metres_of(part)
    if metres > 3:
        lengths = phrases(voice.manner, "lengths")
        length = stated_length(metres, voice, rng)
        yield aside(-90, one_of(lengths, rng), length=length)
    floor = words_for("floor_words").get(floor_underfoot(part) or "")
    if floor is not None:
        yield aside(-80, one_of(phrases("besides", "floors"), rng), floor=floor)
    yield from _passings(part, key, voice, rng, things, known)
    openings = dict.fromkeys(each.side for each in part.passings)
    for number, opening in enumerate(openings):
        if opening is not None and opening != side:
            pattern = one_of(phrases("besides", "openings"), rng)
            yield aside(-10 + number, pattern, side=opening)
    beyond = next(iter(part.too_far), None)
    if beyond is not None and beyond not in known:
        the = with_article(thing_called(beyond, things), definite=True)
        yield aside(50, one_of(phrases("besides", "beyond"), rng), the=the)
    if metres < 6 and side is not None:
        yield aside(40, one_of(phrases("besides", "quick"), rng))
    elif metres > 25:
        yield aside(-85, one_of(phrases("besides", "long"), rng))


def floor_underfoot(part: Leg | Arrival) -> str | None:
    """Return what lies underfoot where most of a stretch is."""
    floors = (each.phrase for each in part.mentions if each.kind == "floor")
    return next((floor.removesuffix(" floor") for floor in floors), None)


def _passings(
    part: Leg | Arrival,
    key: str,
    voice: Voice,
    rng: np.random.Generator,
    things: Mapping[str, Thing],
    known: Collection[str],
) -> Iterator[Aside]:
    patterns = phrases(voice.manner, "passings")
    told = [
        each
        for each in part.mentions
        if each.place == "passed" and each.phrase not in known
    ]
    number, turn = 0, int(rng.integers(len(patterns)))
    while number < len(told):
        here = told[number]
        thing = thing_called(here.phrase, things)
        words = {
            "a": with_article(thing, definite=False),
            "the": with_article(thing, definite=True),
            "side": here.side or "",
            "is": "are" if is_plural(thing) else "is",
            "that": "they are" if is_plural(thing) else "that is",
        }
        turn += 1
        pattern = patterns[turn % len(patterns)]
        if number + 1 < len(told) and rng.random() < 0.3:
            following = told[number + 1]
            other = thing_called(following.phrase, things)
            words["b"] = with_article(other, definite=False)
            words["other"] = following.side or ""
            pattern = one_of(phrases("besides", "two_passings"), rng)
            if following.side == here.side:
                pattern = "you pass {a} and then {b}, both on the {side}"
            number += 1
        after = here.after_metres or 0.0
        order = -70 + 55 * after / max(metres_of(part), 1.0)
        yield Aside(key, order, spoken_as(pattern.format(**words), voice))
        number += 1


def rounded_as_told(value: float) -> int:
    """Round as people do: to ones below ten, then to fives and tens."""
    if value < 10:
        return max(1, round(value))
    step = 5 if value < 60 else 10
    return int(step * round(value / step))


def opening_and_closing(
    voice: Voice, goal: str, first: str, last: str, rng: np.random.Generator
) -> list[Aside]:
    """Return a way to begin and a way to end."""
    beginnings = "beginnings_again" if voice.again else "beginnings"
    opening = one_of(phrases(voice.manner, beginnings), rng).format(goal=goal)
    closing = one_of(phrases(voice.manner, "endings"), rng)
    return [
        Aside(first, 0, spoken_as(opening, voice), sure=True),
        Aside(last, 0, spoken_as(closing, voice), sure=True),
    ]


def small_talk(
    voice: Voice, keys: Sequence[str], rng: np.random.Generator
) -> list[Aside]:
    """Return what has nothing to do with the turns, in random order and places."""
    pool = phrases(voice.manner, "talk")
    return [
        Aside(
            str(rng.choice(keys)),
            float(rng.uniform(-60, -5)),
            spoken_as(pool[int(number)], voice),
            sure=True,
        )
        for number in rng.permutation(len(pool))
    ]


def disturbed(
    text: str,
    voice: Voice,
    rng: np.random.Generator,
    *,
    turn: bool = False,
    sure: bool = False,
) -> str:
    """Put the fillers, hedges and fresh starts of a speaker into a sentence."""
    filler, hedge, again, inside = rng.random(4)
    plain = without_marks(text)
    doubtful = any(word in plain for word in phrases("hedges", "doubtful"))
    if hedge < voice.surface.hedge and not (sure or doubtful):
        command = turn or is_command(plain) or plain.startswith(("I ", "I'"))
        if command or rng.random() < 0.5:
            text = f"{text}, {mark('hedge', one_of(phrases('hedges', 'after'), rng))}"
        else:
            text = f"{mark('hedge', one_of(phrases('hedges', 'before'), rng))} {text}"
    if voice.spoken and again < voice.surface.restart / 2:
        start = one_of(phrases("hedges", "fresh_starts"), rng).rstrip()
        text = f"{mark('restart', start)} {text}"
    if voice.fillers and filler < voice.surface.filler:
        first, middle = voice.fillers
        if inside < 0.6 and " and " in text:
            said = mark("filler", f"{middle},")
            text = text.replace(" and ", f" and, {said} ", 1)
        elif not plain.lower().startswith(("so", "um", "uh", "well", "okay", "right,")):
            text = f"{mark('filler', f'{first},')} {text}"
    return text
