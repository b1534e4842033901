"""What can be wrong with a site plan, as records."""

from dataclasses import dataclass
from typing import Literal

__all__ = ["SiteProblem"]


@dataclass(frozen=True, slots=True)
class SiteProblem:
    """One rule that a plan breaks.

    `str()` of it is one line: `file:feature:rule: severity: message`.
    """

    file: str
    """Path of the plan."""
    feature: str
    """Id of the feature, `features[3]` for one without an id, or `-` for the plan."""
    rule: str
    """Name of the rule in `docs/site_plans.md`, such as `corridor-four-corners`."""
    severity: Literal["error", "warning"]
    message: str
    """What was expected, what came, and what to do."""

    def __str__(self) -> str:
        return (
            f"{self.file}:{self.feature}:{self.rule}: {self.severity}: {self.message}"
        )
