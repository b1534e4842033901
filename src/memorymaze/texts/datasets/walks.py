"""Walks along a route by single steps, as VLN-CE and NaVid count them."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.texts.exchange.vln_ce import (
    FORWARD,
    LEFT,
    RIGHT,
    STEP,
    STOP,
    TURN,
    LineFollower,
)
from memorymaze.world.sites.records import Route

SHORT = 0.01
"""Metres that a step may lack."""
UNHURRIED = SimulationSettings(
    wheel_noise=0.0, time_budget=math.inf, call_budget=10**9, stuck_limit=10**9
)


@dataclass(frozen=True, slots=True, eq=False)
class StepWalk:
    """A walk to the end of a route; its last action is to stop."""

    actions: NDArray[np.int64]
    """Numbers of VLN-CE, shape (N,)."""
    poses: NDArray[np.float64]
    """x, y and heading before each action, metres and radians, shape (N, 3)."""

    def __len__(self) -> int:
        """Return the number of actions."""
        return len(self.actions)

    def pose(self, number: int) -> Pose:
        """Return where the robot stands before an action."""
        x, y, heading = self.poses[number].tolist()
        return Pose(x, y, heading)


def walk_by_steps(scene: Scene, route: Route) -> StepWalk:
    """Let the robot go along a route as VLN-CE's ground truth does, action by action.

    Every action is chosen from where the robot really stands, so that what hundreds of
    steps are off does not add up.

    Raises:
        MemoryMazeError: Something is in the way.
    """
    line = [(x, y) for x, y, *_ in route.line.coords]
    follower = LineFollower(line)
    robot = SimulatedRobot(scene, route.start, UNHURRIED)
    actions: list[int] = []
    poses: list[Pose] = []

    def begin(action: int) -> None:
        actions.append(action)
        poses.append(robot.pose)

    while (turns := follower.turns_before_step(robot.pose)) is not None:
        for _ in range(abs(turns)):
            begin(LEFT if turns > 0 else RIGHT)
            robot.rotate(math.copysign(TURN, turns))
        begin(FORWARD)
        if robot.step_forward(STEP) < STEP - SHORT or robot.collisions:
            raise MemoryMazeError(
                f"{scene.site.name}: {route.id}: expected a way that can be walked by "
                f"steps of {STEP} m, got stopped at ({robot.pose.x:.1f}, "
                f"{robot.pose.y:.1f}); see `memorymaze sites check`"
            )
    begin(STOP)
    return StepWalk(np.array(actions), np.array(poses))
