"""The examples of the prompt for programs lead where their descriptions say."""

import math
import re
from dataclasses import replace
from typing import Any

import pytest
from shapely import box
from tests.robot.simulation.conftest import PutRobot

from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import EpisodeOver
from memorymaze.language.models.prompt_texts import load_prompt
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.steering.calls import TraceEvent
from memorymaze.world.sites import Site


def run_example(number: int, robot: SimulatedRobot) -> None:
    prompt = load_prompt("write_program", api_specification="", answer="")
    program = re.findall(r"Refined program:\n```python\n(.*?)```", prompt, re.S)[number]
    with pytest.raises(EpisodeOver, match="agent"):
        run_program(program, robot)


def turns(events: list[TraceEvent]) -> list[object]:
    return [each.arguments["direction"] for each in events if each.call == "turn"]


@pytest.fixture
def third_on_the_left(plans: Any) -> Site:
    """Three ways on the left at x = 8, 18 and 28; the third ends at a corner.

    From there a hallway leads east along y = 15, with a yellow door on its north side.
    """
    wall = {"mount": "wall", "obstacle": False, "degrees": -90}
    door = plans.thing("door", 39, 16.15, size=(1.0, 0.06, 2.1), **wall)
    parts: list[object] = [
        plans.corridor("main", 0, -1.5, 40, 1.5),
        plans.corridor("hall", 26.8, 13.8, 50, 16.2),
        plans.turning_point(
            "corner", box(26.8, 13.8, 29.2, 16.2), [("way_28", -90), ("hall", 0)]
        ),
        replace(door, category="door", color="yellow"),
    ]
    for x in (8, 18, 28):
        end = 16.2 if x == 28 else 9
        parts.append(plans.corridor(f"way_{x}", x - 1.2, 1.5, x + 1.2, end))
        ways = [("main", 0), ("main", 180), (f"way_{x}", 90)]
        mouth = box(x - 1.2, -1.5, x + 1.2, 1.5)
        parts.append(plans.turning_point(f"left_{x}", mouth, ways))
    return plans.site(*parts)


@pytest.mark.parametrize(
    "x", [pytest.param(1, id="before the first way"), pytest.param(7.5, id="inside it")]
)
def test_the_first_program_goes_to_the_yellow_door(
    third_on_the_left: Site, put_robot: PutRobot, x: float
) -> None:
    events: list[TraceEvent] = []
    robot = put_robot(build_scene(third_on_the_left), x, 0, events=events)
    run_example(0, robot)
    assert turns(events) == ["left", "right"]
    assert robot.pose[:2] == pytest.approx((39, 15), abs=2)


def test_the_second_program_goes_up_to_the_machine_aside_in_the_hall(
    plans: Any, put_robot: PutRobot
) -> None:
    machine = plans.thing("machine", 20, 41, size=(1.0, 0.7, 1.8), degrees=-90)
    site = plans.site(
        plans.corridor("east", 0, -1.5, 31.5, 1.5),
        plans.corridor("north", 28.5, -1.5, 31.5, 40),
        plans.corridor("across", 20, 10.5, 40, 13.5),
        plans.corridor("west", 22, 22.5, 31.5, 25.5),
        plans.corridor("mouth", 22, 22.5, 24.4, 33),
        plans.area("hall", box(14, 33, 27, 44)),
        plans.turning_point(
            "bend", box(28.5, -1.5, 31.5, 1.5), [("east", 180), ("north", 90)]
        ),
        plans.turning_point(
            "crossing",
            box(28.5, 10.5, 31.5, 13.5),
            [("north", -90), ("north", 90), ("across", 0), ("across", 180)],
        ),
        plans.turning_point(
            "bicycles",
            box(28.5, 22.5, 31.5, 25.5),
            [("north", -90), ("north", 90), ("west", 180)],
        ),
        plans.turning_point(
            "right", box(22, 22.5, 24.4, 25.5), [("west", 0), ("mouth", 90)]
        ),
        replace(machine, category="ticket machine"),
    )
    events: list[TraceEvent] = []
    robot = put_robot(build_scene(site), 1, 0, events=events)
    run_example(1, robot)
    assert turns(events) == ["left", "left", "right"]
    assert math.dist(robot.pose[:2], (20, 41)) < 2.5
    assert robot.collisions == ()
