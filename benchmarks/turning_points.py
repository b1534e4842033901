"""How well LiDAR finds the turning points that the plans annotate, and how fast.

A robot follows every route, reference and alternative; a sensed turning point is right
when it lies within 1.5 m of an annotated one that is passed at the time and tells the
same directions. `python -m benchmarks.turning_points [--noise LEVEL] PLAN…` prints every
miss and false alarm, for the benchmark's sites or other plans; noise is given as in runs.
"""

import argparse
import math
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from shapely import Point, Polygon

from benchmarks.measuring import Row
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.api.control import Direction
from memorymaze.robot.perception.turning_points import TurningPointFinder
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.senses.lidar import Lidar
from memorymaze.robot.simulation.senses.noise import NoiseSettings, parse_noise
from memorymaze.robot.simulation.senses.odometry import Odometry
from memorymaze.robot.simulation.senses.turning_points import AnnotatedTurningPoints
from memorymaze.robot.steering.commands import direction_of
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Site, load_site
from memorymaze.world.sites.records import Route

NEAR = 1.5
"""Metres between a sensed turning point and the area of the annotated one."""
MEANWHILE = 2.0
"""Seconds between the two stays."""
APART = 1.0
"""Seconds outside after which the same turning point is a new stay."""

Directions = frozenset[Direction | None]


def run() -> list[Row]:
    rows: list[Row] = []
    everything = Tally()
    for name in BUILTIN_SITE_NAMES:
        tally = Tally()
        for walk in walks(load_site(name)):
            tally.add(walk)
            everything.add(walk)
        rows += tally.rows(name)
    rows += everything.rows("all sites", target=0.85)
    rows.append(
        Row(
            "a scan taken in, median",
            float(np.median(everything.milliseconds)),
            "ms",
            target=5.0,
        )
    )
    return rows


@dataclass
class Stay:
    """A stay in a turning point, annotated or sensed."""

    name: str | int
    since: float
    until: float
    course: float
    answers: list[tuple[float, ...]] = field(default_factory=list)
    """Headings of the ways onward, every time they were asked for."""
    places: list[tuple[float, float]] = field(default_factory=list)

    @property
    def place(self) -> Point:
        """Where its ways meet, by most of what was sensed."""
        return Point(np.median(np.array(self.places), axis=0))

    def directions(self, course: float) -> Directions:
        """Return the directions told most of the time, seen from a course."""
        told: Counter[Directions] = Counter()
        for headings in self.answers:
            words: set[Direction | None] = {
                direction_of(turn_between(course, each)) for each in headings
            }
            words.discard(None)
            told[frozenset(words)] += 1
        return told.most_common(1)[0][0]


class Walk(NamedTuple):
    """What one route gave."""

    site: Site
    route: Route
    annotated: list[Stay]
    sensed: list[Stay]
    pairs: list[tuple[Stay, Stay]]
    milliseconds: list[float]

    @property
    def right(self) -> list[tuple[Stay, Stay]]:
        """Pairs that tell the same directions."""
        return [
            (truth, sensed)
            for truth, sensed in self.pairs
            if truth.directions(truth.course) == sensed.directions(truth.course)
        ]


@dataclass
class Tally:
    """Counts over walks."""

    passed: int = 0
    sensed: int = 0
    placed: int = 0
    right: int = 0
    milliseconds: list[float] = field(default_factory=list)

    def add(self, walk: Walk) -> None:
        """Count a walk."""
        self.passed += len(walk.annotated)
        self.sensed += len(walk.sensed)
        self.placed += len(walk.pairs)
        self.right += len(walk.right)
        self.milliseconds += walk.milliseconds

    def rows(self, name: str, target: float | None = None) -> list[Row]:
        """Return precision and recall, without and with the directions."""
        what = f"{name}: turning points by LiDAR"
        return [
            Row(
                f"{what}, {kind} of {count} ({condition})",
                found / max(count, 1),
                "",
                target=target if condition == "place and directions" else None,
                higher_is_better=True,
            )
            for condition, found in (
                ("place", self.placed),
                ("place and directions", self.right),
            )
            for kind, count in (("precision", self.sensed), ("recall", self.passed))
        ]


def walks(site: Site, noise: NoiseSettings | None = None) -> Iterator[Walk]:
    """Follow every route of a site."""
    scene = build_scene(site)
    areas: dict[str | int, Polygon] = {
        each.id: each.polygon for each in site.turning_points
    }
    for number, route in enumerate(site.routes):
        robot = SimulatedRobot(scene, route.start, rng=np.random.default_rng(number))
        robot.follow(np.asarray(route.line.coords)[:, :2])
        rng = np.random.default_rng(number)
        lidar = Lidar(scene, None, None if noise is None else noise.lidar, rng)
        odometry = Odometry(route.start, None if noise is None else noise.odometry, rng)
        finder, visits = TurningPointFinder(), AnnotatedTurningPoints(scene)
        annotated: list[Stay] = []
        sensed: list[Stay] = []
        milliseconds: list[float] = []
        last, course = route.start, route.start.heading
        for at, *place in robot.trajectory().poses:
            pose = Pose(*place)
            if math.dist(last[:2], pose[:2]) > 0.05:
                course = math.atan2(pose.y - last.y, pose.x - last.x)
                last = pose
            if last is pose or at == 0:
                visits.update(pose, course, at)
            believed = odometry.update(pose)
            scan = lidar.scan(pose, at)
            began = time.process_time()
            finder.update(believed, scan.angles, scan.ranges)
            milliseconds.append((time.process_time() - began) * 1e3)
            visit, found = visits.current, finder.current
            if visit is not None and visit.onward():
                headings = tuple(each.heading for each in visit.onward())
                note(annotated, visit.point.id, at, course, headings)
            if found is not None:
                turn = turn_between(believed.heading, pose.heading)
                headings = tuple(each.heading + turn for each in found.onward)
                dx, dy = found.x - believed.x, found.y - believed.y
                note(sensed, found.number, at, course, headings).places.append((
                    pose.x + dx * math.cos(turn) - dy * math.sin(turn),
                    pose.y + dx * math.sin(turn) + dy * math.cos(turn),
                ))
        pairs = paired(annotated, sensed, areas)
        yield Walk(site, route, annotated, sensed, pairs, milliseconds)


def note(
    stays: list[Stay],
    name: str | int,
    at: float,
    course: float,
    headings: tuple[float, ...],
) -> Stay:
    if not stays or stays[-1].name != name or at - stays[-1].until > APART:
        stays.append(Stay(name, at, at, course))
    stays[-1].until = at
    stays[-1].answers.append(headings)
    return stays[-1]


def paired(
    annotated: list[Stay], sensed: list[Stay], areas: dict[str | int, Polygon]
) -> list[tuple[Stay, Stay]]:
    """Pair stays one to one, those whose places fit best first."""
    fitting = sorted(
        (each.place.distance(areas[truth.name].centroid), i, j)
        for i, truth in enumerate(annotated)
        for j, each in enumerate(sensed)
        if each.place.distance(areas[truth.name]) <= NEAR
        and each.since <= truth.until + MEANWHILE
        and truth.since <= each.until + MEANWHILE
    )
    pairs: dict[int, int] = {}
    for _, i, j in fitting:
        if i not in pairs and j not in pairs.values():
            pairs[i] = j
    return [(annotated[i], sensed[j]) for i, j in sorted(pairs.items())]


def failures(walk: Walk) -> Iterator[str]:
    where = f"{walk.site.name} {walk.route.id}"
    right = [id(stay) for pair in walk.right for stay in pair]
    found = [id(stay) for pair in walk.pairs for stay in pair]
    for truth, sensed in walk.pairs:
        if id(truth) not in right:
            yield (
                f"{where}: {truth.name}: {in_words(truth.directions(truth.course))}, "
                f"sensed {in_words(sensed.directions(truth.course))}"
            )
    for truth in walk.annotated:
        if id(truth) not in found:
            yield f"{where}: {truth.name} missed: {in_words(truth.directions(truth.course))}"
    for sensed in walk.sensed:
        if id(sensed) not in found:
            place = sensed.place
            yield (
                f"{where}: none at ({place.x:.1f}, {place.y:.1f}), sensed "
                f"{in_words(sensed.directions(sensed.course))}"
            )


def in_words(directions: Iterable[Direction | None]) -> str:
    return ", ".join(sorted(str(each) for each in directions))


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.turning_points",
        description="Compare turning points sensed by LiDAR with those of plans.",
        epilog="example: python -m benchmarks.turning_points university --noise heavy",
    )
    parser.add_argument("plan", nargs="*", default=BUILTIN_SITE_NAMES)
    parser.add_argument(
        "--noise", metavar="LEVEL", type=parse_noise, help="of LiDAR and odometry"
    )
    chosen = parser.parse_args()
    for plan in chosen.plan:
        tally = Tally()
        for walk in walks(load_site(plan), chosen.noise):
            tally.add(walk)
            for line in failures(walk):
                print(line)
        for row in tally.rows(Path(plan).stem):
            print(f"{row.name}: {row.ours:.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
