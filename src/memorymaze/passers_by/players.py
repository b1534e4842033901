"""Who answers for a passer-by with words of their own: a person, or a language model in role.

Others find theirs in the bank (`memory`). A person is shown what is true; a model is told
what the passer-by remembers.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from memorymaze.geometry.pose import Pose, heading_to, turn_between
from memorymaze.language.model import (
    CompletionRequest,
    LanguageModel,
    Message,
)
from memorymaze.language.model import Question as ModelQuestion
from memorymaze.language.prompt_texts import load_prompt, prompt_version
from memorymaze.passers_by.bank_records import Reply, TurnFact, WayFacts
from memorymaze.passers_by.knowledge import FloorKnowledge, NamedPlace
from memorymaze.passers_by.memory import Memory, Told, way_facts
from memorymaze.passers_by.spoken_numbers import ordinal_word
from memorymaze.robot.asking import Question
from memorymaze.wording import single_spaced

DO_NOT_KNOW = "I don't know."
"""What somebody says who types nothing."""
STAGE = "passer_by"
"""Of requests to the model, by which recorded replies are found."""
MOST_TOKENS = 200

_SET_OFF = {
    "ahead": "go the way the robot faces",
    "left": "go to the robot's left",
    "right": "go to the robot's right",
    "back": "turn round and go back, away from where the robot faces",
}
_AT = {
    "next": "at the next way on that side",
    "crossing": "at the crossing",
    "end": "where the way ahead ends",
}
_ENDS = {
    "ahead": "straight ahead",
    "left": "on the left",
    "right": "on the right",
    "end": "where the way ends",
}


@dataclass(frozen=True, slots=True)
class Briefing:
    """What a person is shown who answers for a passer-by."""

    question: str
    """As the robot says it."""
    facts: tuple[str, ...]
    """What is true of it, a line each."""
    way: tuple[tuple[float, float], ...]
    """The way that is asked for, metres; empty where none is."""


@dataclass(frozen=True, slots=True)
class PersonAnswering:
    """A person who is shown each question and what is true, and says what they like."""

    floor: FloorKnowledge
    put_to: Callable[[Briefing], str]
    """Returns what the person says; nothing for who does not know."""

    is_reliable = None

    def answer(self, question: Question, here: Pose) -> Told:
        """Have the person answer."""
        words = single_spaced(self.put_to(brief(self.floor, question, here)))
        return Told(words, "said") if words else Told(DO_NOT_KNOW, "unknown")


def brief(floor: FloorKnowledge, question: Question, here: Pose) -> Briefing:
    """Return a question with what is true of it, seen from the robot."""
    place = floor.nearest_called(question.about, here)
    if place is None:
        fact = f"The floor has nothing that is called {question.about!r}."
        return Briefing(str(question), (fact,), ())
    facts = [_as_seen(floor, question.about, place, here)]
    way = floor.way_to(question.about, here) if question.kind == "way_to" else None
    if way is None:
        return Briefing(str(question), tuple(facts), ())
    steps = steps_in_words(way_facts(way, way.facts.plan, way.facts.plan))
    facts += [f"{number}. {step}" for number, step in enumerate(steps, 1)]
    line = tuple((x, y) for x, y, *_ in way.facts.route.line.coords)
    return Briefing(str(question), tuple(facts), line)


def _as_seen(floor: FloorKnowledge, name: str, place: NamedPlace, here: Pose) -> str:
    """Say in which direction a place lies, how far it is, and what it is close to."""
    eye = (here.x, here.y)
    degrees = round(
        math.degrees(turn_between(here.heading, heading_to(eye, place.position)))
    )
    side = "left" if degrees > 0 else "right"
    bearing = f"{abs(degrees)}° to the {side} of" if degrees else "straight along"
    found = floor.whereabouts(place, here)
    near = "" if found.near is None else f", near {found.near}"
    sight = "in sight" if found.bearing else "out of sight"
    return (
        f"{name} lies {math.dist(eye, place.position):.0f} m away, {bearing} the way the "
        f"robot faces, {sight}{near}; {found.metres:.0f} m as one walks."
    )


def steps_in_words(way: WayFacts) -> tuple[str, ...]:
    """Say a way in plain words, a line for each step."""
    turns = tuple(
        f"after {turn.metres:.0f} m turn {turn.side} {_where(turn)}"
        for turn in way.turns
    )
    end = f"after {way.metres:.0f} m {way.destination} is {_ENDS[way.end]}"
    return (_SET_OFF[way.start], *turns, end)


def _where(turn: TurnFact) -> str:
    match turn.cue:
        case "thing":
            return f"at {turn.thing}"
        case "ordinal":
            return f"at the {ordinal_word(turn.ordinal)} way on that side"
        case _:
            return _AT[turn.cue]


@dataclass(frozen=True)
class ModelInRole:
    """A language model that plays a passer-by: says what they remember, in their voice."""

    memory: Memory
    model: LanguageModel
    number: int
    """Which question of the episode it is, from 1."""

    @property
    def is_reliable(self) -> bool:
        """Whether what it is told to remember has no errors."""
        return self.memory.is_reliable

    @cached_property
    def _rules(self) -> str:
        return load_prompt("passer_by")

    def answer(self, question: Question, here: Pose) -> Told:
        """Ask the model; whether it says what it was told, nobody checks."""
        recalled = self.memory.recall(question, here)
        match recalled.facts:
            case WayFacts() as way:
                facts = steps_in_words(way)
            case Reply() as reply:
                facts = (reply_in_words(reply),)
        told = "\n".join(f"- {fact}" for fact in facts)
        asked = (
            f"Who you are: {self.memory.voice}\nWhat you remember:\n{told}\n"
            f"The robot asks: {question}"
        )
        completion = self.model.complete(
            CompletionRequest(
                (Message("system", self._rules), Message("user", asked)),
                max_tokens=MOST_TOKENS,
                question=ModelQuestion(STAGE, prompt_version(self._rules), self.number),
            )
        )
        words = single_spaced(completion.text)
        return Told(words, recalled.truth, recalled.error, completion)


def reply_in_words(reply: Reply) -> str:
    """Say in plain words what somebody tells who tells no way."""
    slots = reply.slots
    about = next(
        slots[each] for each in ("destination", "thing", "place") if each in slots
    )
    near = f", near {slots['near']}" if "near" in slots else ""
    match reply.case:
        case "unknown" | "unsure":
            return f"nothing: you do not know about {about}"
        case "far":
            return f"{about} is out of sight, {slots['metres']} m as one walks{near}"
        case "yes":
            return f"yes, this is {about}{near}"
        case "no":
            here = f"; this place is{near.removeprefix(',')}" if near else ""
            return f"no, this is not {about}{here}"
        case "not_yet":
            return f"not yet: {about} comes further on; {_SET_OFF[slots['where']]}"
        case side:
            where = {"ahead": "ahead", "behind": "behind the robot"}.get(
                side, f"to the robot's {side}"
            )
            return f"{about} is {where}, {slots['metres']} m as one walks{near}"
