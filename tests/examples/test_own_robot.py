"""The body of forty lines that docs/bodies.md shows."""

import runpy
from pathlib import Path

import pytest

from memorymaze.robot.steering.guide_robot import GuideRobot
from memorymaze.testing import check_robot

EXAMPLE = Path(__file__).parents[2] / "examples" / "own_robot.py"
example = runpy.run_path(str(EXAMPLE))


def test_it_gets_the_whole_control_api() -> None:
    check_robot(GuideRobot(example["PointBody"]()))


def test_its_body_has_forty_lines_besides_what_it_says_of_itself() -> None:
    source = EXAMPLE.read_text(encoding="utf-8")
    body = source.partition("class PointBody")[2].partition("\n\n\n")[0].splitlines()
    code = [line for line in body if line.strip() and '"""' not in line]
    assert len(code) <= 40


def test_it_walks_round_the_corner(capsys: pytest.CaptureFixture[str]) -> None:
    robot = GuideRobot(example["PointBody"]())
    example["walk_round_the_corner"](robot)
    assert "turned 90 degrees, to the right" in capsys.readouterr().out
    assert robot.distance_travelled() == pytest.approx(12 + 7.3, abs=0.5)
