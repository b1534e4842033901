"""`CarlaBody`: what moves and measures in CARLA.

It is put where its speeds lead before each frame (`set_transform`), so that its poses are
exact and it turns on the spot. CARLA stops nothing that is put somewhere: the body itself
keeps its radius from all that its last scan met, and yields to what its collision sensor
tells.
"""

import math
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from typing import Any

import numpy as np

from memorymaze.basics.errors import RobotBodyError
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.basics.options import check_number
from memorymaze.basics.robot_size import CAMERA_HEIGHT, ROBOT_RADIUS
from memorymaze.robot.api.sensors_and_motion import OdometryReading
from memorymaze.robot.api.steps import CameraPicture, LidarScan
from memorymaze.robot.carla.frames import carla, pose_of, transform_of
from memorymaze.robot.carla.sensors import (
    FRAME,
    LIDAR,
    SensorFeed,
    depth_of,
    rgb_of,
    scan_of,
)
from memorymaze.robot.carla.settings import CarlaOptions
from memorymaze.robot.carla.world import CarlaWorld, connect_to_server
from memorymaze.robot.simulation.motion.kinematic_base import arc_chord, held_back
from memorymaze.robot.simulation.senses.lidar_settings import LidarSettings
from memorymaze.robot.simulation.senses.odometry import Odometry
from memorymaze.robot.steering.settings import TICK, RobotSettings
from memorymaze.world.exporting.carla import generation_parameters
from memorymaze.world.exporting.opendrive import opendrive
from memorymaze.world.sites.records import Site

map_of_site = cache(opendrive)
FRAME_TICKS = round(FRAME / TICK)
WARM_UP, PATIENCE = 20, 1.0
"""Frames that a new sensor may leave out, and seconds that each is awaited."""
HELD = 0.5
"""Seconds for which a body that was touched does not go on that way."""


class CarlaBody:
    """The robot's body in one episode; implements `SensorsAndMotion`."""

    Options = CarlaOptions

    def __init__(
        self,
        site: Site,
        start: Pose,
        settings: RobotSettings,
        rng: np.random.Generator,
        *,
        options: CarlaOptions | None = None,
        connect: Callable[[CarlaOptions], carla.Client] = connect_to_server,
        write_map: Callable[[Site], str] = map_of_site,
    ) -> None:
        """Put it at rest on its start pose; `settings` are for steering alone.

        Children of `rng` give the noise of odometry and where pedestrians walk. What
        `connect` and `write_map` return stands in for CARLA's client and the site's
        OpenDRIVE, which takes seconds to write.

        Raises:
            RobotBodyError: There is no server, or it cannot do what is needed. Nothing is
                left in it.
        """
        self._options = options or CarlaOptions()
        odometry_rng, crowd_rng = rng.spawn(2)
        errors = self._options.wheel_errors()
        self._wheels = None if errors is None else Odometry(start, errors, odometry_rng)
        self._pose, self._speed = start, 0.0
        self._ahead = 0
        """Ticks that have passed for the body since the server's last frame."""
        self._touched = False
        self._held_until, self._held_way = -math.inf, (0.0, 0.0)
        self._cameras: dict[tuple[int, int, float], list[SensorFeed[Any]]] = {}
        text = "" if self._options.carla_map else write_map(site)
        self._world = CarlaWorld(
            self._options, connect, text, generation_parameters(site)
        )
        try:
            self._enter(crowd_rng)
        except BaseException:
            # What went wrong first is what to tell.
            with suppress(RobotBodyError):
                self.close()
            raise

    def _enter(self, crowd_rng: np.random.Generator) -> None:
        """Put all into the world that is there from the start."""
        start, world = self._pose, self._world
        world.stop_clock()
        floor = world.floor_at(start)
        # A metre up, since CARLA refuses walkers whose feet are in the floor.
        above = transform_of(start, floor + 1)
        self._actor = world.spawn(self._options.carla_body, above)
        # The origin of a walker is in its middle, that of other bodies at their feet.
        box = self._actor.bounding_box
        self._lift = box.extent.z - box.location.z
        self._origin, self._shown = floor + self._lift, start
        world.mount("sensor.other.collision", self._actor, 0.0, self._note_touch)
        self._lidar = self._mount("lidar.ray_cast", LidarSettings().height, LIDAR)
        self._await_first(self._lidar)
        if self._options.carla_pedestrians:
            world.add_pedestrians(start, crowd_rng)
            self._advance()

    def odometry(self) -> OdometryReading:
        """See `SensorsAndMotion.odometry`."""
        pose = self._pose if self._wheels is None else self._wheels.pose
        return OdometryReading(self._time, pose, self._speed)

    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        """See `SensorsAndMotion.drive`; the server computes every 0.05 s that are full."""
        left, way = round(seconds / TICK), 0.0
        while left:
            part = min(left, FRAME_TICKS - self._ahead)
            way += self._move(speed, turn_rate, part * TICK)
            left -= part
            self._ahead += part
            if self._ahead == FRAME_TICKS:
                self._advance()
        self._speed = way / seconds
        if self._wheels is not None:
            self._wheels.update(self._pose)

    def lidar_scan(self) -> LidarScan:
        """See `SensorsAndMotion.lidar_scan`."""
        self._catch_up()
        return self._scan

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SensorsAndMotion.camera_picture`; the first of a size takes some frames."""
        check_number("camera width", width, least=1, whole=True)
        check_number("camera height", height, least=1, whole=True)
        check_number("camera horizontal_fov", horizontal_fov, most=3.1, above=0)
        self._catch_up()
        asked = (width, height, horizontal_fov)
        if asked not in self._cameras:
            fov = f"{math.degrees(horizontal_fov):.9g}"
            lens = {"image_size_x": f"{width}", "image_size_y": f"{height}", "fov": fov}
            # What is put from place to place would be blurred.
            sharp = lens | {"motion_blur_intensity": "0"}
            feeds = [
                self._mount("camera.rgb", CAMERA_HEIGHT, sharp),
                self._mount("camera.depth", CAMERA_HEIGHT, lens),
            ]
            self._await_first(*feeds)
            self._cameras[asked] = feeds
        seconds = self._options.carla_timeout
        rgb, depth = (each.at(self._frame, seconds) for each in self._cameras[asked])
        return CameraPicture(rgb_of(rgb), depth_of(depth))

    def pose_in_site(self) -> Pose:
        """Return where it really is."""
        return self._pose

    def close(self) -> None:
        """Take all of it out of the world, and let the server run by itself.

        Raises:
            RobotBodyError: The server does not answer any more.
        """
        self._world.close()

    @property
    def _time(self) -> float:
        return self._world.time + self._ahead * TICK

    def _mount(
        self, kind: str, height: float, attributes: dict[str, str]
    ) -> SensorFeed[Any]:
        """Mount a sensor at a height over the floor."""
        feed, over = SensorFeed[Any](f"sensor.{kind}"), height - self._lift
        self._world.mount(f"sensor.{kind}", self._actor, over, feed.keep, attributes)
        return feed

    def _note_touch(self, _event: carla.CollisionEvent) -> None:
        self._touched = True

    def _move(self, speed: float, turn_rate: float, seconds: float) -> float:
        """Go along an arc, or as much of it as there is room for; return metres."""
        x, y, heading = self._pose
        dx, dy = arc_chord(heading, speed, turn_rate, seconds)
        gaps = np.hypot(*(self._met - (x, y)).T)
        reached = np.flatnonzero(gaps <= ROBOT_RADIUS + math.hypot(dx, dy))
        nearest_first = self._met[reached[np.argsort(gaps[reached])]]
        (dx, dy), _ = held_back((x, y), (dx, dy), enumerate(nearest_first.tolist()))
        held_x, held_y = self._held_way
        if self._time < self._held_until and dx * held_x + dy * held_y > 0:
            dx, dy = 0.0, 0.0
        self._pose = Pose(x + dx, y + dy, wrap_angle(heading + turn_rate * seconds))
        return math.hypot(dx, dy)

    def _catch_up(self) -> None:
        """Let the body stand until the next frame, if it is ahead of the last one."""
        if self._ahead:
            self._advance()

    def _advance(self) -> None:
        """Have the server compute the frame in which the body is where it is."""
        self._show()
        self._look()

    def _await_first(self, *feeds: SensorFeed[Any]) -> None:
        """Let frames pass until new sensors send, which takes them one or two."""
        patience = min(PATIENCE, self._options.carla_timeout)
        for _ in range(WARM_UP):
            self._show()
            if all(feed.came(self._frame, patience) for feed in feeds):
                break
        for feed in feeds:
            feed.at(self._frame, patience)
        self._look()

    def _show(self) -> None:
        world, before = self._world, self._shown
        with world.asking("to move the body"):
            self._actor.set_transform(transform_of(self._pose, self._origin))
            self._frame = world.tick()
            self._pose = self._shown = pose_of(self._actor.get_transform())
        self._ahead = 0
        if self._touched:
            self._touched, self._held_until = False, world.time + HELD
            self._held_way = self._pose.x - before.x, self._pose.y - before.y

    def _look(self) -> None:
        """Scan, and note where in the site something is."""
        measured = self._lidar.at(self._frame, self._options.carla_timeout)
        self._scan = scan_of(measured, self._world.time)
        x, y, heading = self._pose
        ahead, left = self._scan.points()[:, :2].T
        cosine, sine = math.cos(heading), math.sin(heading)
        east, north = ahead * cosine - left * sine, ahead * sine + left * cosine
        self._met = np.column_stack([x + east, y + north])
