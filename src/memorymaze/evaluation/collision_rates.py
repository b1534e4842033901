"""How safely a robot drove among things and people: rates over episodes."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean

from memorymaze.evaluation.results import EpisodeResult

PER_DISTANCE = ("collisions", "person_collisions", "near_misses")
"""Counts that are told per 100 m driven."""


@dataclass(frozen=True, slots=True)
class CollisionRates:
    """Rates over some episodes."""

    collisions: float
    """Per 100 m driven, with people as well."""
    person_collisions: float
    """Of those the ones with people, per 100 m driven."""
    near_misses: float
    """Per 100 m driven."""
    waiting_s: float
    """Simulated seconds of waiting for people, mean over episodes."""


def collision_rates(results: Sequence[EpisodeResult]) -> CollisionRates:
    """Return how safe episodes were; rates are sums over sums, and 0 without driving."""
    if not results:
        raise ValueError("expected at least one result")
    driven = sum(each.path_length for each in results)
    rates = [
        100 * sum(getattr(each, name) for each in results) / driven if driven else 0.0
        for name in PER_DISTANCE
    ]
    return CollisionRates(*rates, waiting_s=fmean(each.waiting_s for each in results))
