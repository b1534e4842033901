"""A language model as a policy: shown pictures, or told its motions and nothing else.

The policy without pictures is an ablation, and the only way for models that know text
alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import ClassVar

from memorymaze.agents.navid.policy import Answer, Frame, Motion, Motions, Task
from memorymaze.agents.navid.replies import reply_grammar
from memorymaze.language.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    Picture,
    Question,
)
from memorymaze.language.prompt_texts import load_prompt, prompt_version

SAID_MOTIONS = 40
"""Motions so far that the model is told, each with its whole length: the last ones."""


def chosen_frames(past: int, wanted: int) -> list[int]:
    """Return which past pictures to show: evenly spread, the first and the last too.

    >>> chosen_frames(5, 8), chosen_frames(100, 4), chosen_frames(100, 1)
    ([0, 1, 2, 3, 4], [0, 33, 66, 99], [99])
    """
    if wanted == 0 or past == 0:
        return []
    if past <= wanted:
        return list(range(past))
    if wanted == 1:
        return [past - 1]
    return [index * (past - 1) // (wanted - 1) for index in range(wanted)]


class _ModelPolicy:
    """What both policies have in common: how the model is asked."""

    prompt: ClassVar[str]
    """Name of the prompt."""

    def __init__(
        self, model: LanguageModel, *, temperature: float = 0.0, max_tokens: int = 300
    ) -> None:
        """Prepare to ask a model."""
        self._model = model
        self._temperature = temperature
        self._max_tokens = max_tokens
        text = load_prompt(self.prompt, forward="", turn="")
        self.prompts = {"act": prompt_version(text)}
        """Version of the prompt, which answers in files are compared with."""

    @property
    def name(self) -> str:
        """The model's name."""
        return self._model.name

    def ask(
        self,
        task: Task,
        told: Sequence[str],
        pictures: tuple[Picture, ...],
        number: int,
        problem: str | None,
    ) -> Answer:
        """Ask for the next motion."""
        lines = [
            "The way as it was described:",
            f'"""\n{task.instruction.strip()}\n"""',
            *told,
            "What is the next motion?",
        ]
        if problem is not None:
            lines.append(
                f"Your last answer could not be used: {problem}. Answer with one JSON "
                "object as described."
            )
        completion = self._model.complete(
            CompletionRequest(
                (
                    Message("system", rules(self.prompt, task.motions)),
                    Message("user", "\n".join(lines), pictures),
                ),
                temperature=self._temperature,
                max_tokens=self._max_tokens,
                grammar=reply_grammar(task.motions),
                question=Question("act", self.prompts["act"], number),
            )
        )
        return Answer(completion, completion.text)


class VisionPolicy(_ModelPolicy):
    """Shows pictures to a language model and asks for the next motion."""

    prompt = "navid_protocol"

    def __init__(
        self,
        model: LanguageModel,
        *,
        history: int = 8,
        history_width: int = 320,
        temperature: float = 0.0,
        max_tokens: int = 300,
    ) -> None:
        """Prepare."""
        super().__init__(model, temperature=temperature, max_tokens=max_tokens)
        self.history = history
        self.history_width = history_width

    def begin(self, task: Task) -> "_VisionSession":
        """Begin an episode."""
        return _VisionSession(self, task)


@dataclass(frozen=True, slots=True)
class _Past:
    """A picture of the way so far."""

    step: int
    picture: Picture
    caption: str


class _VisionSession:
    """One episode: remembers small pictures, asks about the current one."""

    def __init__(self, policy: VisionPolicy, task: Task) -> None:
        self._policy = policy
        self._task = task
        self._seen: list[_Past] = []
        self._asked = 0

    def observe(self, frame: Frame) -> None:
        """See `PolicySession.observe`."""
        if not self._seen or frame.step > self._seen[-1].step:
            small = frame.jpeg(self._policy.history_width)
            said = _caption(frame, self._task.motions)
            self._seen.append(_Past(frame.step, small, said))

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        """See `PolicySession.act`."""
        self.observe(frame)
        self._asked += 1
        past = self._seen[:-1]
        chosen = [past[each] for each in chosen_frames(len(past), self._policy.history)]
        told = [f"Picture {n}: {each.caption}" for n, each in enumerate(chosen, 1)]
        now = _caption(frame, self._task.motions)
        told.append(f"Picture {len(chosen) + 1}, the current one: {now}")
        pictures = (*(each.picture for each in chosen), frame.jpeg())
        return self._policy.ask(self._task, told, pictures, self._asked, problem)

    def close(self) -> None:
        """See `PolicySession.close`."""
        self._seen.clear()


def rules(prompt: str, motions: Motions) -> str:
    """Return a prompt that says which motions there are."""
    amounts = [motions.amounts(kind) for kind in ("forward", "left")]
    forward, turn = (f"{low}, {middle} or {high}" for low, middle, high in amounts)
    return load_prompt(prompt, forward=forward, turn=turn)


def _caption(frame: Frame, motions: Motions) -> str:
    if frame.step == 0:
        return "at the start"
    match frame.after:
        case "forward":
            done = f"after {motions.unit('forward')} cm forward"
        case "left" | "right":
            done = f"after turning {frame.after} by {motions.turn_deg} degrees"
        case _:
            done = "nothing was done, because the answer could not be used"
    return f"step {frame.step}, {done}"


class BlindPolicy(_ModelPolicy):
    """Tells a language model the motions so far and asks for the next one."""

    prompt = "navid_protocol_blind"

    @property
    def name(self) -> str:
        """The model's name, and that it sees nothing."""
        return f"{self._model.name}, blind"

    def begin(self, task: Task) -> "_BlindSession":
        """Begin an episode."""
        return _BlindSession(self, task)


class _BlindSession:
    """One episode: remembers the motions and no picture."""

    def __init__(self, policy: BlindPolicy, task: Task) -> None:
        self._policy = policy
        self._task = task
        self._done: list[Motion] = []
        self._shown = 0
        self._asked = 0

    def observe(self, frame: Frame) -> None:
        """See `PolicySession.observe`."""
        if frame.step > self._shown:
            self._shown = frame.step
            if frame.after is not None:
                self._done.append(frame.after)

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        """See `PolicySession.act`."""
        self.observe(frame)
        self._asked += 1
        done = _told(self._done, self._task.motions)
        told = [f"Motions so far, in {frame.step} steps: {done}"]
        return self._policy.ask(self._task, told, (), self._asked, problem)

    def close(self) -> None:
        """See `PolicySession.close`."""


def _told(done: list[Motion], motions: Motions) -> str:
    """Say motions with those of a kind in a row taken together."""
    told: list[str] = []
    for motion, group in groupby(done):
        unit = "cm" if motion == "forward" else "degrees"
        told.append(f"{motion} {motions.unit(motion) * len(list(group))} {unit}")
    left_out = ["…"] if len(told) > SAID_MOTIONS else []
    return ", ".join(left_out + told[-SAID_MOTIONS:]) or "none"
