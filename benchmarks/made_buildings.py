"""Made buildings beside the benchmark's floors, in figures.

`python -m benchmarks.made_buildings [--count 10]` prints a Markdown table: what made
floors of each kind are like, and the shipped ones.
"""

import argparse
import math
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from shapely import LineString, Point

from memorymaze.basics.geometry.pose import turn_between
from memorymaze.world.construction import BUILDING_KINDS, make_building
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Site, load_site

CABOT = {1: 269, 2: 56, 3: 205, 4: 41}
"""Nodes by degree on floor 4 of CaBot's public test data (MIT licence)."""
FAR = 150.0
"""Metres."""


@dataclass(frozen=True)
class Figure:
    """Something counted or measured of one floor."""

    name: str
    of: Callable[[Site], Sequence[float]]
    """Values, of which the table shows the median and the tenths."""


def turning_point_count(site: Site) -> Sequence[float]:
    return [len(site.turning_points)]


def across(site: Site) -> Sequence[float]:
    west, south, east, north = site.walkable_floor.bounds
    return [max(east - west, north - south)]


def corridor_lengths(site: Site) -> Sequence[float]:
    return [corridor.length for corridor in site.corridors]


def corridor_widths(site: Site) -> Sequence[float]:
    return [corridor.width for corridor in site.corridors]


def odd_angles(site: Site) -> Sequence[float]:
    """Return how far angles between ways are from a right angle or a straight line."""
    found: list[float] = []
    for point in site.turning_points:
        for way, other in combinations(point.exits, 2):
            between = math.degrees(abs(turn_between(way.heading, other.heading)))
            found.append(abs((between + 45) % 90 - 45))
    return [100 * float(np.mean([angle > 5 for angle in found]))]


def sight_lines(site: Site) -> Sequence[float]:
    """Return how far one sees along the ways out of turning points."""
    walls = site.walkable_floor.boundary
    found: list[float] = []
    for point in site.turning_points:
        eye = point.polygon.centroid
        for way in point.exits:
            end = (
                eye.x + FAR * math.cos(way.heading),
                eye.y + FAR * math.sin(way.heading),
            )
            hit = LineString([(eye.x, eye.y), end]).intersection(walls)
            found.append(FAR if hit.is_empty else Point(eye).distance(hit))
    return found


def per_metre(things: Callable[[Site], int]) -> Callable[[Site], Sequence[float]]:
    """Return a count for each 10 m of wall."""
    return lambda site: [10 * things(site) / site.walkable_floor.length]


FIGURES = (
    Figure("m across", across),
    Figure("turning points", turning_point_count),
    Figure("corridor length, m", corridor_lengths),
    Figure("corridor width, m", corridor_widths),
    Figure("angles that are odd, %", odd_angles),
    Figure("sight line, m", sight_lines),
    Figure("doors per 10 m of wall", per_metre(lambda site: len(site.doors))),
    Figure("things per 10 m of wall", per_metre(lambda site: len(site.landmarks))),
)


def degrees(sites: Iterable[Site]) -> str:
    """Return the shares of turning points with 1, 2, 3 and 4 or more ways out."""
    counts = Counter(
        min(len(point.exits), 4) for site in sites for point in site.turning_points
    )
    return degree_shares(counts)


def degree_shares(counts: Counter[int] | dict[int, int]) -> str:
    whole = sum(counts.values())
    return " / ".join(f"{100 * counts[ways] / whole:.0f}" for ways in (1, 2, 3, 4))


def spread(values: Sequence[float]) -> str:
    """Return the median with the lowest and the highest tenth."""
    low, middle, high = np.percentile(values, [10, 50, 90])
    digits = 0 if middle >= 20 else 1
    if low == high:
        return f"{middle:.{digits}f}"
    return f"{middle:.{digits}f} ({low:.{digits}f}-{high:.{digits}f})"


def row(name: str, sites: Sequence[Site]) -> str:
    cells = [name, degrees(sites)]
    cells += [
        spread([value for site in sites for value in figure.of(site)])
        for figure in FIGURES
    ]
    return f"| {' | '.join(cells)} |"


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.made_buildings",
        description="Print a table of made buildings beside the benchmark's floors.",
    )
    parser.add_argument("--count", type=int, default=10, help="buildings of each kind")
    count = parser.parse_args().count
    titles = ["floors", "ways out 1/2/3/4+, %", *(figure.name for figure in FIGURES)]
    print(f"| {' | '.join(titles)} |\n|{'---|' * len(titles)}")
    for kind in BUILDING_KINDS:
        print(f"making {count} of {kind} ...", file=sys.stderr)
        sites = [make_building(kind, seed) for seed in range(count)]
        print(row(f"{kind}, made", sites))
    for name in BUILTIN_SITE_NAMES:
        print(row(f"{name}, shipped", [load_site(name)]))
    blank = " | ".join([""] * len(FIGURES))
    print(f"| CaBot's test floor | {degree_shares(CABOT)} | {blank} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
