"""What can be set of the NaVid protocol's agent, and how many steps that allows."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.agents.agent import FairLimits
from memorymaze.agents.navid.motions import WIDTH, Motions
from memorymaze.basics.options import check_least, check_number

RELEASED_STEPS = 400
"""Steps after which the released evaluation on R2R breaks off; on RxR it is 500."""


@dataclass(frozen=True, slots=True)
class NavidOptions:
    """What can be set of the NaVid protocol's agent."""

    budget: Literal["fair", "released"] = "fair"
    """Steps of an episode: `released` as the released code has them (400, for R2R),
    `fair` three times those of the longest route of the site."""
    max_steps: int | None = None
    """Steps of an episode at most; none for what the budget says. The released code
    has 500 for RxR."""
    still_steps: int = 25
    """Steps in a row without a step ahead after which the episode ends as `stuck`."""
    turn_deg: Literal[15, 30] = 30
    """Degrees of one turn; an answer turns by one, two or three of them."""
    faithful: bool = False
    """Whether replies are read as the released code reads them, with its faults, and
    an unreadable one becomes a random motion that is not a stop."""
    failures: int = 5
    """Unreadable decisions in a row after which the episode ends as `model_error`;
    each is asked for once more before. Not with `faithful`."""
    pictures: Literal["shown", "none"] = "shown"
    """Whether the model is shown pictures: `none` is an ablation, told as `blind` in
    tables, and the only way for models that know text alone."""
    history: int = 8
    """Past pictures that the model is shown: spread evenly, with the last one."""
    history_width: int = 320
    """Pixels of the width of past pictures; the current one has 640."""
    temperature: float = 0.0
    """Of the requests (the released code: 0.2)."""
    max_tokens: int = 300
    """Longest reply."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_least(
            self, max_steps=1, still_steps=1, failures=1, history=0, max_tokens=1
        )
        check_number("--set history_width", self.history_width, 32, WIDTH, whole=True)
        check_number("--set temperature", self.temperature, 0)

    @property
    def is_blind(self) -> bool:
        """Whether the model is shown no pictures."""
        return self.pictures == "none"

    @property
    def prompt(self) -> str:
        """Name of the prompt."""
        return "navid_protocol" + "_blind" * self.is_blind

    @property
    def motions(self) -> Motions:
        """The primitive motions."""
        return Motions(turn_deg=self.turn_deg)

    def step_limit(self, fair: FairLimits | None) -> int | None:
        """Return the steps of an episode at most; None where only the run's budgets count."""
        if self.max_steps is not None:
            return self.max_steps
        if self.budget == "released":
            return RELEASED_STEPS
        return None if fair is None else fair.steps[self.turn_deg]
