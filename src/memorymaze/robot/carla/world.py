"""A world of a CARLA server in synchronous mode, and all that an episode puts into it."""

from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from typing import Any, cast

import numpy as np

from memorymaze.basics.errors import RobotBodyError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.carla.frames import carla, transform_of
from memorymaze.robot.carla.sensors import FRAME
from memorymaze.robot.carla.settings import CarlaOptions

SEARCHED = 1.0
"""Metres above and below height 0 in which there must be a floor."""
TRIES, APART = 20, 1.5
"""Places tried for each pedestrian, and metres from the robot in which none begins."""


def connect_to_server(options: CarlaOptions) -> carla.Client:
    """Return a client, which speaks to the server when it is first asked something."""
    client = carla.Client(options.carla_host, options.carla_port)
    client.set_timeout(options.carla_timeout)
    return client


class CarlaWorld:
    """What a server computes frame by frame; nobody else may tick it."""

    def __init__(
        self,
        options: CarlaOptions,
        connect: Callable[[CarlaOptions], carla.Client],
        opendrive: str,
        generation: Mapping[str, Any],
    ) -> None:
        """Load the map, or generate it from OpenDRIVE; `stop_clock` comes next.

        `generation` has members of CARLA's `OpendriveGenerationParameters`.

        Raises:
            RobotBodyError: No server answers, or one of another version.
        """
        self._options = options
        self._name = f"CARLA at {options.carla_host}:{options.carla_port}"
        self._spawned: list[carla.Actor] = []
        self._before_end: list[Callable[[], object]] = []
        self._is_open = False
        self.time = 0.0
        """Seconds of the server's clock at the last frame."""
        with self.asking("for its version and map"):
            self._client = connect(options)
            theirs = self._client.get_server_version()
            ours = self._client.get_client_version()
            if theirs != ours:
                raise RobotBodyError(
                    f"{self._name}: expected a server of version {ours}, as the Python "
                    f"package carla, got {theirs}; start the one or install the other"
                )
            self._world = self._load(opendrive, generation)

    def _load(self, opendrive: str, generation: Mapping[str, Any]) -> carla.World:
        """Return a world with the map, which stays loaded from episode to episode."""
        world, wanted = self._client.get_world(), self._options.carla_map
        loaded = world.get_map()
        if wanted:
            is_loaded = loaded.name.split("/")[-1] == wanted.split("/")[-1]
            return world if is_loaded else self._client.load_world(wanted)
        if loaded.to_opendrive() == opendrive:
            return world
        parameters = carla.OpendriveGenerationParameters(**generation)
        # Its types leave out what it returns.
        made: Any = self._client.generate_opendrive_world(opendrive, parameters)
        return made

    def stop_clock(self) -> None:
        """Have the server wait for ticks, until it is closed."""
        self._is_open = True
        with self.asking("to wait for ticks"):
            settings = self._world.get_settings()
            settings.synchronous_mode, settings.fixed_delta_seconds = True, FRAME
            settings.substepping = True
            settings.max_substep_delta_time, settings.max_substeps = 0.01, 10
            self._world.apply_settings(settings)

    @contextmanager
    def asking(self, what: str) -> Generator[None]:
        """Say what the server was asked, where it does not answer or refuses."""
        try:
            yield
        # What the client raises; IndexError for names that there are not.
        except (RuntimeError, IndexError) as error:
            raise RobotBodyError(
                f"{self._name}, asked {what}: {error}. A server must run there (type "
                f"./CarlaUE4.sh -RenderOffScreen -carla-rpc-port="
                f"{self._options.carla_port}; or give carla_host, carla_port) and answer "
                f"within carla_timeout, {self._options.carla_timeout:g} s"
            ) from error

    def tick(self) -> int:
        """Have the next frame computed, and return its number."""
        with self.asking("to compute a frame"):
            frame = self._world.tick(self._options.carla_timeout)
            self.time = self._world.get_snapshot().timestamp.elapsed_seconds
        return frame

    def floor_at(self, pose: Pose) -> float:
        """Return how high the floor is."""
        with self.asking("for the floor"):
            above = transform_of(pose, SEARCHED).location
            # Its types leave out that there may be none.
            below: Any = self._world.ground_projection(above, 2 * SEARCHED)
        if below is None:
            raise RobotBodyError(
                f"{self._name}: expected a floor at ({pose.x:.2f}, {pose.y:.2f}) of the "
                f"site, at most {SEARCHED:g} m from height 0, got none; give the map "
                "that was made of this site, or leave carla_map out"
            )
        return float(below.location.z)

    def spawn(
        self,
        blueprint: str,
        transform: carla.Transform,
        parent: carla.Actor | None = None,
        attributes: Mapping[str, str] | None = None,
    ) -> carla.Actor:
        """Put something into the world until it is closed; transforms are its parent's."""
        with self.asking(f"for {blueprint}"):
            kind = self._world.get_blueprint_library().find(blueprint)
            for name, value in (attributes or {}).items():
                kind.set_attribute(name, value)
            actor = self._world.spawn_actor(kind, transform, parent)
        self._spawned.append(actor)
        return actor

    def mount(
        self,
        blueprint: str,
        parent: carla.Actor,
        height: float,
        receive: Callable[[Any], object],
        attributes: Mapping[str, str] | None = None,
    ) -> None:
        """Mount a sensor over an actor's origin; a thread calls `receive` with its data."""
        mount = carla.Transform(carla.Location(z=height))
        sensor = cast(carla.Sensor, self.spawn(blueprint, mount, parent, attributes))
        self._before_end.append(sensor.stop)
        with self.asking(f"what {blueprint} measures"):
            sensor.listen(receive)

    def add_pedestrians(self, start: Pose, rng: np.random.Generator) -> None:
        """Have CARLA's people walk from random places to others.

        Raises:
            RobotBodyError: Nobody can walk on this map, or there is no room for so many.
        """
        wanted, walkers = self._options.carla_pedestrians, list[carla.Actor]()
        with self.asking("for pedestrians"):
            self._world.set_pedestrians_seed(int(rng.integers(2**31)))
            library = self._world.get_blueprint_library()
            kinds = sorted(each.id for each in library.filter("walker.pedestrian.*"))
            for _ in range(TRIES * wanted):
                where, kind = self._somewhere(), kinds[int(rng.integers(len(kinds)))]
                near = where.distance(transform_of(start, where.z).location) < APART
                if near or len(walkers) == wanted:
                    continue
                # Its types leave out that it may have no room.
                walker: Any = self._world.try_spawn_actor(
                    library.find(kind), carla.Transform(where)
                )
                if walker is not None:
                    walkers.append(walker)
                    self._spawned.append(walker)
            if len(walkers) < wanted:
                raise RobotBodyError(
                    f"carla_pedestrians: expected room for {wanted}, got {len(walkers)}"
                )
            minds = [
                self.spawn("controller.ai.walker", carla.Transform(), each)
                for each in walkers
            ]
            self.tick()
            for mind in cast(list[carla.WalkerAIController], minds):
                mind.start()
                self._before_end.append(mind.stop)
                mind.go_to_location(self._somewhere())
                mind.set_max_speed(float(rng.uniform(0.8, 1.5)))

    def _somewhere(self) -> carla.Location:
        # Its types leave out that there may be none.
        where: Any = self._world.get_random_location_from_navigation()
        if where is None:
            raise RobotBodyError(
                "carla_pedestrians: expected a map with navigation for pedestrians, got "
                "one without; give carla_pedestrians=0, or another map"
            )
        return where

    def close(self) -> None:
        """Let the server run by itself again, and take out all that was put in.

        Raises:
            RobotBodyError: It does not answer any more, or keeps something.
        """
        if not self._is_open:
            return
        self._is_open = False
        with self.asking("to end the episode; start it anew"):
            # First of all: a server that waits for ticks is of no use to anybody.
            settings = self._world.get_settings()
            settings.synchronous_mode, settings.fixed_delta_seconds = False, None
            self._world.apply_settings(settings)
            for call in self._before_end:
                call()
            # Sensors go before what they are mounted on.
            parting = [
                carla.command.DestroyActor(each.id) for each in self._spawned[::-1]
            ]
            for answer in self._client.apply_batch_sync(parting, False):
                if answer.has_error():
                    raise RobotBodyError(f"{self._name} keeps a thing: {answer.error}")
