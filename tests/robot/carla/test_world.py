"""What is put into a server's world, and that nothing is left there."""

import math
import runpy
import sys
from typing import Any

import numpy as np
import pytest
from tests.robot.carla.conftest import START, MakeBody
from tests.robot.carla.stand_in import TINY_OPENDRIVE, StandInServer
from tests.robot.carla.stand_in_robot import factory

from memorymaze.basics import extras
from memorymaze.basics.errors import RobotBodyError, SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.options import list_options, read_options
from memorymaze.robot.carla import CarlaBody, CarlaOptions, frames
from memorymaze.robot.steering.settings import RobotSettings
from memorymaze.world.sites import Site


def _is_as_before(server: StandInServer) -> bool:
    settings = server.settings
    waits = settings.synchronous_mode or settings.fixed_delta_seconds
    return not server.actors and not waits


def test_while_it_is_open_the_server_waits_for_ticks_of_50_ms_in_five_steps(
    put_body: MakeBody, server: StandInServer
) -> None:
    put_body()
    settings = server.settings
    assert settings.synchronous_mode
    assert settings.fixed_delta_seconds == pytest.approx(0.05)
    assert settings.substepping
    assert settings.max_substep_delta_time * settings.max_substeps >= 0.05


@pytest.mark.proof
def test_all_is_gone_when_it_is_closed_once_or_twice(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(carla_pedestrians=2)
    body.camera_picture(32, 24)
    assert len(server.actors) == 9
    body.close()
    assert _is_as_before(server)
    body.close()


def test_the_world_of_a_site_is_generated_once_for_all_its_episodes(
    put_body: MakeBody, server: StandInServer
) -> None:
    for _ in range(2):
        put_body().close()
    assert server.made_worlds == 1
    assert server.loaded.to_opendrive() == TINY_OPENDRIVE


def test_a_map_is_loaded_by_its_name_once(
    put_body: MakeBody, server: StandInServer
) -> None:
    for name in ("tiny_museum", "Carla/Maps/tiny_museum"):
        put_body(carla_map=name).close()
    assert server.made_worlds == 1
    assert server.loaded.name.endswith("tiny_museum")


def _without_floor(server: StandInServer) -> dict[str, Any]:
    return {"start": Pose(50, 50, 0)}


def _of_another_site(server: StandInServer) -> dict[str, Any]:
    return {"carla_map": "Town10HD_Opt"}


def _unknown_map(server: StandInServer) -> dict[str, Any]:
    return {"carla_map": "Town99"}


def _unknown_body(server: StandInServer) -> dict[str, Any]:
    return {"carla_body": "vehicle.suitcase"}


def _unwalkable(server: StandInServer) -> dict[str, Any]:
    server.navigable_places = 0
    return {"carla_pedestrians": 1}


def _crowded(server: StandInServer) -> dict[str, Any]:
    return {"carla_pedestrians": 300}


def _half_walkable(server: StandInServer) -> dict[str, Any]:
    server.navigable_places = 3
    return {"carla_pedestrians": 4}


def _blind(server: StandInServer) -> dict[str, Any]:
    server.lost = lambda kind, frame: "lidar" in kind
    return {"carla_timeout": 0.01}


def _another_version(server: StandInServer) -> dict[str, Any]:
    server.version = "0.9.13"
    return {}


@pytest.mark.parametrize(
    ("goes_wrong", "words"),
    [
        (_without_floor, r"a floor at \(50.00, 50.00\)"),
        (_of_another_site, "give the map that was made of this site"),
        (_unknown_map, "map not found"),
        (_unknown_body, "vehicle.suitcase: blueprint 'vehicle.suitcase' not found"),
        (_unwalkable, "navigation for pedestrians"),
        (_half_walkable, "navigation for pedestrians"),
        (_crowded, "expected room for 300"),
        (_blind, "sensor.lidar.ray_cast: expected frame"),
        (_another_version, "expected a server of version .*got 0.9.13"),
    ],
)
def test_what_goes_wrong_at_the_beginning_is_told_and_leaves_nothing(
    put_body: MakeBody, server: StandInServer, goes_wrong: Any, words: str
) -> None:
    with pytest.raises(RobotBodyError, match=words):
        put_body(**goes_wrong(server))
    assert _is_as_before(server)


def test_a_beginning_that_is_interrupted_leaves_nothing(
    put_body: MakeBody, server: StandInServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(server, "ground_projection", interrupted)
    with pytest.raises(KeyboardInterrupt):
        put_body()
    assert _is_as_before(server)


def test_where_no_server_is_the_client_of_carla_says_so_in_time(l_site: Site) -> None:
    """The real one, on a port where nothing listens."""
    options = CarlaOptions("127.0.0.1", 1, 0.2)
    rng = np.random.default_rng(0)
    with pytest.raises(RobotBodyError) as told:
        CarlaBody(
            l_site,
            START,
            RobotSettings(),
            rng,
            options=options,
            write_map=lambda _: TINY_OPENDRIVE,
        )
    for words in ("127.0.0.1:1", "time-out of 200ms", "-carla-rpc-port=1", "0.2 s"):
        assert words in str(told.value)


@pytest.mark.proof
def test_pedestrians_walk_about_and_are_the_same_for_the_same_seed(
    put_body: MakeBody, server: StandInServer
) -> None:
    seen = []
    for seed in (3, 3, 4):
        body = put_body(seed=seed, carla_pedestrians=3)
        began = [each.get_transform().location for each in server.walkers()]
        assert all(math.dist((at.x, -at.y), START[:2]) >= 1.5 for at in began)
        for _ in range(20):
            body.drive(0.0, 0.0, 0.05)
        ends = [each.get_transform().location for each in server.walkers()]
        walked = [a.distance(b) for a, b in zip(began, ends, strict=True)]
        assert max(walked) > 0.5
        seen.append([(each.x, each.y) for each in ends])
        body.close()
    assert seen[0] == seen[1] != seen[2]
    assert len(seen[0]) == 3


def test_its_options_are_read_and_told_as_those_of_agents() -> None:
    pairs = [("carla-host", "gpu"), ("carla_port", "3000"), ("carla_pedestrians", "5")]
    options = read_options(CarlaBody.Options, pairs, agent="carla")
    assert options == CarlaOptions("gpu", 3000, carla_pedestrians=5)
    assert all(each.meaning for each in list_options(CarlaOptions))


@pytest.mark.parametrize(
    "wrong",
    [
        {"carla_port": 0},
        {"carla_timeout": 0.0},
        {"carla_pedestrians": -1},
        {"carla_odometry": "drift=1"},
    ],
)
def test_options_without_meaning_are_refused_by_name(
    put_body: MakeBody, server: StandInServer, wrong: dict[str, Any]
) -> None:
    with pytest.raises(SettingsError, match=next(iter(wrong))):
        put_body(**wrong)
    assert _is_as_before(server)


def test_a_factory_puts_it_on_a_stand_in_for_runs(crossing_site: Site) -> None:
    start = crossing_site.routes[0].start
    body = factory(
        crossing_site,
        start,
        RobotSettings(),
        np.random.default_rng(0),
        options=CarlaOptions(),
    )
    assert body.pose_in_site() == pytest.approx(start, abs=1e-5)
    body.close()


def test_without_carla_it_is_told_how_to_get_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "carla", None)
    monkeypatch.setattr(extras, "is_installed", lambda package: False)
    with pytest.raises(
        SettingsError, match=r"a robot in CARLA: the package carla .*pip"
    ):
        runpy.run_path(str(frames.__file__))
