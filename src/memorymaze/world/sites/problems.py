"""What can be wrong with a site plan, as records."""

from typing import Literal, NamedTuple

Severity = Literal["error", "warning"]

Rule = Literal[
    "readable",
    "json",
    "members",
    "known-kind",
    "unique-id",
    "ring-closed",
    "polygon-valid",
    "line-steps",
    "corridor-four-corners",
    "corridor-convex",
    "known-reference",
    "one-reference",
    "floor-size",
    "floor-connected",
    "floor-free",
    "route-on-floor",
    "floor-seams",
    "turning-point-convex",
    "exit-touches",
    "exit-heading",
    "room-beside-floor",
    "door-on-wall",
    "door-at-room",
    "landmark-on-floor",
    "landmark-inside-walls",
    "landmark-on-wall",
    "landmark-faces-floor",
    "route-length",
    "route-clearance",
    "route-goal",
    "turn-on-route",
    "turn-direction",
    "published-length",
    "floor-passable",
    "floor-extent",
    "corridor-width",
    "exit-apart",
    "door-width",
    "landmark-overhead",
    "route-start-heading",
    "turn-bends",
    "turning-point-count",
    "thing-count",
    "route-names",
    "name-is-stem",
    "id-snake-case",
    "known-word",
    "heading-range",
    "known-look",
]
"""Names of the rules; `docs/buildings.md` explains each in this order."""

PLAN = "-"
"""Stands for the plan as a whole where a problem names its feature."""


class SiteProblem(NamedTuple):
    """One rule that a plan breaks."""

    feature: str
    """Id of the feature, `features[3]` for one without an id, or `-` for the plan."""
    rule: Rule
    """Such as `corridor-four-corners`."""
    message: str
    """What was expected, what came, and what to do."""
    severity: Severity = "error"
    """`error`: something will go wrong; `warning`: unlike the benchmark's floors."""
    file: str = ""
    """Path of the plan."""

    def line(self) -> str:
        """Return it as one line: `file:feature:rule: severity: message`."""
        place = f"{self.file}:{self.feature}:{self.rule}"
        return f"{place}: {self.severity}: {self.message}"
