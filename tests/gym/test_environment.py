import math
import subprocess
import sys
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env
from numpy.typing import NDArray
from tests.runs.episodes import own_bodies

from memorymaze.basics.errors import InstructionFileError, SettingsError
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.gym import (
    ENVIRONMENTS,
    ContinuousActions,
    DiscreteActions,
    Senses,
    register_environments,
)
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.runs.episodes.settings import RunSettings

Settings = Callable[..., dict[str, Any]]
MakeTiny = Callable[..., gymnasium.Env[Any, Any]]
STOP, AHEAD, LEFT, RIGHT = range(4)
METRICS = {
    *("stopped_by", "success", "oracle_success", "spd", "spl", "cls"),
    *("ndtw", "sdtw", "path_length"),
}
SECRETS = {"pose", "goal", "reference_path", "distance_to_goal"}


@pytest.mark.parametrize("actions", ["discrete", "continuous"])
def test_a_building_of_ones_own_passes_gymnasiums_checks(
    make_tiny: MakeTiny, actions: str
) -> None:
    env = make_tiny(
        "t_junction",
        actions=actions,
        sensors=Senses(("rgb", "depth", "lidar"), width=32, height=24),
        render_mode="rgb_array",
    )
    check_env(env.unwrapped)


@pytest.mark.proof
@pytest.mark.parametrize("name", ["University", "Museum5F", "Museum7F"])
def test_the_buildings_of_the_benchmark_pass_gymnasiums_checks(name: str) -> None:
    env = gymnasium.make(
        f"MemoryMaze/{name}-v0",
        sensors={"width": 32, "height": 24},
        render_mode="rgb_array",
    )
    check_env(env.unwrapped)


def test_an_observation_holds_the_instruction_and_what_the_sensors_see(
    make_tiny: MakeTiny,
) -> None:
    env = make_tiny(
        "corridor", sensors=Senses(("rgb", "depth", "lidar"), width=48, height=32)
    )
    seen, told = env.reset(options={"episode_id": "p1-1"})
    assert env.observation_space.contains(seen)
    assert seen["instruction"] == told["instruction"]
    assert seen["rgb"].shape == (32, 48, 3)
    assert seen["rgb"].std() > 5, "a picture of one colour"
    # The corridor is 20 m long: its end is beyond what the depth sensor reaches.
    assert seen["depth"].shape == (32, 48)
    assert seen["depth"].max() == 10
    assert 1 < seen["depth"].min() < 3
    # Ahead, left and right; it stands at (2, 0) in a corridor 3 m wide.
    assert seen["lidar"][[180, 270, 90]] == pytest.approx([18, 1.5, 1.5], abs=0.1)


def test_only_the_sensors_asked_for_are_there(make_tiny: MakeTiny) -> None:
    seen, _ = make_tiny(sensors=("lidar",)).reset()
    assert set(seen) == {"instruction", "lidar"}


@pytest.mark.parametrize("degrees", [15.0, 30.0])
def test_discrete_actions_move_by_their_step_and_turn_by_their_angle(
    make_tiny: MakeTiny, degrees: float
) -> None:
    env = make_tiny(actions=DiscreteActions(turn_deg=degrees), privileged=True)
    _, before = env.reset(options={"episode_id": "p6-1"})
    poses = [before["pose"]]
    for action in (AHEAD, LEFT, RIGHT, RIGHT):
        poses.append(env.step(action)[4]["pose"])
    assert math.dist(poses[0][:2], poses[1][:2]) == pytest.approx(0.25, abs=0.001)
    turned = [
        math.degrees(turn_between(one[2], other[2]))
        for one, other in pairwise(poses[1:])
    ]
    assert turned == pytest.approx([degrees, -degrees, -degrees], abs=0.1)


def test_a_continuous_action_is_speed_and_turn_rate_for_a_time_step(
    make_tiny: MakeTiny,
) -> None:
    env = make_tiny(actions=ContinuousActions(time_step=0.5), privileged=True)
    _, before = env.reset(options={"episode_id": "p6-1"})
    for _ in range(8):
        *_, ahead = env.step(np.array([0.6, 0.0], dtype=np.float32))
    moved = math.dist(before["pose"][:2], ahead["pose"][:2])
    # 0.6 m/s for 4 s, less what speeding up at 1.5 m/s2 costs: 0.12 m.
    assert moved == pytest.approx(2.28, abs=0.05)
    assert ahead["time"] == pytest.approx(4.0)
    for _ in range(2):
        *_, left = env.step(np.array([0.0, 0.5], dtype=np.float32))
    assert turn_between(ahead["pose"][2], left["pose"][2]) > 0.5
    *_, terminated, truncated, _ = env.step(np.array([0.01, -0.01], dtype=np.float32))
    assert (terminated, truncated) == (True, False)


def test_stopping_at_the_goal_is_a_success_and_pays(make_tiny: MakeTiny) -> None:
    env = make_tiny("corridor")
    env.reset(options={"episode_id": "p1-1"})
    earned = 0.0
    for _ in range(58):
        _, reward, terminated, truncated, told = env.step(AHEAD)
        assert (terminated, truncated) == (False, False)
        assert not (METRICS | SECRETS) & set(told)
        earned += reward
    # R1 runs from (2, 0) to (16.5, 0).
    assert earned == pytest.approx(14.5 - 58 * 0.01, abs=0.1)
    _, reward, terminated, truncated, told = env.step(STOP)
    assert (terminated, truncated) == (True, False)
    assert reward == pytest.approx(10 - 0.01)
    assert set(told) >= METRICS
    assert not SECRETS & set(told)
    assert (told["success"], told["stopped_by"]) == (1.0, "agent")
    assert told["spd"] < 0.1
    assert told["spl"] > 0.95


def test_stopping_elsewhere_is_none(make_tiny: MakeTiny) -> None:
    env = make_tiny("corridor", reward="sparse")
    env.reset(options={"episode_id": "p1-1"})
    assert env.step(AHEAD)[1] == 0
    _, reward, terminated, _, told = env.step(STOP)
    assert (reward, terminated, told["success"]) == (0, True, 0.0)
    assert told["spd"] == pytest.approx(14.25, abs=0.05)


def test_used_up_steps_truncate_and_are_no_success(make_tiny: MakeTiny) -> None:
    env = make_tiny("corridor", max_steps=58)
    env.reset(options={"episode_id": "p1-1"})
    for _ in range(58):
        _, reward, terminated, truncated, told = env.step(AHEAD)
    assert (terminated, truncated) == (False, True)
    assert (told["success"], told["spl"], told["stopped_by"]) == (0.0, 0.0, "budget")
    assert told["oracle_success"] == 1.0
    assert reward < 1
    with pytest.raises(ResetNeeded):
        env.step(AHEAD)


def test_pushing_a_wall_for_ever_truncates_and_collisions_cost(
    make_tiny: MakeTiny,
) -> None:
    env = make_tiny("corridor", reward={"progress": 0, "step": 0})
    env.reset(options={"episode_id": "p1-1"})
    rewards, truncated, told = [], False, {}
    while not truncated:
        _, reward, _, truncated, told = env.step(AHEAD)
        rewards.append(reward)
    assert told["stopped_by"] == "stuck"
    assert told["collisions"] >= 1
    assert sum(rewards) == pytest.approx(-0.1 * told["collisions"])


def test_budgets_default_to_three_times_what_a_perfect_follower_needs(
    make_tiny: MakeTiny,
) -> None:
    plain: Any = make_tiny("corridor").unwrapped
    # 14.5 m in steps of 0.25 m, and one to stop.
    assert plain.max_steps == math.ceil(3 * (14.5 / 0.25 + 1))
    turning: Any = make_tiny("t_junction").unwrapped
    wide: Any = make_tiny("t_junction", actions=DiscreteActions(turn_deg=30)).unwrapped
    assert turning.max_steps - wide.max_steps == 3 * 3


def test_the_same_seed_gives_the_same_episodes_and_steps(make_tiny: MakeTiny) -> None:
    runs = []
    for seed in (3, 3, 4):
        env = make_tiny(privileged=True)
        env.action_space.seed(1)
        walk = []
        for first in (True, False, False):
            _, told = env.reset(seed=seed if first else None)
            walk.append(told["episode_id"])
            for _ in range(5):
                told = env.step(AHEAD)[4]
                walk.append(tuple(told["pose"].tolist()))
        runs.append(walk)
    assert runs[0] == runs[1]
    assert runs[0] != runs[2]


def test_chance_reaches_every_episode(make_tiny: MakeTiny) -> None:
    env = make_tiny()
    ids: Any = env.unwrapped.get_wrapper_attr("episode_ids")
    env.reset(seed=0)
    assert {env.reset()[1]["episode_id"] for _ in range(60)} == set(ids)


def test_episodes_are_chosen_by_route_study_and_split() -> None:
    def ids(**settings: Any) -> set[str]:
        env = gymnasium.make("MemoryMaze/University-v0", sensors=(), **settings)
        return set(env.unwrapped.get_wrapper_attr("episode_ids"))

    every = ids()
    assert ids(route="R1") | ids(route="R2") == every
    assert ids(study="online") | ids(study="onsite") == every
    halves = [ids(settings={"split": split}) for split in ("dev", "test")]
    assert halves[0] | halves[1] == every
    one = ids(route="R1", study="online", settings={"split": "dev"})
    assert one == ids(route="R1") & ids(study="online") & halves[0]
    assert one


def test_privileged_information_tells_the_goal_and_the_way(make_tiny: MakeTiny) -> None:
    env = make_tiny("corridor", privileged=True)
    _, told = env.reset(options={"episode_id": "p1-1"})
    assert set(told) >= SECRETS
    assert told["goal"] == pytest.approx([16.5, 0], abs=0.5)
    assert told["distance_to_goal"] == pytest.approx(14.5, abs=0.5)


def test_who_wrote_the_instruction_is_always_said() -> None:
    env = gymnasium.make("MemoryMaze/University-v0", sensors=())
    assert env.reset()[1]["instruction_source"] == "llm"


def test_people_and_things_can_be_there(make_tiny: MakeTiny) -> None:
    env = make_tiny(settings=RunSettings(obstacles=ObstacleSettings(people=2)))
    env.reset(seed=0)
    for _ in range(5):
        env.step(AHEAD)


def test_settings_of_a_run_act_in_an_environment_too(make_tiny: MakeTiny) -> None:
    env: Any = make_tiny(
        settings={"obstacles": "light,people=0", "max_speed": 0.5, "time_budget": 1}
    )
    env.reset(options={"episode_id": "p6-1"})
    *_, truncated, told = env.step(AHEAD)
    while not truncated:
        *_, truncated, told = env.step(AHEAD)
    assert env.unwrapped.settings.obstacles.people == 0
    assert told["stopped_by"] == "budget"
    assert told["time"] == pytest.approx(1, abs=0.2)


def test_noise_of_the_settings_is_in_the_scans_and_comes_from_the_seed(
    make_tiny: MakeTiny,
) -> None:
    def scan(**settings: str) -> NDArray[np.float32]:
        env = make_tiny("corridor", sensors=("lidar",), settings=settings)
        seen, _ = env.reset(seed=3, options={"episode_id": "p1-1"})
        assert env.observation_space.contains(seen)
        return seen["lidar"]

    exact, noisy = scan(), scan(noise="light")
    assert 0 < np.median(np.abs(noisy - exact)) < 0.03
    assert np.array_equal(noisy, scan(noise="light"))


def test_a_body_of_ones_own_is_driven_and_put_away(make_tiny: MakeTiny) -> None:
    robot = f"{own_bodies.__name__}:Localised"
    env = make_tiny("loop", settings={"robot": robot}, privileged=True)
    _, before = env.reset(seed=1)
    after = env.step(AHEAD)[4]
    moved = math.dist(before["pose"][:2], after["pose"][:2])
    assert moved == pytest.approx(0.25, abs=0.03)
    env.reset(seed=2)
    assert [each.closed for each in own_bodies.opened[-2:]] == [1, 0]
    env.close()
    assert own_bodies.opened[-1].closed == 1


def test_it_draws_what_the_camera_sees_and_closes_twice(make_tiny: MakeTiny) -> None:
    env = make_tiny(
        "corridor", render_mode="rgb_array", sensors={"width": 40, "height": 30}
    )
    env.reset()
    picture: Any = env.render()
    assert picture.shape == (30, 40, 3)
    env.close()
    env.close()


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        pytest.param({"site": "nowhere"}, "university", id="site"),
        pytest.param({"site": "nowhere.geojson"}, "a plan's file", id="no file"),
        pytest.param({"instructions": None}, "give instructions=FILE", id="no texts"),
        pytest.param({"route": "R9"}, "route: expected one of R1", id="route"),
        pytest.param({"study": "phone"}, "got 'phone'", id="study"),
        pytest.param({"settings": {"split": "x"}}, "split: expected one", id="split"),
        pytest.param(
            {"settings": {"splits": "dev"}}, "did you mean 'split'", id="name"
        ),
        pytest.param({"settings": {"seed": 3}}, "no use for seed", id="seed"),
        pytest.param({"settings": {"signs": "ocr"}}, "no use for signs", id="signs"),
        pytest.param({"settings": {"ask": 1}}, "no use for ask", id="ask"),
        pytest.param(
            {"settings": {"budget_by": "longest"}}, "no use for budget_by", id="time"
        ),
        pytest.param(
            {"settings": {"turning_points": "lidar", "detection_range": 1.0}},
            "no use for detection_range, turning_points",
            id="of the control API",
        ),
        pytest.param(
            {"settings": {"call_budget": 5}}, "no use for call_budget", id="calls"
        ),
        pytest.param({"sensors": ("sonar",)}, "rgb, depth, lidar", id="sensor"),
        pytest.param({"sensors": "rgb"}, "in a list", id="sensors as text"),
        pytest.param({"sensors": {"width": 0}}, "width", id="width"),
        pytest.param({"sensors": {"horizontal_fov": 90}}, "radians", id="degrees"),
        pytest.param({"sensors": {"depth_range": -1}}, "depth_range", id="depth"),
        pytest.param({"actions": "jump"}, "'discrete'", id="actions"),
        pytest.param({"actions": ["discrete"]}, "'discrete'", id="actions in a list"),
        pytest.param({"reward": "money"}, "'sparse'", id="reward"),
        pytest.param({"reward": 5}, "'sparse'", id="reward as a number"),
        pytest.param({"reward": {"win": 1}}, "success", id="part of the reward"),
        pytest.param({"max_steps": 0}, "max_steps", id="steps"),
        pytest.param({"settings": {"success_distance": 0}}, "distance", id="distance"),
        pytest.param({"sensors": {"wide": 1}}, "horizontal_fov", id="sense"),
    ],
)
def test_settings_without_meaning_are_refused(
    tiny_settings: Settings, settings: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        gymnasium.make("MemoryMaze/Site-v0", **tiny_settings(**settings))


@pytest.mark.parametrize(
    "make",
    [
        lambda: DiscreteActions(forward=0),
        lambda: DiscreteActions(turn_deg=270),
        lambda: ContinuousActions(time_step=0.123456),
        lambda: ContinuousActions(stop_below=2),
    ],
)
def test_actions_without_meaning_are_refused(make: Any) -> None:
    with pytest.raises(SettingsError, match=r"actions: .*expected"):
        make()


def test_broken_instruction_files_are_told(
    tiny_settings: Settings, tmp_path: Path
) -> None:
    bad = tmp_path / "bad.jsonl"
    bad.write_text("{}\n", encoding="utf-8")
    with pytest.raises(InstructionFileError, match=r"bad\.jsonl:1"):
        gymnasium.make("MemoryMaze/Site-v0", **tiny_settings(instructions=str(bad)))


def test_wrong_options_and_actions_are_told(make_tiny: MakeTiny) -> None:
    env: Any = make_tiny().unwrapped
    with pytest.raises(ResetNeeded):
        env.step(AHEAD)
    with pytest.raises(SettingsError, match="did you mean 'p6-1'"):
        env.reset(options={"episode_id": "p6_1"})
    with pytest.raises(SettingsError, match="expected no option but"):
        env.reset(options={"episode": "p6-1"})
    env.reset()
    with pytest.raises(SettingsError, match="got 7"):
        env.step(7)


def run(program: str) -> str:
    """Run a program in a fresh interpreter; return what it printed."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(
    "program",
    [
        pytest.param(
            "import gymnasium\n"
            "gymnasium.make('memorymaze:MemoryMaze/University-v0', sensors=())",
            id="by the name of the package",
        ),
        pytest.param(
            "import memorymaze.world.sites, gymnasium\n"
            "gymnasium.make('memorymaze.gym:MemoryMaze/Museum7F-v0', sensors=())",
            id="by the name of the room",
        ),
    ],
)
def test_gymnasium_finds_the_environments(program: str) -> None:
    run(program)


def test_the_package_alone_does_not_load_gymnasium() -> None:
    said = run(
        "import memorymaze.front.cli.main, sys\nprint('gymnasium' in sys.modules)"
    )
    assert said == "False\n"


def test_registering_twice_changes_nothing() -> None:
    before = {name: gymnasium.registry[name] for name in ENVIRONMENTS}
    register_environments()
    assert all(gymnasium.registry[name] is spec for name, spec in before.items())
