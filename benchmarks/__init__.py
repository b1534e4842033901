"""What the project measures of itself, beside named baselines in the same run.

`python -m benchmarks` runs all, `python -m benchmarks --only NAME` one. A benchmark is
a file here with `run() -> list[Row]` and one line in `BENCHMARKS`. What measures agents, or
texts, by many walks or words is run by itself: `arrival` and `repair` (docs/lab/benches.md),
`made_texts`, `same_walks`. What CARLA's reader makes of exported sites is `opendrive`.
"""

BENCHMARKS: dict[str, str] = {
    "lidar": "benchmarks.lidar",
    "metrics": "benchmarks.metrics",
    "films": "benchmarks.films",
    "rendering": "benchmarks.rendering",
    "scaling": "benchmarks.scaling",
    "sign_reading": "benchmarks.sign_reading",
    "simulation": "benchmarks.simulation",
    "turning_points": "benchmarks.turning_points",
}
"""Modules by name; imported only when they run."""
