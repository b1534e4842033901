"""The example of an agent that goes by steps, and what a type checker says to it."""

import json
import runpy
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import memorymaze as mm
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.runs.episodes.guarded_robot import GuardedRobot

EXAMPLE = Path(__file__).parents[2] / "examples" / "depth_walker.py"

USES = """
import memorymaze as mm
from examples.depth_walker import DepthWalker
from examples.right_hand import RightHand

def seen(robot: mm.SteppingRobot) -> float:
    return float(robot.camera_picture().depth.min() + robot.lidar_scan().ranges.min())

mm.follow("Go.", agent=DepthWalker(), site="university", route="R1")
mm.evaluate(DepthWalker())
mm.evaluate(RightHand())
"""


def test_it_stops_before_the_wall_it_sees(corridor_site: mm.Site) -> None:
    agent = runpy.run_path(str(EXAMPLE))["DepthWalker"]()
    start = corridor_site.routes[0].start._replace(x=14.0)
    robot = SimulatedRobot(build_scene(corridor_site), start)
    journal = mm.Journal()

    agent.follow("Go.", GuardedRobot(robot), journal, np.random.default_rng(0))

    assert journal.notes[-1].details["metres"] < 1.5
    assert not robot.collisions


@pytest.mark.proof
@pytest.mark.parametrize("wrong", [False, True])
def test_pyright_accepts_agents_that_are_annotated_with_the_roles(
    tmp_path: Path, wrong: bool, check_types: Callable[..., list[str]]
) -> None:
    said = check_types(USES + ("DepthWalker().follow(1)\n" if wrong else ""))
    assert bool(said) == wrong, said


@pytest.fixture
def check_types(tmp_path: Path) -> Callable[[str], list[str]]:
    """Return what pyright in strict mode says to a program."""
    root = EXAMPLE.parents[1]

    def check(program: str) -> list[str]:
        (tmp_path / "uses.py").write_text(program, encoding="utf-8")
        (tmp_path / "examples").mkdir()
        for name in ("depth_walker.py", "right_hand.py"):
            source = (root / "examples" / name).read_text(encoding="utf-8")
            (tmp_path / "examples" / name).write_text(source, encoding="utf-8")
        settings = {"typeCheckingMode": "strict", "extraPaths": [str(root / "src")]}
        (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings))
        done = subprocess.run(
            [
                *(sys.executable, "-m", "pyright", "--outputjson"),
                *("--pythonpath", sys.executable, "--project", str(tmp_path)),
            ],
            capture_output=True,
            text=True,
            check=False,
        )
        found = json.loads(done.stdout)["generalDiagnostics"]
        return [each["message"] for each in found if each["severity"] == "error"]

    return check
