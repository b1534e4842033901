"""Put single steps into words: a turn, two turns at once, the destination."""

import re
from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np

from memorymaze.language.plans import Arrival, Leg
from memorymaze.texts.writing.marked_text import mark
from memorymaze.texts.writing.phrases import phrases
from memorymaze.texts.writing.things import Thing, thing_called, with_article
from memorymaze.texts.writing.voices import Voice

Size = Literal["terse", "plain", "wordy"]
Focus = Mapping[str, str]
"""Labels by the part of a step that they are for: `side`, `cue`, or `step` for all."""

OWN_NAME = re.compile(r".* (Lane|Street|Row|Road|Avenue|Alley|Way)")
CONTRACTIONS = (
    (re.compile(r"\b([Yy]ou|[Ii]t|[Tt]hey) will\b"), r"\1'll"),
    (re.compile(r"\b([Tt]hat|[Ii]t|[Tt]here) is\b(?= \w)"), r"\1's"),
    (re.compile(r"\b([Yy]ou|[Tt]hey) are\b(?= \w)"), r"\1're"),
    (re.compile(r"\bI am\b(?= \w)"), "I'm"),
    (re.compile(r"\bI would\b"), "I'd"),
    (re.compile(r"\b([Dd])o not\b"), r"\1on't"),
    (re.compile(r"\bcannot\b"), "can't"),
    (re.compile(r"\b([Yy]ou|I) have\b(?= (?:gone|passed|reached|been))"), r"\1've"),
)


def one_of(patterns: Sequence[str], rng: np.random.Generator) -> str:
    """Draw one of some patterns."""
    return patterns[int(rng.integers(len(patterns)))]


def spoken_as(text: str, voice: Voice) -> str:
    """Return a text with the contractions of a speaker."""
    if voice.contracted:
        for long, short in CONTRACTIONS:
            text = long.sub(short, text)
    return text


def place_words(leg: Leg, rng: np.random.Generator) -> str:
    """Return the words for the corridor of a stretch."""
    names = (
        each.phrase
        for each in leg.mentions
        if each.kind == "place" and each.place == "along"
    )
    name = next(names, None)
    if name and rng.random() < 0.3:
        if OWN_NAME.fullmatch(name) or name.lower().startswith("the "):
            return name
        return f"the {name}"
    return one_of(phrases("nameless_ways"), rng)


def thing_at_the_turn(leg: Leg) -> str | None:
    """Return the words for the thing that a turn is said to be at."""
    at = (each.phrase for each in leg.mentions if each.place == "turn")
    return next(at, None)


def metres_of(part: Leg | Arrival) -> float:
    """Return the length of a stretch; 0 where it has none."""
    return part.length.metres if part.length is not None else 0.0


def turn_clause(
    leg: Leg,
    size: Size,
    voice: Voice,
    rng: np.random.Generator,
    focus: Focus,
    number: int,
    things: Mapping[str, Thing],
) -> str:
    """Return a turn in words, without capital or full stop; labels are inside it.

    Turns in a row have numbers in a row, so that no two of them sound the same.
    """
    pattern = _pattern(leg, size, voice, number, focus)
    words = {
        "side": _side(leg, pattern, voice, rng, focus),
        "ord": phrases("ordinals")[(leg.turn.ordinal or 1) - 1],
        "place": place_words(leg, rng),
    }
    thing = thing_at_the_turn(leg)
    if thing is not None:
        words["thing"] = with_article(thing_called(thing, things), definite=True)
        if "cue" in focus and rng.random() < 0.3:
            words["thing"] = f"{'an' if thing[0] in 'aeiou' else 'a'} {thing}"
    told = _bracketed(pattern, focus.get("cue")).format(**words)
    if voice.please and rng.random() < 0.4:
        told = f"please {told}" if is_command(told) else told
    return spoken_as(told, voice)


def merged_clause(leg: Leg, rng: np.random.Generator, focus: Focus) -> str:
    """Return the words for a turn that follows right after the one before."""
    side = leg.turn.way.rpartition("_")[2]
    side = mark(focus["side"], side) if "side" in focus else side
    bend = "slightly " if leg.turn.way.startswith("slight") else ""
    told = one_of(phrases("merged"), rng).format(side=f"{bend}{side}")
    return mark("merged_turns", told)


def skipped_clause(leg: Leg, rng: np.random.Generator) -> str:
    """Return what is said of a corner that is left to the listener, or nothing."""
    if rng.random() < 0.25:
        return mark("skipped_corner", "")
    place = place_words(leg, rng)
    return mark("skipped_corner", one_of(phrases("skipped"), rng).format(place=place))


def arrival_clause(
    arrival: Arrival,
    size: Size,
    voice: Voice,
    rng: np.random.Generator,
    things: Mapping[str, Thing],
    *,
    by: bool,
) -> str:
    """Return the end of the way in words; `by` the thing that it is said to be at."""
    patterns = phrases("arrivals_by" if by else "arrivals", size)
    beside = [each.phrase for each in arrival.mentions if each.place == "beside"]
    thing = "".join(
        with_article(thing_called(words, things), definite=True) for words in beside
    )
    goal = goal_words(arrival.destinations[0])
    if " in " in goal and rng.random() < 0.6:
        goal = goal.partition(" in ")[0]
    ordinals = phrases("ordinals")
    if arrival.nth is not None and arrival.nth <= len(ordinals) and "door" not in goal:
        goal = f"the {ordinals[arrival.nth - 1]} door of {goal}"
    told = one_of(patterns, rng).format(
        goal=goal, there=_there(arrival, rng), thing=thing
    )
    return spoken_as(told, voice)


def _pattern(leg: Leg, size: Size, voice: Voice, number: int, focus: Focus) -> str:
    turn = leg.turn
    at_a_thing = thing_at_the_turn(leg) is not None
    counted = (turn.ordinal or 1) > 1
    patterns: Sequence[str]
    if turn.way.startswith("slight"):
        uncounted = "thing" if at_a_thing else "place"
        patterns = phrases("slight", "later" if counted else uncounted, size)
    else:
        kind = "later" if counted else "first"
        if turn.forced or turn.at_end:
            kind = "forced" if turn.forced else "end"
        elif at_a_thing:
            kind = "thing"
        patterns = phrases("turns", kind, size)
        if voice.spoken and size != "terse":
            patterns = (*phrases("spoken_turns", kind), *patterns)
    if metres_of(leg) < 6:
        patterns = [each for each in patterns if "{place}" not in each] or patterns
    if "cue" in focus:
        patterns = [each for each in patterns if "[" in each] or patterns
    return patterns[number % len(patterns)]


def _side(
    leg: Leg, pattern: str, voice: Voice, rng: np.random.Generator, focus: Focus
) -> str:
    side = leg.turn.way.rpartition("_")[2]
    told = mark(focus["side"], side) if "side" in focus else side
    corrected = rng.random() < voice.surface.restart
    correction = one_of(phrases("corrections"), rng)
    if corrected and pattern.endswith("{side}"):
        other = {"left": "right", "right": "left"}[side]
        return f"{mark('restart', f'{other}, {correction}')} {told}"
    return told


def _bracketed(pattern: str, label: str | None) -> str:
    if label is None:
        return pattern.replace("[", "").replace("]", "")
    before, _, rest = pattern.partition("[")
    cue, _, after = rest.partition("]")
    return before + mark(label, cue) + after


def is_command(told: str) -> bool:
    """Tell whether a clause begins with a verb in the imperative."""
    first = told.split(maxsplit=1)[0]
    return first in phrases("words", "commands")


def goal_words(goal: str) -> str:
    """Return a destination with the article that plain English gives it."""
    head = goal.split(maxsplit=1)[0]
    if head in phrases("words", "placed"):
        return f"the place {goal}"
    if head in {"the", "The"} or goal[0].isupper() or head in {"a", "an"}:
        return goal
    return f"the {goal}"


def _there(arrival: Arrival, rng: np.random.Generator) -> str:
    told = {"left", "right"} & set(arrival.destinations[0].split())
    if arrival.side == "ahead" or told:
        return one_of(("straight ahead", "right in front of you", "ahead of you"), rng)
    side = arrival.side
    return one_of((f"on the {side}", f"on your {side}", f"on the {side} side"), rng)
