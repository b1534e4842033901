"""How many of the words on signs and doors are read from 3 m away, facing them.

For every landmark with words and every labelled door, a robot stands 3 m from the words
where the floor allows it and nothing hides them, as squarely before them as it can. A word
is read when it is, letter by letter, among the texts within 15 degrees of straight
ahead. `python -m benchmarks.sign_reading [--signs ocr|truth] [--every N] [PLAN…]` prints
what was not read; `--pictures DIR` keeps what the camera saw.
"""

import argparse
import math
import re
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image
from shapely import Point

from benchmarks.measuring import Row
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.perception.eyes import Eyes, SignSource
from memorymaze.robot.perception.sign_reading import PICTURE_SIZE
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Site, load_site
from memorymaze.world.sites.records import Door, Landmark

DISTANCE = 3.0
"""Metres from the words."""
SQUARELY = 30
"""Degrees from which the words may be seen to count as facing them."""
FARTHEST = 60
"""Degrees; where the floor allows no better, the words are left out."""
AHEAD = 15.0
"""Degrees from straight ahead within which texts are looked at."""
ROOM = 0.3
"""Metres between the robot's middle and the edge of the floor."""
UNHIDDEN = 0.9
"""Share of the thing that must be unhidden."""
EVERY = 8
"""Of the signs, one in so many, in the benchmark; the script takes all."""


class Standpoint(NamedTuple):
    """Where words are looked at from."""

    name: str
    text: str
    pose: Pose
    angle: float
    """Degrees from which they are seen, 0 is squarely."""


@dataclass
class Tally:
    """Words read and words there."""

    read: int = 0
    words: int = 0
    missed: list[str] = field(default_factory=list[str])

    @property
    def share(self) -> float:
        """Of the words that were there."""
        return self.read / self.words if self.words else math.nan


def run() -> list[Row]:
    rows: list[Row] = []
    targets: dict[SignSource, float | None] = {"ocr": 0.8, "truth": None}
    for source, target in targets.items():
        facing, slanted, seconds = Tally(), Tally(), []
        for name in BUILTIN_SITE_NAMES:
            measure(load_site(name), source, EVERY, facing, slanted, seconds)
        what = f"words read at {DISTANCE:g} m, {source}"
        rows.append(Row(f"{what}, facing", facing.share, "", target=target))
        rows.append(Row(f"{what}, slanted", slanted.share, ""))
        rows.append(Row(f"a look for signs, {source}", float(np.median(seconds)), "s"))
    return rows


def measure(
    site: Site,
    source: SignSource,
    every: int,
    facing: Tally,
    slanted: Tally,
    seconds: list[float],
    pictures: Path | None = None,
) -> None:
    """Look at the words of a site, and add to the tallies what was read."""
    eyes = Eyes(signs=source)
    scene = build_scene(site)
    for place in list(standpoints(scene))[::every]:
        robot = SimulatedRobot(
            scene,
            place.pose,
            sign_reader=eyes.sign_reader(),
        )
        began = time.perf_counter()
        signs = robot.read_signs()
        seconds.append(time.perf_counter() - began)
        near = [sign.text for sign in signs if abs(sign.bearing_deg) <= AHEAD]
        there, read = words_of(place.text), words_of(" ".join(near))
        tally = facing if abs(place.angle) <= SQUARELY else slanted
        good = sum(word in read for word in there)
        tally.read += good
        tally.words += len(there)
        if good < len(there):
            tally.missed.append(
                f"{site.name} {place.name} at {place.angle:.0f} degrees: "
                f"{place.text!r} read as {near}"
            )
            if pictures is not None:
                pixels = robot.camera_frame(*PICTURE_SIZE).rgb
                Image.fromarray(pixels).save(pictures / f"{site.name}_{place.name}.png")


def standpoints(scene: Scene) -> Iterator[Standpoint]:
    """Yield where the words of a scene are looked at from: nothing hides them there."""
    free = scene.site.walkable_floor.buffer(-ROOM)
    angles = sorted(range(-FARTHEST, FARTHEST + 1, 5), key=abs)
    for geom, thing in enumerate(scene.objects):
        record = thing.record
        if not isinstance(record, Door | Landmark):
            continue
        text = record.label if isinstance(record, Door) else record.text
        if not text:
            continue
        x, y, _ = scene.model.geom_pos[geom]
        turn, _, _, rise = scene.model.geom_quat[geom]
        front = 2 * math.atan2(rise, turn)
        half_depth = scene.model.geom_size[geom][0]
        sides = (front, front + math.pi) if isinstance(record, Door) else (front,)
        poses = (
            (angle, _before(x, y, side, half_depth, math.radians(angle)))
            for angle in angles
            for side in sides
        )
        found = next(
            (
                Standpoint(record.id, text, pose, angle)
                for angle, pose in poses
                if free.contains(Point(pose.x, pose.y))
                and _is_in_view(scene, pose, text)
            ),
            None,
        )
        if found is not None:
            yield found


def _before(
    x: float, y: float, heading: float, half_depth: float, angle: float
) -> Pose:
    """Return the pose 3 m from the middle of a thing's front, looking at it."""
    looking = heading + angle + math.pi
    return Pose(
        x + half_depth * math.cos(heading) + DISTANCE * math.cos(heading + angle),
        y + half_depth * math.sin(heading) + DISTANCE * math.sin(heading + angle),
        math.atan2(math.sin(looking), math.cos(looking)),
    )


def _is_in_view(scene: Scene, pose: Pose, text: str) -> bool:
    return any(
        each.text == text
        and each.bearer.visible_fraction >= UNHIDDEN
        and abs(math.degrees(each.bearer.bearing)) <= AHEAD
        for each in SimulatedRobot(scene, pose).camera_view().visible_texts(5.0)
    )


def words_of(text: str) -> list[str]:
    return re.findall(r"[a-z0-9]+", text.lower())


def main() -> int:
    parser = argparse.ArgumentParser(description="Measure how well signs are read.")
    parser.add_argument("plans", nargs="*", metavar="PLAN", type=Path)
    parser.add_argument("--signs", choices=("ocr", "truth"), default="ocr")
    parser.add_argument("--every", type=int, default=1, help="one sign in so many")
    parser.add_argument("--pictures", type=Path, metavar="DIR")
    options = parser.parse_args()
    if options.pictures is not None:
        options.pictures.mkdir(parents=True, exist_ok=True)
    sites = [load_site(site) for site in options.plans or BUILTIN_SITE_NAMES]
    for site in sites:
        facing, slanted, seconds = Tally(), Tally(), []
        measure(
            site,
            options.signs,
            options.every,
            facing,
            slanted,
            seconds,
            options.pictures,
        )
        print("\n".join([*facing.missed, *slanted.missed]))
        print(
            f"{site.name}: facing {facing.read} of {facing.words} words "
            f"({facing.share:.3f}), slanted {slanted.read} of {slanted.words} "
            f"({slanted.share:.3f}), {np.median(seconds):.2f} s a look",
            flush=True,
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
