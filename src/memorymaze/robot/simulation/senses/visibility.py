"""What the camera of a robot really sees, by casting rays; no OpenGL.

A pinhole camera of 640x480 pixels, 90 degrees wide, at the lens of the robot, looking
ahead horizontally. Things are boxes of their true size; walls and other things hide
them. Rooms are not things: one sees their doors and signs.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import RenderingError
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.robot.api.steps import CameraPicture
from memorymaze.robot.perception.camera_view import (
    Draw,
    VisibleObject,
    VisibleText,
    Wanted,
)
from memorymaze.robot.simulation.motion.wheeled_base import ROBOT_GROUP
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.senses.sight_targets import (
    SightTargets,
    inscription,
    movable_targets,
    sight_targets,
)

WIDTH, HEIGHT = 640, 480
FOCAL_LENGTH = WIDTH / 2 / math.tan(math.pi / 4)
"""Pixels."""
LEAST_FRACTION = 0.25
"""Of a thing's part in the picture so much must be unhidden to recognise it."""
LEAST_SHARE = 0.2
"""Of all sides turned to the camera, cut off by the picture's edge or hidden or not,
so much must be seen, unless what is seen is large in the picture."""
LARGE_AREA = 0.05 * WIDTH * HEIGHT
"""Square pixels from which on `LEAST_SHARE` does not matter."""
LEAST_PIXELS = 8.0
"""Width and height in the picture below which a thing is not recognised."""
TOUCH = 0.03
"""A ray that ends within so many metres of a point has reached it."""
LARGEST_MOVABLE = 2.0
"""Metres from the middle of a thing or person to its farthest part, at most."""
SIGNS = np.array([-1.0, 1.0])[:, np.newaxis, np.newaxis]
NOT_THE_ROBOT = np.array([group != ROBOT_GROUP for group in range(6)], dtype=np.uint8)
"""By geom group, whether rays meet it."""
NEAREST = 0.05
"""Depth in metres below which nothing is seen."""


class _Seen(NamedTuple):
    geom: int
    thing: VisibleObject


_Choose = Callable[[SightTargets, NDArray[np.int64]], list[int]]
"""Which of some targets, by their numbers, one looks for."""


class _Reach(NamedTuple):
    """Targets, which of them may be seen, and what was seen of those looked at."""

    targets: SightTargets
    numbers: NDArray[np.int64]
    looked_at: dict[int, _Seen | None]


class RayCamera:
    """One look of the robot's camera; implements `CameraView`."""

    def __init__(
        self, scene: Scene, data: mujoco.MjData, draw: Draw | None = None
    ) -> None:
        """Look from where the lens is in a physics state whose poses are up to date.

        `draw` is for those who ask for a picture; None has none.
        """
        self._scene = scene
        self._data = data
        self._draw = draw
        self._looked_at: dict[int, _Seen | None] = {}
        """What is seen of the site's targets, by number; None for nothing."""
        self._reaches: dict[float, list[_Reach]] = {}
        """By range limit; a look is one moment, and is often asked about."""
        lens = data.cam("eye")
        self._eye = np.array(lens.xpos)
        backwards = lens.xmat.reshape(3, 3)[:, 2]
        heading = math.atan2(-backwards[1], -backwards[0])
        self._ahead = np.array([math.cos(heading), math.sin(heading), 0.0])
        self._left = np.array([-math.sin(heading), math.cos(heading), 0.0])
        x, y, _ = self._eye.tolist()
        self.pose = Pose(x, y, heading)
        """Where the lens is and which way it looks."""

    def picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """Draw what is seen; see `CameraView.picture`."""
        if self._draw is None:
            raise RenderingError("this view was made without a camera that draws")
        return self._draw(width, height, horizontal_fov)

    def visible_objects(
        self, range_limit: float, wanted: Wanted | None = None
    ) -> list[VisibleObject]:
        """Return the things seen whose nearest seen part is within the limit."""

        def looked_for(targets: SightTargets, numbers: NDArray[np.int64]) -> list[int]:
            near = numbers.tolist()
            return near if wanted is None else targets.wanted(near, wanted)

        return [each.thing for each in self._things_seen(range_limit, looked_for)]

    def visible_texts(
        self, range_limit: float, widest: float = math.pi
    ) -> list[VisibleText]:
        """Return what is written on the things seen within the limit."""

        def turned_here(targets: SightTargets, numbers: NDArray[np.int64]) -> list[int]:
            written = numbers[targets.written[numbers]]
            geoms = zip(written.tolist(), targets.geoms[written].tolist(), strict=True)
            return [each for each, geom in geoms if self._facing(geom) <= widest]

        bearers = self._things_seen(range_limit, turned_here)
        return [self._text_on(each) for each in bearers]

    def _text_on(self, seen: _Seen) -> VisibleText:
        written = inscription(self._scene, seen.geom)
        _, to_lens = self._front_and_lens(seen.geom)
        depth = max(float(-to_lens @ self._ahead), NEAREST)
        return VisibleText(
            text=written.text,
            bearer=seen.thing,
            facing=self._facing(seen.geom),
            letter_height=written.letter_height * FOCAL_LENGTH / depth,
            cut=written.fills_it and _is_cut(seen.thing.box),
        )

    def _facing(self, geom: int) -> float:
        """Return how far a text on a thing is turned away from the lens; radians."""
        (x, y, _), (to_x, to_y, _) = map(np.ndarray.tolist, self._front_and_lens(geom))
        cosine = (x * to_x + y * to_y) / math.hypot(to_x, to_y)
        facing = math.acos(min(max(cosine, -1.0), 1.0))
        both_sides = inscription(self._scene, geom).both_sides
        return min(facing, math.pi - facing) if both_sides else facing

    def _front_and_lens(self, geom: int) -> tuple[FloatArray, FloatArray]:
        """Return where the front of a thing looks, and the vector from it to the lens."""
        front = self._data.geom_xmat[geom].reshape(3, 3)[:, 0]
        half_depth = self._scene.model.geom_size[geom, 0]
        return front, self._eye - (self._data.geom_xpos[geom] + half_depth * front)

    def _things_seen(self, range_limit: float, choose: _Choose) -> list[_Seen]:
        """Return the things seen that are chosen."""
        found: list[_Seen | None] = []
        for reach in self._within(range_limit):
            near = choose(reach.targets, reach.numbers)
            known = reach.looked_at
            unknown = [each for each in near if each not in known]
            known.update(self._look_at(reach.targets, unknown))
            found += [known[each] for each in near]
        return [
            each
            for each in found
            if each is not None and each.thing.distance <= range_limit
        ]

    def _within(self, range_limit: float) -> list[_Reach]:
        """Return what may be seen within the limit: of the site, and of what moves in it."""
        if range_limit not in self._reaches:
            fixed = sight_targets(self._scene)
            numbers = self._candidates(fixed, range_limit)
            reaches = [_Reach(fixed, numbers, self._looked_at)]
            if self._scene.movables:
                reach = range_limit + LARGEST_MOVABLE
                nearby = movable_targets(self._scene, self._data, self._eye, reach)
                numbers = self._candidates(nearby, range_limit)
                reaches.append(_Reach(nearby, numbers, {}))
            self._reaches[range_limit] = reaches
        return self._reaches[range_limit]

    def _look_at(
        self, targets: SightTargets, numbers_of: list[int]
    ) -> dict[int, _Seen | None]:
        """Return what is seen of some targets, by number; everything may hide them."""
        if not numbers_of:
            return {}
        near = np.array(numbers_of)
        begins = targets.first_points[near]
        counts = targets.first_points[near + 1] - begins
        owners = np.repeat(np.arange(len(near)), counts)
        numbers = np.arange(len(owners)) + (begins + counts - counts.cumsum())[owners]
        offsets = targets.points[numbers] - self._eye
        facing = -np.einsum("ij,ij->i", offsets, targets.normals[numbers])
        turned_to_us = facing > 0
        numbers, owners = numbers[turned_to_us], owners[turned_to_us]
        offsets, facing = offsets[turned_to_us], facing[turned_to_us]
        distances = np.sqrt(_squares(offsets))
        # The solid angle of each tile; together they tell how much of a thing is seen.
        angles = targets.areas[numbers] * facing / distances**3
        whole = np.bincount(owners, angles, len(near))

        depth = offsets @ self._ahead
        across = offsets @ self._left
        pictured = (
            (depth > NEAREST)
            & (np.abs(across) * FOCAL_LENGTH <= depth * WIDTH / 2)
            & (np.abs(offsets[:, 2]) * FOCAL_LENGTH <= depth * HEIGHT / 2)
        )
        numbers, owners, angles = numbers[pictured], owners[pictured], angles[pictured]
        distances, depth = distances[pictured], depth[pictured]
        inside = np.bincount(owners, angles, len(near))
        geoms = targets.geoms[near][owners]
        seen = self._reached(offsets[pictured], distances, geoms)
        numbers, owners, angles = numbers[seen], owners[seen], angles[seen]
        distances, depth = distances[seen], depth[seen]
        unhidden = np.bincount(owners, angles, len(near))
        pixels = angles * FOCAL_LENGTH**2 * (distances / depth) ** 3
        area = np.bincount(owners, pixels, len(near))

        enough = (
            (unhidden > 0)
            & (unhidden >= LEAST_FRACTION * inside)
            & ((unhidden >= LEAST_SHARE * whole) | (area >= LARGE_AREA))
        )
        found: dict[int, _Seen | None] = dict.fromkeys(numbers_of)
        ends = owners.searchsorted(np.arange(len(near) + 1)).tolist()
        for i in np.flatnonzero(enough).tolist():
            tiles = slice(ends[i], ends[i + 1])
            found[numbers_of[i]] = self._seen_thing(
                targets,
                numbers_of[i],
                numbers[tiles],
                float(distances[tiles].min()),
                min(float(unhidden[i] / inside[i]), 1.0),
            )
        return found

    def _candidates(
        self, targets: SightTargets, range_limit: float
    ) -> NDArray[np.int64]:
        """Return things near enough and not behind the lens, by their round hulls."""
        offsets = targets.centres - self._eye
        reach = range_limit + targets.radii
        near = np.einsum("ij,ij->i", offsets, offsets) <= reach**2
        (numbers,) = near.nonzero()
        offsets, radii = offsets[numbers], targets.radii[numbers]
        ahead, left = offsets @ self._ahead, offsets @ self._left
        # The frustum's side planes lie at 45 degrees.
        inside = (ahead > -radii) & (ahead - abs(left) > -math.sqrt(2) * radii)
        return numbers[inside]

    def _reached(
        self, offsets: FloatArray, distances: FloatArray, geoms: NDArray[np.int32]
    ) -> NDArray[np.bool_]:
        """Tell which points nothing else hides."""
        count = len(offsets)
        hit_geoms = np.full(count, -1, dtype=np.int32)
        hit_distances = np.full(count, -1.0)
        if count:
            mujoco.mj_multiRay(
                self._scene.model,
                self._data,
                self._eye,
                (offsets / distances[:, np.newaxis]).ravel(),
                NOT_THE_ROBOT,
                True,
                -1,
                hit_geoms,
                hit_distances,
                None,
                count,
                float(distances.max()) + TOUCH,
            )
        return (
            (hit_geoms == geoms)
            | (hit_geoms < 0)
            | (hit_distances >= distances - TOUCH)
        )

    def _seen_thing(
        self,
        targets: SightTargets,
        target: int,
        numbers: NDArray[np.int64],
        nearest: float,
        fraction: float,
    ) -> _Seen | None:
        """Measure a thing by its seen tiles, of which the nearest middle is so far.

        None where it is too small to tell.
        """
        edges = targets.half_edges[numbers]
        middles = targets.points[numbers] - self._eye
        sides = middles + SIGNS * edges[:, 0]
        corners = (sides[:, np.newaxis] + SIGNS * edges[:, 1]).reshape(-1, 3)
        depth = np.maximum(corners @ self._ahead, NEAREST)
        u = WIDTH / 2 - FOCAL_LENGTH * (corners @ self._left) / depth
        v = HEIGHT / 2 - FOCAL_LENGTH * corners[:, 2] / depth
        left, right = _within(u, float(WIDTH))
        top, bottom = _within(v, float(HEIGHT))
        if right - left < LEAST_PIXELS or bottom - top < LEAST_PIXELS:
            return None
        nearest_corner = float(_squares(corners).min())
        x, y, _ = targets.centres[target].tolist()
        thing = VisibleObject(
            description=targets.descriptions[target],
            position=(x, y),
            length=float(targets.lengths[target]),
            box=(left, top, right, bottom),
            distance=min(nearest, math.sqrt(nearest_corner)),
            bearing=math.atan2(WIDTH / 2 - (left + right) / 2, FOCAL_LENGTH),
            visible_fraction=fraction,
        )
        return _Seen(int(targets.geoms[target]), thing)


def _squares(vectors: FloatArray) -> FloatArray:
    """Return the squared lengths of vectors (N, 3); a sum along rows takes longer."""
    x, y, z = vectors.T
    return x * x + y * y + z * z


def _within(pixels: FloatArray, most: float) -> tuple[float, float]:
    """Return the least and the greatest, moved to the picture's edge if beyond."""
    least, greatest = float(pixels.min()), float(pixels.max())
    return min(max(least, 0.0), most), min(max(greatest, 0.0), most)


def _is_cut(box: tuple[float, float, float, float]) -> bool:
    left, top, right, bottom = box
    return left <= 0 or top <= 0 or right >= WIDTH or bottom >= HEIGHT


def camera_elsewhere(
    scene: Scene, now: mujoco.MjData, pose: Pose, draw: Draw | None = None
) -> RayCamera:
    """Return what the camera would see from a robot's pose, with people as now."""
    data = mujoco.MjData(scene.model)
    data.qpos[:7] = (pose.x, pose.y, 0, *about_z(pose.heading))
    data.mocap_pos[:] = now.mocap_pos
    data.mocap_quat[:] = now.mocap_quat
    mujoco.mj_kinematics(scene.model, data)
    mujoco.mj_camlight(scene.model, data)
    return RayCamera(scene, data, draw)
