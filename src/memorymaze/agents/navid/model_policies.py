"""A language model as a policy: shown pictures, or told its motions and nothing else.

The policy without pictures is an ablation, and the only way for models that know text
alone.
"""

from dataclasses import dataclass
from itertools import groupby

from memorymaze.agents.navid.policy import Answer, Frame, Motion, Motions, Task
from memorymaze.agents.navid.replies import reply_grammar
from memorymaze.language.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    Picture,
)
from memorymaze.language.prompt_texts import load_prompt

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


class VisionPolicy:
    """Shows pictures to a language model and asks for the next motion."""

    def __init__(
        self,
        model: LanguageModel,
        *,
        history: int = 8,
        history_width: int = 320,
        temperature: float = 0.0,
        max_tokens: int = 300,
    ) -> None:
        """Prepare.

        Args:
            model: Understands pictures.
            history: Past pictures in a request, at most.
            history_width: Their width, pixels.
            temperature: Of each request.
            max_tokens: Longest reply.
        """
        self._model = model
        self._history = history
        self._history_width = history_width
        self._temperature = temperature
        self._max_tokens = max_tokens

    @property
    def name(self) -> str:
        """The model's name."""
        return self._model.name

    def begin(self, task: Task) -> "_VisionSession":
        """Begin an episode."""
        return _VisionSession(self, task)

    def ask(self, task: Task, past: "list[_Past]", frame: Frame, again: str) -> Answer:
        """Ask about a picture.

        Args:
            task: The episode.
            past: All pictures before the current one.
            frame: The current picture.
            again: What to say besides, where the model is asked again; may be empty.
        """
        chosen = [past[index] for index in chosen_frames(len(past), self._history)]
        shown = [
            f"Picture {number}: {each.caption}" for number, each in enumerate(chosen, 1)
        ]
        shown.append(
            f"Picture {len(chosen) + 1}, the current one: "
            f"{_caption(frame, task.motions)}"
        )
        text = "\n".join([
            "The way as it was described:",
            f'"""\n{task.instruction.strip()}\n"""',
            *shown,
            "What is the next motion?",
            *([again] if again else []),
        ])
        pictures = (*(each.picture for each in chosen), frame.jpeg())
        request = CompletionRequest(
            (
                Message("system", rules("navid_protocol", task.motions)),
                Message("user", text, pictures),
            ),
            temperature=self._temperature,
            max_tokens=self._max_tokens,
            grammar=reply_grammar(task.motions),
        )
        completion = self._model.complete(request)
        return Answer(completion, completion.text)

    def remembered(self, task: Task, frame: Frame) -> "_Past":
        """Return what is kept of a picture."""
        small = frame.jpeg(self._history_width)
        return _Past(frame.step, small, _caption(frame, task.motions))


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

    def observe(self, frame: Frame) -> None:
        """See `PolicySession.observe`."""
        if not self._seen or frame.step > self._seen[-1].step:
            self._seen.append(self._policy.remembered(self._task, frame))

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        """See `PolicySession.act`."""
        self.observe(frame)
        return self._policy.ask(
            self._task, self._seen[:-1], frame, asked_again(problem)
        )

    def close(self) -> None:
        """See `PolicySession.close`."""
        self._seen.clear()


def rules(prompt: str, motions: Motions) -> str:
    """Return a prompt that says which motions there are."""
    amounts = [motions.amounts(kind) for kind in ("forward", "left")]
    forward, turn = (f"{low}, {middle} or {high}" for low, middle, high in amounts)
    return load_prompt(prompt, forward=forward, turn=turn)


def asked_again(problem: str | None) -> str:
    """Return what to say to a model that is asked again; empty where it is not."""
    if problem is None:
        return ""
    return (
        f"Your last answer could not be used: {problem}. Answer with one JSON object as "
        "described."
    )


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


class BlindPolicy:
    """Tells a language model the motions so far and asks for the next one."""

    def __init__(
        self, model: LanguageModel, *, temperature: float = 0.0, max_tokens: int = 300
    ) -> None:
        """Prepare."""
        self._model = model
        self._temperature = temperature
        self._max_tokens = max_tokens

    @property
    def name(self) -> str:
        """The model's name, and that it sees nothing."""
        return f"{self._model.name}, blind"

    def begin(self, task: Task) -> "_BlindSession":
        """Begin an episode."""
        return _BlindSession(self, task)

    def ask(self, task: Task, done: list[Motion], step: int, again: str) -> Answer:
        """Ask for the next motion.

        Args:
            task: The episode.
            done: All motions so far.
            step: Steps done so far, those without a motion too.
            again: What to say besides, where the model is asked again; may be empty.
        """
        text = "\n".join([
            "The way as it was described:",
            f'"""\n{task.instruction.strip()}\n"""',
            f"Motions so far, in {step} steps: {_told(done, task.motions)}",
            "What is the next motion?",
            *([again] if again else []),
        ])
        request = CompletionRequest(
            (
                Message("system", rules("navid_protocol_blind", task.motions)),
                Message("user", text),
            ),
            temperature=self._temperature,
            max_tokens=self._max_tokens,
            grammar=reply_grammar(task.motions),
        )
        completion = self._model.complete(request)
        return Answer(completion, completion.text)


class _BlindSession:
    """One episode: remembers the motions and no picture."""

    def __init__(self, policy: BlindPolicy, task: Task) -> None:
        self._policy = policy
        self._task = task
        self._done: list[Motion] = []
        self._shown = 0

    def observe(self, frame: Frame) -> None:
        """See `PolicySession.observe`."""
        if frame.step > self._shown:
            self._shown = frame.step
            if frame.after is not None:
                self._done.append(frame.after)

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        """See `PolicySession.act`."""
        self.observe(frame)
        return self._policy.ask(
            self._task, self._done, frame.step, asked_again(problem)
        )

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
