"""Any vision model as a policy: some past pictures, the current one, and a question."""

from dataclasses import dataclass

from memorymaze.agents.navid.motions import Motions
from memorymaze.agents.navid.policy import Answer, Frame, Task
from memorymaze.agents.navid.reply_grammar import reply_grammar
from memorymaze.language.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    Picture,
)
from memorymaze.language.prompt_texts import load_prompt


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
