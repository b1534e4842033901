"""The people of one episode whom a robot can ask, and what came of it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, cast, get_args

from memorymaze.basics.errors import CommandError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.asking import Question, QuestionKind
from memorymaze.robot.simulation.obstacles.crowd import Person
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.texts.passers_by.memory import AnswerWithTruth, Truth

MOST_CHARACTERS = 200
"""Of what is asked about."""


class PasserBy(Protocol):
    """Somebody who can be asked."""

    @property
    def is_reliable(self) -> bool | None:
        """Whether they answer without errors; None where nobody can tell."""
        ...

    def answer(self, question: Question, here: Pose) -> AnswerWithTruth:
        """Answer where one stands, facing as the asker faces."""
        ...


Meet = Callable[[int, int], PasserBy]
"""Returns who answers, by the number of the person and, from 1, of the question."""


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
    model: str | None = None
    """Language model that put the answer into words, where one did."""
    tokens: int = 0
    """Of its request and reply together."""
    cost_usd: float = 0.0


class Encounters:
    """Answers the robot's questions for the people it meets; counts them."""

    def __init__(
        self,
        robot: SimulatedRobot,
        meet: Meet,
        destination: str,
        questions: int,
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
        self._meet = meet
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
            number = int(person.record.id.rpartition("-")[2])
            somebody = self._meet(number, len(self.asked) + 1)
            told = somebody.answer(asked, self._robot.pose)
            made.update(
                time=self._robot.time,
                place=(self._robot.pose.x, self._robot.pose.y),
                person=person.record.id,
                reliable=somebody.is_reliable,
                truth=told.truth,
                error=told.error,
            )
            if told.completion is not None:
                usage = told.completion.usage
                made.update(
                    model=told.completion.model,
                    tokens=usage.prompt_tokens + usage.completion_tokens,
                    cost_usd=usage.cost_usd or 0.0,
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
