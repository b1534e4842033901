"""What a language model is asked: shown pictures, or told its motions and nothing else.

Without pictures it is an ablation, and the only way for models that know text alone.
"""

from dataclasses import dataclass
from itertools import groupby

from memorymaze.agents.navid.motions import Frame, Motion, Motions
from memorymaze.agents.navid.options import NavidOptions
from memorymaze.agents.navid.replies import navid_reply_grammar
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
    Picture,
)
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version

SAID_MOTIONS = 40
"""Motions so far that the model is told, each with its whole length: the last ones."""


def chosen_frames(past: int, wanted: int) -> list[int]:
    """Return which past pictures to show: evenly spread, the first and the last too.

    >>> chosen_frames(5, 8), chosen_frames(100, 4), chosen_frames(100, 1)
    ([0, 1, 2, 3, 4], [0, 33, 66, 99], [99])
    """
    if past <= wanted:
        return list(range(past))
    if wanted < 2:
        return [past - 1] * wanted
    return [index * (past - 1) // (wanted - 1) for index in range(wanted)]


def rules(prompt: str, motions: Motions) -> str:
    """Return a prompt that says which motions there are."""
    amounts = [motions.amounts(kind) for kind in ("forward", "left")]
    forward, turn = (f"{low}, {middle} or {high}" for low, middle, high in amounts)
    return load_prompt(prompt, forward=forward, turn=turn)


def version(prompt: str) -> str:
    """Return the version of a prompt, which answers in files are compared with."""
    return prompt_version(load_prompt(prompt, forward="", turn=""))


@dataclass(frozen=True, slots=True)
class _Past:
    """A step of the way so far."""

    step: int
    after: Motion | None
    caption: str
    picture: Picture | None
    """Small; None for a model that is shown none."""


class PolicySession:
    """One episode: remembers the way so far, and asks about the current place."""

    def __init__(
        self, model: LanguageModel, options: NavidOptions, instruction: str
    ) -> None:
        """Begin with a way of no steps."""
        self._model = model
        self._options = options
        self._instruction = instruction
        self._motions = options.motions
        self._past: list[_Past] = []
        self._asked = 0

    def observe(self, frame: Frame) -> None:
        """Remember a picture without asking anything."""
        if self._past and frame.step <= self._past[-1].step:
            return
        small = None
        if not self._options.is_blind:
            small = frame.jpeg(self._options.history_width)
        said = _caption(frame, self._motions)
        self._past.append(_Past(frame.step, frame.after, said, small))

    def act(self, frame: Frame, problem: str | None = None) -> Completion:
        """Show a picture, the current one, and ask for the next motion.

        `problem` says what was wrong with the last answer to the same picture.
        """
        self.observe(frame)
        self._asked += 1
        options = self._options
        told, pictures = self._blind(frame) if options.is_blind else self._view(frame)
        lines = [
            "The way as it was described:",
            f'"""\n{self._instruction.strip()}\n"""',
            *told,
            "What is the next motion?",
        ]
        if problem is not None:
            lines.append(
                f"Your last answer could not be used: {problem}. Answer with one JSON "
                "object as described."
            )
        return self._model.complete(
            CompletionRequest(
                (
                    Message("system", rules(options.prompt, self._motions)),
                    Message("user", "\n".join(lines), pictures),
                ),
                temperature=options.temperature,
                max_tokens=options.max_tokens,
                grammar=navid_reply_grammar(self._motions),
                question=ModelQuestion("act", version(options.prompt), self._asked),
            )
        )

    def _view(self, frame: Frame) -> tuple[list[str], tuple[Picture, ...]]:
        """Return captions and pictures of some of the way, and of this place."""
        chosen = chosen_frames(len(self._past) - 1, self._options.history)
        shown = [self._past[each] for each in chosen]
        told = [f"Picture {n}: {each.caption}" for n, each in enumerate(shown, 1)]
        now = _caption(frame, self._motions)
        told.append(f"Picture {len(shown) + 1}, the current one: {now}")
        small = (each.picture for each in shown if each.picture is not None)
        return told, (*small, frame.jpeg())

    def _blind(self, frame: Frame) -> tuple[list[str], tuple[Picture, ...]]:
        """Return the motions so far, those of a kind in a row taken together."""
        motions = self._motions
        told: list[str] = []
        made: list[Motion] = [each.after for each in self._past if each.after]
        for motion, group in groupby(made):
            unit = "cm" if motion == "forward" else "degrees"
            told.append(f"{motion} {motions.unit(motion) * len(list(group))} {unit}")
        left_out = ["…"] if len(told) > SAID_MOTIONS else []
        done = ", ".join(left_out + told[-SAID_MOTIONS:]) or "none"
        return [f"Motions so far, in {frame.step} steps: {done}"], ()


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
