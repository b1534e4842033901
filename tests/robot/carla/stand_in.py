"""A CARLA server that is none: our simulation, behind what CARLA's client offers.

Its actors stand in CARLA's left-handed frame, its sensors send raw bytes from another
thread, and it is as particular as the real one: attributes are texts and must exist, what
is put somewhere is seen there after the next tick, applying settings ticks by itself
until they hold, and a server that died answers with the words of CARLA's client. Types
that can be made without a server (transforms, settings, maps, commands) are CARLA's own.
"""

import math
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from fnmatch import fnmatch
from threading import Timer
from types import SimpleNamespace
from typing import Any

import carla
import numpy as np
from shapely import Point

from memorymaze.basics.errors import RenderingError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import mujoco
from memorymaze.robot.carla import CarlaOptions
from memorymaze.robot.simulation.cameras import SceneCameras
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.senses.lidar import Lidar, LidarSettings
from memorymaze.world.sites import Site
from memorymaze.world.sites.navigation_graph import standing_floor

TINY_OPENDRIVE = (
    '<?xml version="1.0"?><OpenDRIVE><header revMajor="1" revMinor="4" name="tiny">'
    "<geoReference><![CDATA[+proj=tmerc +lat_0=0 +lon_0=0]]></geoReference></header>"
    '<road name="way" length="20" id="1" junction="-1"><planView>'
    '<geometry s="0" x="0" y="0" hdg="0" length="20"><line/></geometry></planView>'
    '<lanes><laneSection s="0"><center><lane id="0" type="none" level="false"/></center>'
    '<right><lane id="-1" type="sidewalk" level="false">'
    '<width sOffset="0" a="3" b="0" c="0" d="0"/></lane></right></laneSection></lanes>'
    "</road></OpenDRIVE>"
)
TOWN = TINY_OPENDRIVE.replace("tiny", "town")
WALKER_RADIUS = 0.2
LONGEST_DEPTH = 2**24 - 1

_SENSOR = "role_name sensor_tick"
_CAMERA = f"{_SENSOR} fov image_size_x image_size_y lens_k lens_kcube"
BLUEPRINTS = {
    "util.actor.empty": "role_name",
    "static.prop.travelcase": "role_name size",
    "walker.pedestrian.0001": "role_name is_invincible speed",
    "walker.pedestrian.0002": "role_name is_invincible speed",
    "controller.ai.walker": "role_name",
    "sensor.other.collision": "role_name",
    "sensor.camera.rgb": f"{_CAMERA} exposure_mode motion_blur_intensity",
    "sensor.camera.depth": _CAMERA,
    "sensor.lidar.ray_cast": f"{_SENSOR} channels range points_per_second upper_fov "
    "rotation_frequency lower_fov horizontal_fov atmosphere_attenuation_rate "
    "dropoff_general_rate dropoff_intensity_limit dropoff_zero_intensity noise_seed "
    "noise_stddev",
}
"""Attributes by blueprint, as CARLA 0.9.16 has them."""


_scenes: dict[Any, Scene] = {}


class Blueprint:
    def __init__(self, kind: str) -> None:
        self.id = kind
        self.values: dict[str, str] = {}

    def set_attribute(self, name: str, value: str) -> None:
        if not isinstance(value, str):
            raise TypeError("Python argument types did not match C++ signature")
        if name not in BLUEPRINTS[self.id].split():
            raise IndexError(f"attribute '{name}' not found")
        self.values[name] = value


class Library:
    def find(self, kind: str) -> Blueprint:
        if kind not in BLUEPRINTS:
            raise IndexError(f"blueprint '{kind}' not found")
        return Blueprint(kind)

    def filter(self, pattern: str) -> list[Blueprint]:
        return [Blueprint(each) for each in BLUEPRINTS if fnmatch(each, pattern)]


class StandInActor:
    """Anything in the world; what a kind of actor cannot do is not called."""

    def __init__(
        self,
        server: "StandInServer",
        number: int,
        blueprint: Blueprint,
        transform: carla.Transform,
        parent: "StandInActor | None",
    ) -> None:
        self.id, self.type_id, self.parent = number, blueprint.id, parent
        self.values = blueprint.values
        self.truth, self._seen = _copy(transform), carla.Transform()
        self._server = server
        self._goal: carla.Location | None = None
        self.walks = False
        self._max_speed = 1.4
        self.receive: Callable[[Any], object] | None = None
        self.sends_from = 0

    @property
    def bounding_box(self) -> carla.BoundingBox:
        tall = 0.93 if self.type_id.startswith("walker") else 0.0
        return carla.BoundingBox(carla.Location(), carla.Vector3D(0.19, 0.19, tall))

    def set_transform(self, transform: carla.Transform) -> None:
        self._server.answer()
        self.truth = _copy(transform)

    def get_transform(self) -> carla.Transform:
        return _copy(self._seen)

    def in_world(self) -> carla.Transform:
        if self.parent is None:
            return self.truth
        base = self.parent.in_world()
        yaw = base.rotation.yaw + self.truth.rotation.yaw
        # What is given is changed in place.
        place = base.transform(_copy(self.truth).location)
        return carla.Transform(carla.Location(place), carla.Rotation(yaw=yaw))

    def pose(self) -> Pose:
        place = self.in_world()
        yaw = place.rotation.yaw
        return Pose(place.location.x, -place.location.y, -math.radians(yaw))

    # Sensors.

    def listen(self, receive: Callable[[Any], object]) -> None:
        self._server.answer()
        self.receive = receive
        self.sends_from = self._server.frame + 1 + self._server.first_left_out

    # Controllers of walkers, and sensors.

    def stop(self) -> None:
        self.receive, self.walks = None, False

    def start(self) -> None:
        assert self._seen != carla.Transform(), "a controller starts after a tick"
        self.walks = True

    def go_to_location(self, where: carla.Location) -> None:
        self._goal = where

    def set_max_speed(self, speed: float) -> None:
        self._max_speed = speed

    def step(self, seconds: float) -> None:
        if self.walks and self._goal is not None:
            assert self.parent is not None
            here = self.parent.truth.location
            left = here.distance(self._goal)
            share = min(1.0, self._max_speed * seconds / left) if left else 0.0
            self.parent.truth.location = carla.Location(
                here.x + share * (self._goal.x - here.x),
                here.y + share * (self._goal.y - here.y),
                here.z,
            )

    def show(self) -> None:
        self._seen = _copy(self.in_world())


class StandInServer:
    """Server, client and world in one; `connect` is given to the body."""

    def __init__(self, site: Site, *, version: str | None = None) -> None:
        self.site = site
        self.version = version or carla.Client().get_client_version()
        self.actors: dict[int, StandInActor] = {}
        self.settings = carla.WorldSettings()
        self.frame, self.elapsed, self._delta = 100, 7.5, 0.0
        self.loaded = carla.Map("Carla/Maps/Town10HD_Opt", TOWN)
        self.maps = ["Carla/Maps/Town10HD_Opt", "Carla/Maps/tiny_museum"]
        self.made_worlds = 0
        self.is_dead = False
        self.first_left_out = 0
        """Frames that a sensor sends nothing after it was listened to."""
        self.delay = 0.0
        """Seconds by which sensors send later than the tick ends."""
        self.lost: Callable[[str, int], bool] = lambda kind, frame: False
        """Whether a sensor leaves out a frame."""
        self.is_touched = False
        """Whether something runs into the body at the next tick."""
        self.navigable_places = math.inf
        """How many places for pedestrians it still names."""
        self._dies_in = math.inf
        if site.source not in _scenes:
            _scenes[site.source] = build_scene(site)
        self._scene = _scenes[site.source]
        self._physics = mujoco.MjData(self._scene.model)
        mujoco.mj_kinematics(self._scene.model, self._physics)
        self._floor = standing_floor(site)
        self._eyes = SceneCameras(self._scene, self._physics, "own")
        self._walkers_rng = np.random.default_rng(0)
        self._thread = ThreadPoolExecutor(1)

    def connect(self, options: CarlaOptions) -> Any:
        self._address = f"{options.carla_host}:{options.carla_port}"
        self._timeout = options.carla_timeout
        return self

    # How it fails.

    def die(self, after: int = 0) -> None:
        """Answer nothing any more, after some ticks."""
        self._dies_in = after

    def answer(self) -> None:
        if self._dies_in <= 0:
            raise RuntimeError(
                f"time-out of {1000 * self._timeout:.0f}ms while waiting for the "
                "simulator, make sure the simulator is ready and connected to "
                f"{self._address}"
            )

    def walkers(self) -> list[StandInActor]:
        return [each for each in self.actors.values() if "walker.ped" in each.type_id]

    def body(self) -> StandInActor:
        return next(iter(self.actors.values()))

    # The client.

    def get_server_version(self) -> str:
        self.answer()
        return self.version

    def get_client_version(self) -> str:
        return carla.Client().get_client_version()

    def get_world(self) -> "StandInServer":
        self.answer()
        return self

    def get_available_maps(self) -> list[str]:
        return self.maps

    def load_world(self, name: str) -> "StandInServer":
        self.answer()
        if name not in {each.split("/")[-1] for each in self.maps}:
            raise RuntimeError("map not found")
        return self._become(carla.Map(f"Carla/Maps/{name}", TOWN))

    def generate_opendrive_world(
        self, text: str, parameters: carla.OpendriveGenerationParameters
    ) -> "StandInServer":
        self.answer()
        assert parameters.additional_width == 0
        assert parameters.wall_height > 2
        return self._become(carla.Map("Carla/Maps/OpenDriveMap", text))

    def _become(self, loaded: carla.Map) -> "StandInServer":
        self.loaded, self.settings = loaded, carla.WorldSettings()
        self.actors.clear()
        self.made_worlds += 1
        return self

    def apply_batch_sync(self, commands: list[Any], tick: bool) -> list[Any]:
        self.answer()
        errors = []
        for each in commands:
            assert isinstance(each, carla.command.DestroyActor)
            gone = self.actors.pop(each.actor_id, None)
            is_at_rest = gone is not None and not (gone.receive or gone.walks)
            errors.append("" if is_at_rest else f"unable to destroy {each.actor_id}")
        return [
            SimpleNamespace(error=error, has_error=lambda error=error: bool(error))
            for error in errors
        ]

    # The world.

    def get_map(self) -> carla.Map:
        self.answer()
        return self.loaded

    def get_settings(self) -> carla.WorldSettings:
        self.answer()
        return _copy_settings(self.settings)

    def apply_settings(self, settings: carla.WorldSettings) -> int:
        self.answer()
        self.settings = _copy_settings(settings)
        # As the client does: it ticks until it has seen the step twice.
        seen = 0
        while settings.fixed_delta_seconds:
            seen += abs(settings.fixed_delta_seconds - self._delta) < 1e-7
            if seen == 2:
                break
            self.tick()
        return self.frame

    def get_snapshot(self) -> Any:
        stamp = carla.Timestamp(self.frame, self.elapsed, self._delta, 0.0)
        return SimpleNamespace(frame=self.frame, timestamp=stamp)

    def get_blueprint_library(self) -> Library:
        return Library()

    def ground_projection(self, above: carla.Location, distance: float) -> Any:
        self.answer()
        inside = self.site.free_floor.covers(Point(above.x, -above.y))
        if "Town" in self.loaded.name or not inside or above.z > distance:
            return None
        return SimpleNamespace(location=carla.Location(above.x, above.y, 0.0))

    def spawn_actor(
        self,
        blueprint: Blueprint,
        transform: carla.Transform,
        attach_to: StandInActor | None = None,
    ) -> StandInActor:
        self.answer()
        number = max(self.actors, default=20) + 1
        made = StandInActor(self, number, blueprint, transform, attach_to)
        self.actors[number] = made
        return made

    def try_spawn_actor(
        self, blueprint: Blueprint, transform: carla.Transform
    ) -> StandInActor | None:
        taken = [each.truth.location for each in self.walkers()]
        if any(each.distance(transform.location) < 0.5 for each in taken):
            return None
        return self.spawn_actor(blueprint, transform)

    def set_pedestrians_seed(self, seed: int) -> None:
        self.answer()
        self._walkers_rng = np.random.default_rng(seed)

    def get_random_location_from_navigation(self) -> carla.Location | None:
        self.answer()
        self.navigable_places -= 1
        if self.navigable_places < 0:
            return None
        west, south, east, north = self._floor.bounds
        while True:
            x, y = self._walkers_rng.uniform((west, south), (east, north)).tolist()
            if self._floor.covers(Point(x, y)):
                return carla.Location(x, -y, 0.1)

    def tick(self, seconds: float = 0.0) -> int:
        self._dies_in -= 1
        self.answer()
        assert self.settings.synchronous_mode, (
            "nobody ticks a server that runs by itself"
        )
        self._delta = self.settings.fixed_delta_seconds or 0.0
        self.frame += 1
        self.elapsed += self._delta
        for each in self.actors.values():
            each.step(self._delta)
        for each in self.actors.values():
            each.show()
        for each in self.actors.values():
            self._measure(each)
        self.is_touched = False
        return self.frame

    # What sensors measure.

    def _measure(self, sensor: StandInActor) -> None:
        if sensor.receive is None or self.frame < sensor.sends_from:
            return
        if self.lost(sensor.type_id, self.frame):
            return
        data = SimpleNamespace(
            frame=self.frame, timestamp=self.elapsed, transform=sensor.in_world()
        )
        if sensor.type_id == "sensor.lidar.ray_cast":
            self._scan(sensor, data)
        elif "camera" in sensor.type_id:
            self._draw(sensor, data)
        elif not self.is_touched:
            return
        if self.delay:
            Timer(self.delay, sensor.receive, (data,)).start()
        else:
            self._thread.submit(sensor.receive, data)

    def _scan(self, sensor: StandInActor, data: SimpleNamespace) -> None:
        values = sensor.values
        turns = float(values["rotation_frequency"]) * self._delta
        rays = round(float(values["points_per_second"]) * self._delta)
        assert turns == 1, "a whole turn in each frame"
        assert values["channels"] == "1"
        height = data.transform.location.z
        farthest = float(values["range"])
        settings = LidarSettings(
            rays=rays, height=height, farthest=farthest, nearest=0.0
        )
        pose = sensor.pose()
        scan = Lidar(self._scene, self._physics, settings).scan(pose)
        ranges = np.minimum(scan.ranges, self._to_people(pose, scan.angles))
        if values.get("dropoff_general_rate", "0.45") != "0":
            ranges[self._walkers_rng.random(rays) < 0.45] = math.inf
        # By CARLA's yaw, which grows to the right.
        kept = ranges[::-1] <= farthest
        angles, ranges = -scan.angles[::-1][kept], ranges[::-1][kept]
        points = np.zeros((len(ranges), 4), np.float32)
        points[:, 0], points[:, 1] = ranges * np.cos(angles), ranges * np.sin(angles)
        data.raw_data = memoryview(points.tobytes())

    def _to_people(self, pose: Pose, angles: Any) -> Any:
        nearest = np.full(len(angles), np.inf)
        for walker in self.walkers():
            if walker is self.body():
                continue
            place = walker.truth.location
            dx, dy = place.x - pose.x, -place.y - pose.y
            along = dx * np.cos(angles + pose.heading) + dy * np.sin(
                angles + pose.heading
            )
            aside = dx * dx + dy * dy - along * along
            hit = (along > 0) & (aside < WALKER_RADIUS**2)
            half = np.sqrt(np.maximum(WALKER_RADIUS**2 - aside, 0))
            nearest = np.where(hit, np.minimum(nearest, along - half), nearest)
        return nearest

    def _draw(self, sensor: StandInActor, data: SimpleNamespace) -> None:
        values = sensor.values
        width, height = int(values["image_size_x"]), int(values["image_size_y"])
        data.width, data.height, data.fov = width, height, float(values["fov"])
        try:
            fov = math.radians(data.fov)
            seen = self._eyes.frame(sensor.pose(), width, height, fov)
            rgb, depth = seen.rgb, seen.depth
        except RenderingError:
            rgb = np.full((height, width, 3), 128, np.uint8)
            depth = np.full((height, width), 5.0, np.float32)
        pixels = np.full((height, width, 4), 255, np.uint8)
        if sensor.type_id == "sensor.camera.rgb":
            pixels[..., :3] = rgb[..., ::-1]
        else:
            share = np.minimum(depth.astype(float) / 1000, 1)
            steps = np.rint(share * LONGEST_DEPTH).astype(np.uint32)
            # Blue has the highest bits.
            for channel, shift in enumerate((16, 8, 0)):
                pixels[..., channel] = (steps >> shift) & 255
        data.raw_data = memoryview(pixels.tobytes())


def _copy(transform: carla.Transform) -> carla.Transform:
    place, turn = transform.location, transform.rotation
    return carla.Transform(
        carla.Location(place.x, place.y, place.z),
        carla.Rotation(turn.pitch, turn.yaw, turn.roll),
    )


def _copy_settings(settings: carla.WorldSettings) -> carla.WorldSettings:
    copied = carla.WorldSettings()
    for name in _names(settings):
        setattr(copied, name, getattr(settings, name))
    return copied


def _names(settings: carla.WorldSettings) -> Iterator[str]:
    for name, kind in vars(type(settings)).items():
        if isinstance(kind, property):
            yield name
