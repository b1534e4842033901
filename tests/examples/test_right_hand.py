"""The agent that the README shows."""

import runpy
from pathlib import Path

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.world.sites.records import Site

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "right_hand.py"


def test_the_readme_shows_the_example_agent_as_it_is() -> None:
    source = EXAMPLE.read_text(encoding="utf-8")
    shown = source.split('"""\n', 1)[1].strip()
    assert shown in (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_example_agent_keeps_to_the_right_and_stops(loop_site: Site) -> None:
    agent = runpy.run_path(str(EXAMPLE))["RightHand"]()
    robot = SimulatedRobot(build_scene(loop_site), loop_site.routes[0].start)
    journal = Journal()
    agent.follow("anywhere", robot, journal, np.random.default_rng(0))
    assert 60 <= robot.distance_travelled() < 61
    assert journal.notes
    assert robot.collisions == ()
