"""Settings of the NavGPT agent, and the limits that come of them on a site."""

import math
from dataclasses import dataclass
from typing import Literal

from memorymaze.errors import SettingsError

RELEASED_ITERATIONS = 10
RELEASED_SCRATCHPAD = 7000
FAIR_ITERATIONS = 2.0
"""Requests per viewpoint on the longest route."""
FAIR_FAILURES = 10
"""As many as the released budget has requests in all."""


@dataclass(frozen=True, slots=True)
class NavGPTOptions:
    """What can be set of the NavGPT agent.

    Raises:
        SettingsError: A value has no meaning.
    """

    budget: Literal["fair", "released"] = "fair"
    """Limits of the loop: `released` as the released code has them (10 requests, a
    scratchpad of 7000 characters), `fair` scaled to the longest route of the site."""
    iterations: int | None = None
    """Requests in an episode at most; none for what the budget says."""
    scratchpad: int | None = None
    """Characters of earlier steps that the model is shown; none for what the budget
    says."""
    failures: int | None = None
    """Replies in a row that cannot be used, or moves refused, after which the episode
    ends as `stuck`; none for what the budget says (fair: 10, released: no limit)."""
    faithful: bool = False
    """Whether two faults of the released code are kept: neighbours at headings from
    337.5 degrees on are not shown, and of things of one name in a direction only one."""
    captions: Literal["templates", "vision"] = "templates"
    """Who describes what is seen: templates filled with what the camera truly sees, or a
    vision model that is shown pictures."""
    caption_model: str | None = None
    """Vision model of the captions; none for the agent's own model."""
    caption_file: str = "navgpt_captions.sqlite"
    """File in which a vision model's captions are kept and looked up."""
    grammar: bool = True
    """Whether local models that can be held to a grammar are held to well-formed replies
    and listed viewpoints; other models answer freely."""
    temperature: float = 0.0
    """Of the requests."""
    max_tokens: int = 1024
    """Longest reply."""
    seed: int | None = None
    """Passed to the model; none for none."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        for name in ("iterations", "scratchpad", "failures", "max_tokens"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise SettingsError(
                    f"--set {name}: expected a whole number of at least 1, got {value}"
                )
        if not (math.isfinite(self.temperature) and self.temperature >= 0):
            raise SettingsError(
                f"--set temperature: expected at least 0, got {self.temperature}"
            )
        if self.captions == "templates" and self.caption_model is not None:
            raise SettingsError(
                "--set caption_model: templates ask no model; add --set captions=vision"
            )


@dataclass(frozen=True, slots=True)
class LoopLimits:
    """When the loop is broken off, and how far back the model sees."""

    iterations: int
    """Requests in an episode at most."""
    scratchpad: int
    """Characters of earlier steps that the model is shown."""
    failures: int | None
    """Failures in a row after which the episode ends as `stuck`; None for no limit."""


def loop_limits(options: NavGPTOptions, longest_route: int) -> LoopLimits:
    """Return the limits of an episode.

    Fair: two requests for each viewpoint of the site's longest route, and a scratchpad
    that grows with them as in the released code, 700 characters for each.

    Args:
        options: Which budget, and what is set besides.
        longest_route: Viewpoints along the longest route of the site, whatever the route
            of the episode, so that the limits tell nothing of it.
    """
    iterations, scratchpad, failures = RELEASED_ITERATIONS, RELEASED_SCRATCHPAD, None
    if options.budget == "fair":
        iterations = max(iterations, math.ceil(FAIR_ITERATIONS * longest_route))
        scratchpad = iterations * RELEASED_SCRATCHPAD // RELEASED_ITERATIONS
        failures = FAIR_FAILURES
    return LoopLimits(
        iterations=options.iterations or iterations,
        scratchpad=options.scratchpad or scratchpad,
        failures=options.failures or failures,
    )
