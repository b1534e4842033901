"""What can be wrong with a site plan, as records."""

from typing import Literal, NamedTuple

__all__ = ["PLAN", "Finding", "Severity", "SiteProblem"]

Severity = Literal["error", "warning"]

PLAN = "-"
"""Stands for the plan as a whole where a problem names its feature."""


class SiteProblem(NamedTuple):
    """One rule that a plan breaks."""

    file: str
    """Path of the plan."""
    feature: str
    """Id of the feature, `features[3]` for one without an id, or `-` for the plan."""
    rule: str
    """Name of the rule in `docs/site_plans.md`, such as `corridor-four-corners`."""
    severity: Severity
    """`error`: something will go wrong; `warning`: unlike the benchmark's floors."""
    message: str
    """What was expected, what came, and what to do."""

    def line(self) -> str:
        """Return it as one line: `file:feature:rule: severity: message`."""
        place = f"{self.file}:{self.feature}:{self.rule}"
        return f"{place}: {self.severity}: {self.message}"


class Finding(NamedTuple):
    """A broken rule, not yet tied to a file."""

    feature: str
    rule: str
    message: str
    severity: Severity = "error"

    def in_file(self, file: str) -> SiteProblem:
        """Return it as a problem of a file."""
        return SiteProblem(file, self.feature, self.rule, self.severity, self.message)
