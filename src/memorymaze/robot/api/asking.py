"""Asking people on the way: the three questions, and the robot that can ask them.

Only in the track with people one can ask (`--ask N`); everywhere else a robot has no `ask`.
"""

from dataclasses import dataclass
from typing import Literal, Protocol, TypeGuard, runtime_checkable

from memorymaze.robot.api.control import Robot

QuestionKind = Literal["way_to", "where_is", "is_this"]

HEARING_RANGE = 3.0
"""Metres within which people are asked."""
WORDS_PER_SECOND = 2.5
"""How fast people speak."""


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked; made by `way_to`, `where_is` and `is_this`."""

    kind: QuestionKind
    """What is asked."""
    about: str
    """The destination, the thing or the place, in a few words."""

    def __str__(self) -> str:
        """Return the question as it is said."""
        asked = {
            "way_to": f"Excuse me, how do I get to {self.about}?",
            "where_is": f"Excuse me, where is {self.about}?",
            "is_this": f"Excuse me, is this {self.about}?",
        }
        return asked[self.kind]


def way_to(destination: str) -> Question:
    """Ask for the way to a destination."""
    return Question("way_to", destination)


def where_is(thing: str) -> Question:
    """Ask where a thing is that should be near by."""
    return Question("where_is", thing)


def is_this(place: str) -> Question:
    """Ask whether this is a place."""
    return Question("is_this", place)


def seconds_to_say(words: str) -> float:
    """Return how long it takes to say something, in simulated seconds."""
    return len(words.split()) / WORDS_PER_SECOND


def can_ask(robot: object) -> TypeGuard["AskingRobot"]:
    """Tell whether a robot is one of the track with people one can ask."""
    return hasattr(robot, "questions_left")


@runtime_checkable
class AskingRobot(Robot, Protocol):
    """A robot that can also ask people who walk by."""

    def destination(self) -> str:
        """Return what the user calls the place they want to get to, such as `the library`."""
        ...

    def questions_left(self) -> int:
        """Return how many more questions may be asked."""
        ...

    def ask(self, question: Question) -> str | None:
        """Ask the nearest person who is within 3 m and in sight.

        The answer is what the person says, from memory: it may be incomplete or wrong.
        They point from where the robot stands: `left` is left of the way it faces.

        Args:
            question: `way_to(destination)`, `where_is(thing)` or `is_this(place)`.

        Returns:
            The words of the answer; None where nobody is near, which costs no question,
            and where no question is left.

        Example:
            >>> answer = ask(way_to(destination()))
            >>> if answer is not None:
            ...     say("They say: " + answer)
        """
        ...
