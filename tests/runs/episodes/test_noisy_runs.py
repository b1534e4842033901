"""Runs with noise of LiDAR and odometry, from settings to tables."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import memorymaze as mm
from memorymaze.basics.errors import RunFolderError
from memorymaze.robot.simulation.senses.noise import NOISE_LEVELS, parse_noise
from memorymaze.runs.episodes.in_words import result_lines
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import load_runs, run_tables
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import read_run

Plan = Callable[..., RunPlan]
TEXT = "Go straight, turn left at the corner, and stop at the fire extinguisher."


@pytest.fixture
def walk(loop_site: mm.Site) -> Callable[..., Any]:
    """Walk round the loop by what the LiDAR tells; return the poses."""

    def poses(**choices: Any) -> Any:
        walk = mm.follow(TEXT, "guide", site=loop_site, **choices)
        return walk.run.trajectory.poses

    return poses


@pytest.mark.proof
def test_a_noisy_walk_by_lidar_is_repeated_by_its_seed_and_unlike_an_exact_one(
    walk: Callable[..., Any],
) -> None:
    exact = walk(turning_points="lidar")
    noisy = walk(turning_points="lidar", noise="heavy")
    assert noisy == walk(turning_points="lidar", noise="heavy")
    assert noisy != exact


def test_noise_moves_no_robot_that_knows_its_place_on_the_plan(
    walk: Callable[..., Any],
) -> None:
    assert walk(noise="heavy") == walk()


def test_a_robot_driven_by_hand_has_noisy_scans(tiny_sites_folder: Path) -> None:
    site = tiny_sites_folder / "corridor.geojson"
    exact, noisy, again = (
        mm.make_robot(site, noise=noise).lidar_scan().ranges
        for noise in (None, "lidar_range_noise=0.05", "lidar_range_noise=0.05")
    )
    assert 0.03 < (noisy - exact).std() < 0.07
    assert list(noisy) == list(again)


def test_a_run_keeps_its_noise_and_is_resumed_with_no_other(
    tiny_plan: Plan, tmp_path: Path
) -> None:
    run_plan(tiny_plan("stop", limit=1, noise="light"), tmp_path / "run", workers=1)
    assert read_run(tmp_path / "run")[0].settings.noise == NOISE_LEVELS["light"]
    for other in ("heavy", None):
        with pytest.raises(RunFolderError, match=r"noise.*0\.01"):
            run_plan(
                tiny_plan("stop", limit=1, noise=other),
                tmp_path / "run",
                workers=1,
                resume=True,
            )


def test_tables_name_the_noise_and_what_of_it_has_no_effect(
    settings: Any, write: Callable[..., Path], result: Callable[..., EpisodeResult]
) -> None:
    noisy = replace(settings, noise=parse_noise("lidar_drop_out=0.2"))
    by_lidar = replace(
        noisy, simulation=replace(noisy.simulation, turning_points="lidar")
    )
    for chosen, has_effect in ((noisy, False), (by_lidar, True)):
        said = "\n".join(result_lines(chosen, [result()]))
        assert "NOISY LIDAR AND ODOMETRY: lidar_drop_out=0.2" in said
        assert ("those of odometry have no effect" in said) is not has_effect


def test_a_table_names_the_noise_beside_the_method(
    tiny_plan: Plan, tmp_path: Path
) -> None:
    for noise in (None, "heavy"):
        plan = tiny_plan("stop", limit=1, noise=noise)
        run_plan(plan, tmp_path / str(noise), workers=1)
    runs = load_runs([tmp_path / "None", tmp_path / "heavy"])
    assert [run.label for run in runs] == ["stop", "stop, heavy noise"]
    [table, *_] = run_tables(runs)
    assert "stop, heavy noise" in table.text()
    assert "lidar_range_noise=0.03" in table.csv()
