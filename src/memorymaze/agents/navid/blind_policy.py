"""A language model that is shown no picture: what the protocol is worth without seeing.

An ablation, and the only way for models that know text alone.
"""

from itertools import groupby

from memorymaze.agents.navid.motions import Motion, Motions
from memorymaze.agents.navid.policy import Answer, Frame, Task
from memorymaze.agents.navid.reply_grammar import reply_grammar
from memorymaze.agents.navid.vision_policy import asked_again, rules
from memorymaze.language.model import CompletionRequest, LanguageModel, Message

SAID_MOTIONS = 40
"""Motions so far that the model is told, each with its whole length: the last ones."""


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
