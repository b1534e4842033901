"""One measured figure, and how times are taken."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

__all__ = ["Row", "best_ms", "timed"]

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Row:
    """A figure of ours beside a baseline measured in the same run."""

    name: str
    """What was measured, on what."""
    ours: float
    unit: str
    """Of both figures, such as `ms` or `x real time`."""
    baseline: float | None = None
    baseline_name: str = ""
    """What the baseline is; empty where there is none."""
    target: float | None = None
    """Figure this project promises."""
    higher_is_better: bool = False

    @property
    def ratio(self) -> float | None:
        """How many times better ours is than the baseline."""
        if self.baseline is None:
            return None
        worse, better = self.baseline, self.ours
        return better / worse if self.higher_is_better else worse / better

    @property
    def meets_target(self) -> bool:
        """Whether ours is at least as good as promised; True without a promise."""
        if self.target is None:
            return True
        if self.higher_is_better:
            return self.ours >= self.target
        return self.ours <= self.target


def best_ms(call: Callable[[], object], repeats: int) -> float:
    """Return the shortest wall time of a call, milliseconds.

    The shortest, because whatever else the machine does can only add to it.
    """
    return min(timed(call)[1] for _ in range(repeats))


def timed(call: Callable[[], T]) -> tuple[T, float]:
    """Return what a call returns, and its wall time in milliseconds."""
    began = time.perf_counter()
    answer = call()
    return answer, (time.perf_counter() - began) * 1e3
