import json
from pathlib import Path
from typing import Any

import pytest
from tests.runs.episodes import own_bodies

import memorymaze as mm
from memorymaze.basics.errors import SettingsError, SitePlanError
from memorymaze.runs.episodes.settings import RunSettings


class Ahead:
    """Drives eight metres and is content."""

    name = "ahead"

    def follow(self, instruction, robot, journal, rng) -> None:
        robot.move_forward(8.0)


class Peeping(Ahead):
    """Looks where the goal is."""

    def follow(self, instruction, robot, journal, rng) -> None:
        robot.move_forward(robot.scene.site.routes[0].line.length)


@pytest.fixture
def corridor(tiny_sites_folder: Path) -> Path:
    return tiny_sites_folder / "corridor.geojson"


@pytest.mark.parametrize("agent", [Ahead, Ahead()], ids=["class", "object"])
def test_one_text_is_followed_by_an_agent_however_it_is_given(
    agent, corridor: Path
) -> None:
    walk = mm.follow("Eight metres ahead.", agent, site=corridor)
    assert walk.result.agent == "ahead"
    assert walk.result.path_length == pytest.approx(8.0, abs=0.2)
    assert walk.stopped_by == "agent"
    assert "corridor route_r1" in repr(walk)


def test_a_walk_draws_itself_on_the_plan(corridor: Path) -> None:
    picture = mm.follow("Go.", Ahead, site=corridor).plot()
    assert min(picture.size) > 100
    assert len(picture.getcolors(1 << 20) or []) > 10


def test_a_picture_that_fails_loses_no_walk(
    corridor: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    walk = mm.follow("Go.", Ahead, site=corridor)

    def failing(*_: object, **__: object) -> None:
        raise SitePlanError("no picture")

    monkeypatch.setattr("memorymaze.world.drawing.plan_picture.draw_walk", failing)
    with pytest.raises(SitePlanError, match="no picture"):
        walk.save(tmp_path)
    assert len(json.loads((tmp_path / "trajectory.json").read_text())["poses"]) > 2
    assert '"kind":"end"' in (tmp_path / "trace.jsonl").read_text().replace(" ", "")


def test_an_agent_handed_over_as_an_object_sees_no_answers(corridor: Path) -> None:
    walk = mm.follow("Go.", Peeping(), site=corridor)
    assert walk.stopped_by == "crash"
    assert "has no 'scene'" in str(walk.result.error)


def test_settings_are_changed_by_name(corridor: Path) -> None:
    walk = mm.follow("Go.", Ahead, site=corridor, time_budget=4.0)
    assert walk.stopped_by == "budget"
    with pytest.raises(SettingsError, match="did you mean 'time_budget'"):
        mm.follow("Go.", Ahead, site=corridor, time_buget=4.0)
    with pytest.raises(SettingsError, match="budget_by: expected way beside a time"):
        mm.follow("Go.", Ahead, site=corridor, time_budget=4.0, budget_by="longest")


@pytest.mark.parametrize(
    "given",
    [
        {"wall_limit": 5},
        {"settings": RunSettings(wall_limit=5)},
        {"settings": RunSettings(seed=1), "wall_limit": 5},
    ],
)
def test_what_is_said_of_runs_of_many_episodes_is_refused_of_one_walk(
    corridor: Path, given: dict[str, Any]
) -> None:
    said = "wall_limit: is of runs of many episodes, and this is one walk, got 5; leave"
    with pytest.raises(SettingsError, match=said):
        mm.follow("Go.", Ahead, site=corridor, **given)


def test_a_robot_by_hand_says_where_it_is(corridor: Path) -> None:
    robot = mm.make_robot(corridor)
    assert "corridor: x 2.00 m, y 0.00 m" in repr(robot)
    robot.move_forward(3.0)
    assert "3.0 m driven" in repr(robot)


@pytest.mark.parametrize(
    "choice", [{"ask": 1}, {"isolate": True}, {"budget_by": "longest"}]
)
def test_a_robot_by_hand_takes_no_setting_of_those_who_follow(
    corridor: Path, choice: dict[str, Any]
) -> None:
    with pytest.raises(SettingsError, match=f"{next(iter(choice))}: expected none"):
        mm.make_robot(corridor, **choice)


def test_a_robot_by_hand_sees_with_the_detector_that_was_chosen(corridor: Path) -> None:
    sees, is_blind = (
        mm.make_robot(corridor, detector=detector)
        for detector in ("truth", "truth:miss=1")
    )
    for robot in (sees, is_blind):
        robot.move_forward(4.0)
    assert sees.detect_from_RGB_image("bench")
    assert not is_blind.detect_from_RGB_image("bench")


def test_a_robot_by_hand_has_the_body_that_was_chosen(corridor: Path) -> None:
    robot = mm.make_robot(corridor, robot=f"{own_bodies.__name__}:Localised")
    robot.close()
    assert own_bodies.opened[-1].closed == 1


def test_the_same_seed_gives_a_robot_by_hand_and_one_of_an_agent_the_same_way(
    corridor: Path,
) -> None:
    robot = mm.make_robot(corridor, seed=3)
    robot.move_forward(8.0)
    driven = robot.trajectory().poses
    followed = mm.follow("Go.", Ahead, site=corridor, seed=3).trajectory.poses
    assert driven == followed[: len(driven)]


def test_a_robot_by_hand_has_as_much_time_as_it_is_given(corridor: Path) -> None:
    robot = mm.make_robot(corridor, time_budget=2.0)
    assert robot.move_forward(8.0).reason == "budget"
    assert robot.time == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("choice", "said"),
    [
        ({"seed": -1}, "seed: expected a whole number of at least 0, got -1"),
        ({"obstacles": True}, "obstacles: expected ObstacleSettings, a level by name"),
        ({"noise": 0.1}, "noise: expected NoiseSettings, a level by name or None, got"),
        ({"robot": object}, r"robot: .*'file.py:Class' or None, got <class 'object'>"),
        ({"robot": 5}, "robot: expected BodySettings, one by name such as .*, got 5"),
        (
            {"detector": object},
            "detector: .* one by name such as 'file.py:Class', got <",
        ),
        ({"detector": None}, "detector: expected DetectorSettings or .*, got None"),
        (
            {
                "settings": RunSettings(),
                "simulation": mm.SimulationSettings(time_budget=3),
            },
            "simulation.time_budget: .* got 3; give time_budget of RunSettings",
        ),
    ],
)
def test_a_robot_by_hand_is_not_made_of_what_means_nothing(
    corridor: Path, choice: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        mm.make_robot(corridor, **choice)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"text": None}, "text: expected an instruction as a text, got None"),
        ({"site": 5}, "site: expected a plan's file or one of university, .*, got 5"),
        ({"site": None}, "site: expected a plan's file or one of .*, got None"),
        ({"route": 1}, r"route: expected one of R1 .*, got 1; did you mean 'R1'\?"),
        ({"settings": {}}, r"settings: expected RunSettings\(…\), got {}"),
    ],
)
def test_what_is_of_another_type_is_refused_by_its_name(
    corridor: Path, given: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        mm.follow(**{"text": "Go.", "agent": Ahead, "site": corridor, **given})


def test_what_is_no_agent_is_refused(corridor: Path) -> None:
    with pytest.raises(SettingsError, match="expected an agent with `name`"):
        mm.follow("Go.", object(), site=corridor)  # type: ignore[arg-type]
