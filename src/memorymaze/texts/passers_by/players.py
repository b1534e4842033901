"""Who answers for a passer-by with words of their own: a language model in role.

It is told what the passer-by remembers. Others find their words in the bank (`memory`).
"""

from dataclasses import dataclass
from functools import cached_property

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.wording import single_spaced
from memorymaze.language.models.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
)
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version
from memorymaze.robot.api.asking import Question
from memorymaze.texts.passers_by.bank_records import Reply, TurnFact, WayFacts
from memorymaze.texts.passers_by.memory import AnswerWithTruth, Memory
from memorymaze.texts.passers_by.spoken_numbers import ordinal_word

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

    def answer(self, question: Question, here: Pose) -> AnswerWithTruth:
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
        return AnswerWithTruth(words, recalled.truth, recalled.error, completion)


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
