"""What the model is shown of its earlier steps: moves in short, the end of it all."""

from dataclasses import dataclass, replace

LONGEST_FAILURE = 400
"""Characters of a reply that could not be used; the rest is not shown again."""


@dataclass(frozen=True, slots=True)
class _Step:
    said: str
    """The model's words."""
    told: str
    """What came of them."""
    short: str | None = None
    """What stays of `told` after the next move; None for all of it."""


class Scratchpad:
    """The steps of one episode.

    Only the observation of the place where the robot is now is told in full.
    """

    def __init__(self, limit: int, *, whole_steps: bool = True) -> None:
        """Begin without steps.

        Args:
            limit: Characters that are shown, the last ones.
            whole_steps: Whether steps that do not fit are left out as a whole, the
                oldest first, but the full observation last. Otherwise one is cut.
        """
        self._limit = limit
        self._whole_steps = whole_steps
        self._steps: list[_Step] = []

    def add_move(self, said: str, observation: str, short: str) -> None:
        """Add a move that was made; earlier ones are told in short from now on."""
        self._steps = [
            replace(step, told=step.told if step.short is None else step.short)
            for step in self._steps
        ]
        self._steps.append(_Step(said.strip(), observation, short))

    def add_failure(self, said: str, told: str) -> None:
        """Add a reply that led nowhere."""
        said = said.strip()
        if len(said) > LONGEST_FAILURE:
            said = said[:LONGEST_FAILURE].rstrip() + " …"
        self._steps.append(_Step(said, told))

    def text(self) -> str:
        """Return what is shown: the last characters of all steps."""
        steps = list(self._steps)
        whole = _written(steps)
        here = next((step for step in reversed(steps) if step.short), None)
        while self._whole_steps and len(steps) > 1 and len(whole) > self._limit:
            del steps[1 if steps[0] is here else 0]
            whole = _written(steps)
        return whole[-self._limit :]


def _written(steps: list[_Step]) -> str:
    return "\n".join(f"{step.said}\nObservation: {step.told}\n" for step in steps)
