"""What a guide robot can be asked to do: the control API and its records, as roles.

`Robot` is what programs, agents and people call, and its docstrings are what language
models are told (`specification`); `SteppingRobot` adds single steps, pictures and scans,
`viewpoints.ViewpointRobot` goes along a graph, `asking.AskingRobot` asks people.
`SensorsAndMotion` is what a body brings. No robot is in here: the one there is drives in
`simulation`, and what an agent decides is in `agents`.
"""

from memorymaze.robot.api.control import (
    Detection,
    Direction,
    MoveResult,
    Robot,
    SignText,
    TurnResult,
)
from memorymaze.robot.api.sensors_and_motion import OdometryReading, SensorsAndMotion
from memorymaze.robot.api.steps import CameraPicture, LidarScan, SteppingRobot

__all__ = [
    "CameraPicture",
    "Detection",
    "Direction",
    "LidarScan",
    "MoveResult",
    "OdometryReading",
    "Robot",
    "SensorsAndMotion",
    "SignText",
    "SteppingRobot",
    "TurnResult",
]
