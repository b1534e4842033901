"""Metrics of walks: pure functions of numbers and arrays, without files or clocks."""

from memorymaze.metrics.aggregate import Estimate, mean, participant_bootstrap
from memorymaze.metrics.graph import NavigationGraph
from memorymaze.metrics.score import MetricValues, score_path, score_walk
from memorymaze.metrics.success import SUCCESS_DISTANCE
from memorymaze.metrics.turns import Turn, turns_in_order, turns_taken

__all__ = [
    "SUCCESS_DISTANCE",
    "Estimate",
    "MetricValues",
    "NavigationGraph",
    "Turn",
    "mean",
    "participant_bootstrap",
    "score_path",
    "score_walk",
    "turns_in_order",
    "turns_taken",
]
