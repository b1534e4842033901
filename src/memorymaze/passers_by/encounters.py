"""The people of one episode whom a robot can ask, and what came of it."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, cast, get_args

from memorymaze.errors import CommandError
from memorymaze.passers_by.bank import load_bank
from memorymaze.passers_by.knowledge import FloorKnowledge
from memorymaze.passers_by.memory import Memory, Truth
from memorymaze.robot.asking import Question, QuestionKind
from memorymaze.simulation import SimulatedRobot
from memorymaze.simulation.obstacles import PassersBy
from memorymaze.simulation.obstacles.crowd import Person

MOST_CHARACTERS = 200
"""Of what is asked about."""


@dataclass(frozen=True, slots=True)
class Asked:
    """A question that was answered."""

    time: float
    """Simulated seconds when it was put."""
    place: tuple[float, float]
    """Where robot and person stood, metres."""
    person: str
    """Id of the person."""
    reliable: bool
    """Whether the person answers without errors."""
    truth: Truth
    error: str
    """What is wrong with the answer; empty where nothing is."""
    seconds: float
    """How long question and answer took."""


class Encounters:
    """Answers the robot's questions for the people it meets; counts them."""

    def __init__(
        self,
        robot: SimulatedRobot,
        floor: FloorKnowledge,
        destination: str,
        questions: int,
        *,
        seed: tuple[int, ...],
        error_rate: float,
        success_distance: float,
        kind: PassersBy = "memory",
        on_answer: Callable[[Asked], None] | None = None,
    ) -> None:
        """Wait for the first question of so many."""
        self.destination = destination
        """What the user calls the place they want to get to."""
        self.questions_left = questions
        self.asked: list[Asked] = []
        """The questions that were answered."""
        self.in_vain = 0
        """Questions with nobody near."""
        self._robot = robot
        self._floor = floor
        self._seed = seed
        self._error_rate = error_rate
        self._success_distance = success_distance
        self._kind: PassersBy = kind
        self._on_answer = on_answer

    @property
    def seconds(self) -> float:
        """Simulated seconds of strangers that all answers took."""
        return sum(each.seconds for each in self.asked)

    def ask(self, question: object) -> str | None:
        """Return what the nearest person says; None for nobody near and no question left."""
        asked = _checked(question)
        if not self.questions_left:
            return None
        before = self._robot.standing_time
        made: dict[str, Any] = {}

        def answer(person: Person) -> str:
            memory = self._memory_of(person)
            told = memory.answer(asked, self._robot.pose)
            made.update(
                time=self._robot.time,
                place=(self._robot.pose.x, self._robot.pose.y),
                person=person.record.id,
                reliable=memory.is_reliable,
                truth=told.truth,
                error=told.error,
            )
            return told.words

        words = self._robot.ask(asked, answer)
        if words is None:
            self.in_vain += 1
            return None
        self.questions_left -= 1
        seconds = round(self._robot.standing_time - before, 6)
        self.asked.append(Asked(**made, seconds=seconds))
        if self._on_answer is not None:
            self._on_answer(self.asked[-1])
        return words

    def _memory_of(self, person: Person) -> Memory:
        number = int(person.record.id.rpartition("-")[2])
        return Memory(
            (*self._seed, number),
            self._floor,
            load_bank(),
            self._error_rate,
            self._success_distance,
            self._kind,
        )


def asked_entry(asked: Asked) -> dict[str, Any]:
    """Return what a trace tells of an answer besides its words."""
    return {
        "kind": "passer_by",
        **asdict(asked),
        "place": [round(each, 3) for each in asked.place],
    }


def _checked(question: object) -> Question:
    """Return a question that can be put into words."""
    if (
        not isinstance(question, Question)
        or question.kind not in get_args(QuestionKind)
        or not isinstance(cast(object, question.about), str)
    ):
        raise CommandError(
            "ask: expected way_to(destination), where_is(thing) or is_this(place), with "
            f"a few words, got {question!r}"
        )
    about = " ".join(question.about.split())
    if not about or len(about) > MOST_CHARACTERS:
        raise CommandError(
            f"ask: expected 1 to {MOST_CHARACTERS} characters to ask about, got "
            f"{len(about)}"
        )
    return Question(question.kind, about)
