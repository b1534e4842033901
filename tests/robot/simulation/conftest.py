"""Scenes of the tiny sites, and small sites made by hand."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from shapely import Point, Polygon, box

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.calls import TraceEvent
from memorymaze.world.sites.records import (
    Area,
    Corridor,
    Exit,
    Landmark,
    Site,
    TurningPoint,
)


class Plans:
    """Makes sites and their parts in few words; angles in degrees."""

    def site(self, *parts: object, ceiling_height: float = 3.0) -> Site:
        def of(kind: type) -> tuple[Any, ...]:
            return tuple(part for part in parts if isinstance(part, kind))

        return Site(
            name="made_by_hand",
            title="Made by hand",
            floor="1",
            ceiling_height=ceiling_height,
            description="",
            anchor=None,
            corridors=of(Corridor),
            areas=of(Area),
            turning_points=of(TurningPoint),
            rooms=(),
            doors=(),
            landmarks=of(Landmark),
            routes=(),
        )

    def corridor(self, name: str, *bounds: float) -> Corridor:
        return self.slanted_corridor(name, box(*bounds))

    def slanted_corridor(self, name: str, polygon: Polygon) -> Corridor:
        return Corridor(name, polygon, None, "tile", "plaster")

    def area(self, name: str, polygon: Polygon) -> Area:
        return Area(name, polygon, None, "tile", "plaster", open_air=False)

    def turning_point(
        self, name: str, polygon: Polygon, exits: Sequence[tuple[str, float]]
    ) -> TurningPoint:
        ways = tuple(Exit(to, math.radians(degrees)) for to, degrees in exits)
        return TurningPoint(name, polygon, None, "crossing", ways)

    def thing(self, name: str, x: float, y: float, **properties: Any) -> Landmark:
        """Make a box of 0.5 m by 0.5 m that stands in the way."""
        return Landmark(
            id=name,
            position=Point(x, y),
            category="box",
            color=None,
            name=None,
            text=None,
            heading=math.radians(properties.get("degrees", 0.0)),
            size=properties.get("size", (0.5, 0.5, 1.0)),
            mount=properties.get("mount", "floor"),
            obstacle=properties.get("obstacle", True),
        )


@pytest.fixture(scope="session")
def plans() -> Plans:
    """Maker of sites."""
    return Plans()


PutRobot = Callable[..., SimulatedRobot]


@pytest.fixture
def put_robot(scenes: dict[str, Scene]) -> PutRobot:
    """Put a robot somewhere: `put_robot(scene, x, y, degrees, seed=…, **settings)`.

    The scene is one made for the test, or the name of a tiny site.
    """

    def put(
        scene: Scene | str,
        x: float,
        y: float,
        degrees: float = 0.0,
        *,
        seed: int = 0,
        events: list[TraceEvent] | None = None,
        **settings: Any,
    ) -> SimulatedRobot:
        return SimulatedRobot(
            scenes[scene] if isinstance(scene, str) else scene,
            Pose(x, y, math.radians(degrees)),
            SimulationSettings(**settings),
            np.random.default_rng(seed),
            None if events is None else events.append,
        )

    return put
