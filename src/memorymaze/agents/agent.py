"""The role of an agent: text and a robot in, motion out."""

import contextlib
import math
import operator
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol, runtime_checkable

import numpy as np

from memorymaze.agents.notes import (
    ArrivalNote,
    GaveUpNote,
    ModelReplyNote,
    Note,
    OwnNote,
)
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
)
from memorymaze.robot.api.steps import SteppingRobot

Need = Literal["language_model", "graph", "camera", "steps", "answers"]
"""What an agent needs besides text and robot: a language model to ask, the site's
navigation graph, pictures, primitive motions, or the reference path."""

COUNTS = frozenset({"model_calls", "tokens"})
AMOUNTS = frozenset({"cost_usd", "inference_s"})

TOLD_AGAIN = "\n\nTold once more:\n\n"
"""Between two tellings of one way by the same person, where an agent is handed both."""

_ENDINGS = frozenset({ArrivalNote.about, GaveUpNote.about})
"""Kinds of notes by which an agent says at the end whether it is there."""


@dataclass(frozen=True, slots=True)
class FairLimits:
    """What the budget `fair` allows on a site.

    It goes by the longest of all its routes: the same in every episode there, so it tells
    nothing of the route of one.
    """

    requests: int
    """To a model, in an episode: two for each 2.25 m, and at least 10."""
    steps: Mapping[int, int]
    """Primitive motions by the degrees of a turn, 15 or 30: three times those of a walk
    without a mistake, in steps of 25 cm."""


@dataclass(frozen=True, slots=True)
class Asking:
    """What an agent will ask its language model about a text, as far as it can tell."""

    prompts: Mapping[str, str] = field(default_factory=dict[str, str])
    """Versions of its prompts by stage, which recorded answers are compared with."""
    beforehand: bool = False
    """Whether all is asked before the robot moves, so that a check needs no building."""
    requests: Sequence[CompletionRequest] | None = None
    """All of them, for an estimate of what they cost; None where it asks on its way."""
    stride: tuple[float, float] | None = None
    """Of one that asks for every motion: metres ahead, and degrees of a turn, that an
    answer moves the robot by at most."""
    most: int | None = None
    """Requests of an episode at most, of one that asks for every motion."""


@runtime_checkable
class AsksModel(Protocol):
    """An agent that tells what it will ask, so that a run can say it before it begins."""

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell what it will ask about a text; `limits` are those of the site, if any."""
        ...


def asking_of(
    agent: object, instruction: str, limits: FairLimits | None = None
) -> Asking:
    """Return what an agent will ask about a text; nothing is known of one that is silent."""
    if isinstance(agent, AsksModel):
        return agent.asking(instruction, limits)
    return Asking()


def prompt_versions(requests: Iterable[CompletionRequest]) -> dict[str, str]:
    """Return the versions of the prompts of requests, by stage."""
    questions = (each.question for each in requests)
    return {each.stage: each.prompt for each in questions if each is not None}


@dataclass
class Journal:
    """What an agent thought and spent during one episode; kept even when it fails.

    Everything noted goes to the episode's trace. Of an `arrival`, and where the agent
    `gave_up`, a note may tell its `confidence`: how probable it is, 0 to 1, that it is
    there. What is no count, amount or probability, and is told as one, is a `ValueError`.
    """

    model_calls: int = 0
    tokens: int = 0
    """Of all requests and replies together."""
    cost_usd: float = 0.0
    inference_s: float = 0.0
    """Real seconds that replies took, all together."""
    _notes: list[Note] = field(default_factory=list[Note], init=False)
    listener: Callable[[Note], None] | None = None
    on_completion: Callable[[Completion], float] | None = None
    """Lets the time of a reply pass for the robot; returns the simulated seconds."""
    limits: FairLimits | None = None
    """What the run calls fair where the robot is; None outside of runs."""

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse what could not be added up, in the line that assigns it."""
        if name in COUNTS:
            value = _checked(
                f"journal.{name}", "a whole number of at least 0", value, operator.index
            )
        elif name in AMOUNTS:
            value = _checked(f"journal.{name}", "an amount of at least 0", value, float)
        super().__setattr__(name, value)

    def note(self, kind: str, /, **details: Any) -> None:
        """Write down a thought of any kind, such as `steps`, `decision`, `arrival`."""
        self.add(OwnNote(kind, details))

    def add(self, note: Note) -> None:
        """Write down a thought."""
        told = note.details.get("confidence")
        if note.about in _ENDINGS and told is not None:
            what = f"journal.note({note.about!r}, confidence=…)"
            _checked(what, "a probability from 0 to 1", told, float, most=1)
        self._notes.append(note)
        if self.listener is not None:
            self.listener(note)

    @property
    def notes(self) -> tuple[Note, ...]:
        """Everything noted so far; `note` and `add` write more."""
        return tuple(self._notes)

    @property
    def confidence(self) -> float | None:
        """How sure the agent was at last that it is there; None where it tells nothing."""
        told = [each.details.get("confidence") for each in self._endings]
        last = next((each for each in reversed(told) if each is not None), None)
        return None if last is None else float(last)

    @property
    def gave_up(self) -> bool:
        """Whether its last word is that it could not find the way."""
        return bool(self._endings) and self._endings[-1].about == GaveUpNote.about

    @property
    def _endings(self) -> list[Note]:
        return [each for each in self._notes if each.about in _ENDINGS]

    def ask(self, model: LanguageModel, request: CompletionRequest, stage: str) -> str:
        """Return a model's reply to what it is asked at a stage, such as `program`."""
        completion = model.complete(request)
        self.count(completion, stage=stage)
        return completion.text

    def count(self, completion: Completion, *, stage: str) -> None:
        """Take note of a model's reply and of what it cost; once for each reply.

        The robot stands while the model thinks: in a run, simulated time passes here. The
        stage is what was asked for, such as `program`.
        """
        if not completion.inferred:
            return
        usage = completion.usage
        self.model_calls += 1
        self.tokens += usage.prompt_tokens + usage.completion_tokens
        self.cost_usd += usage.cost_usd or 0.0
        self.inference_s += completion.latency
        stood = 0.0 if self.on_completion is None else self.on_completion(completion)
        self.add(
            ModelReplyNote(
                stage=stage,
                model=completion.model,
                text=completion.text,
                prompt_tokens=usage.prompt_tokens,
                completion_tokens=usage.completion_tokens,
                cost_usd=usage.cost_usd,
                latency=completion.latency,
                standing_s=stood,
            )
        )


def tellings_of(instruction: str) -> tuple[str, ...]:
    """Return the tellings of the way that an instruction has: one, or two in their order."""
    return tuple(instruction.split(TOLD_AGAIN))


def _checked(
    what: str,
    expected: str,
    value: Any,
    read: Callable[[Any], float],
    most: float = math.inf,
) -> float:
    # Python reads these as numbers too.
    if not isinstance(value, bool | np.bool_ | str | bytes):
        with contextlib.suppress(TypeError, ValueError):
            number = read(value)
            if math.isfinite(number) and 0 <= number <= most:
                return number
    raise ValueError(f"{what}: expected {expected}, got {value!r}")


class Agent(Protocol):
    """Follows one instruction at a time.

    The whole life of an agent:

        agent = GuideAgent()
        for episode in episodes:
            agent.follow(text, robot, journal, rng)   # returns: the agent stopped

    An agent that needs more than text and robot says so in a class attribute, which
    decides its budget, its robot and what a run records. One that declares some needs is
    refused pictures and single steps that are not among them:

        needs: ClassVar[frozenset[Need]] = frozenset({"camera", "steps"})

    How a run makes it, with its options and a language model, tells
    `memorymaze.agents.making`; what it may say before a run, `AsksModel`.

    Returning, or calling `robot.stop()`, says "we are there", unless the agent's last
    word on that is `journal.note("gave_up")`. `EpisodeOver` raised by
    the robot passes through; `ProgramError` and `LanguageModelError` may be raised and
    end the episode as `crash`, `unsafe` or `model_error`.
    """

    @property
    def name(self) -> str:
        """Name shown in tables."""
        ...

    def follow(
        self,
        instruction: str,
        robot: SteppingRobot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive the robot as the instruction says.

        An agent that needs neither steps nor pictures takes a `Robot`.
        """
        ...
