"""The robot as agents get it, by what they need: what it can do, and nothing behind it."""

import math
from collections.abc import Callable, Collection, Sequence
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np

from memorymaze.agents.agent import Journal, Need
from memorymaze.robot.api.asking import Question
from memorymaze.robot.api.control import (
    Detection,
    Direction,
    MoveResult,
    SignText,
    TurnResult,
)
from memorymaze.robot.api.specification import ASKING_CALLS
from memorymaze.robot.api.steps import CameraPicture, LidarScan
from memorymaze.robot.api.viewpoints import Panorama
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.viewpoint_walk import ViewpointWalk
from memorymaze.runs.episodes.budgets import VIEWPOINT_M
from memorymaze.texts.passers_by import Encounters
from memorymaze.world.sites.navigation_graph import (
    NavigationGraph,
    Viewpoint,
    navigation_graph,
)


class GuardedRobot:
    """Passes on the control API, single steps, pictures and the LiDAR; has no more.

    A simulated robot also knows its building, its true pose and where routes end. An
    agent that reads these by mistake would be scored for what it cannot know, so here
    that is an error. One that wants to get at them still can: it is Python, in the same
    process.

    Pictures and single steps are for agents that declare that they need them, or that
    declare nothing: budgets and what runs record of cameras go by what is declared.
    """

    __slots__ = ("__needs", "__robot")

    def __init__(self, robot: SimulatedRobot, needs: Collection[Need] = ()) -> None:
        """Stand before a robot, for an agent that declares these needs."""
        self.__robot = robot
        self.__needs = needs

    def __getattr__(self, name: str) -> object:
        """Refuse what agents do not get."""
        if name in ASKING_CALLS:
            raise AttributeError(
                f"robot.{name} is for the track with people one can ask, and this run is "
                "not of it; give ask a number of questions (--ask N)",
                name=name,
                obj=self,
            )
        raise AttributeError(
            f"a robot that follows an instruction has no {name!r}: agents get what is in "
            "memorymaze.robot.api.control and memorymaze.robot.api.steps",
            name=name,
            obj=self,
        )

    def move_forward(self, distance: float) -> MoveResult:
        """See `Robot.move_forward`."""
        return self.__robot.move_forward(distance)

    def detect_turning_point(self) -> list[Direction]:
        """See `Robot.detect_turning_point`."""
        return self.__robot.detect_turning_point()

    def turning_point_id(self) -> int | None:
        """See `Robot.turning_point_id`."""
        return self.__robot.turning_point_id()

    def turn(self, direction: str) -> TurnResult:
        """See `Robot.turn`."""
        return self.__robot.turn(direction)

    def turn_by(self, degrees: float) -> TurnResult:
        """See `Robot.turn_by`."""
        return self.__robot.turn_by(degrees)

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        """See `Robot.detect_from_RGB_image`."""
        return self.__robot.detect_from_RGB_image(object)

    def read_signs(self) -> list[SignText]:
        """See `Robot.read_signs`."""
        return self.__robot.read_signs()

    def say(self, text: str) -> None:
        """See `Robot.say`."""
        self.__robot.say(text)

    def distance_travelled(self) -> float:
        """See `Robot.distance_travelled`."""
        return self.__robot.distance_travelled()

    def stop(self) -> None:
        """See `Robot.stop`."""
        self.__robot.stop()

    def step_forward(self, distance: float) -> float:
        """See `SteppingRobot.step_forward`."""
        self.__expect("steps", "step_forward")
        return self.__robot.step_forward(distance)

    def rotate(self, angle: float) -> float:
        """See `SteppingRobot.rotate`."""
        self.__expect("steps", "rotate")
        return self.__robot.rotate(angle)

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `SteppingRobot.camera_picture`."""
        self.__expect("camera", "camera_picture")
        return self.__robot.camera_picture(width, height, horizontal_fov)

    def lidar_scan(self) -> LidarScan:
        """See `SteppingRobot.lidar_scan`."""
        return self.__robot.lidar_scan()

    def __expect(self, need: Need, call: str) -> None:
        if self.__needs and need not in self.__needs:
            declared = ", ".join(map(repr, sorted(self.__needs)))
            raise AttributeError(
                f"robot.{call} is for agents that declare {need!r}, and this one declares "
                f"needs = {{{declared}}}; add {need!r} there",
                name=call,
                obj=self,
            )

    def __repr__(self) -> str:
        """Say what it is, and nothing of where."""
        return "GuardedRobot(a robot that follows an instruction)"


class AskingGuardedRobot(GuardedRobot):
    """The same in the track with people one can ask; of them it passes on words alone."""

    __slots__ = ("__encounters",)

    def __init__(
        self, robot: SimulatedRobot, needs: Collection[Need], encounters: Encounters
    ) -> None:
        """Stand before a robot and the people around it."""
        super().__init__(robot, needs)
        self.__encounters = encounters

    def destination(self) -> str:
        """See `AskingRobot.destination`."""
        return self.__encounters.destination

    def questions_left(self) -> int:
        """See `AskingRobot.questions_left`."""
        return self.__encounters.questions_left

    def ask(self, question: Question) -> str | None:
        """See `AskingRobot.ask`."""
        return self.__encounters.ask(question)


class RobotThatKnows(GuardedRobot):
    """The same with the answers: for baselines that show what the body can reach."""

    __slots__ = ("__reference_path", "__robot")

    def __init__(
        self,
        robot: SimulatedRobot,
        needs: Collection[Need],
        reference_path: Sequence[tuple[float, float]],
    ) -> None:
        """Stand before a robot whose episode has this reference path."""
        super().__init__(robot, needs)
        self.__robot = robot
        self.__reference_path = tuple(reference_path)

    def reference_path(self) -> tuple[tuple[float, float], ...]:
        """Return the way from the start to the goal, in metres on the plan."""
        return self.__reference_path

    def follow_reference_path(self) -> None:
        """Drive along it."""
        self.__robot.follow(self.__reference_path)


class OracleAgent:
    """Follows the reference path of its episode and stops at the goal.

    It shows what the robot's body can reach, whatever is understood of the text.
    """

    name = "oracle"
    needs: ClassVar[frozenset[Need]] = frozenset({"answers"})

    def follow(
        self,
        instruction: str,
        robot: RobotThatKnows,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive along the reference path."""
        robot.follow_reference_path()
        robot.stop()


DRIVING_ROOM = 0.3
"""Metres that edges keep from walls: the robot's radius, and what steering needs."""


def hand_over(
    robot: SimulatedRobot,
    needs: frozenset[Need],
    reference_path: tuple[tuple[float, float], ...],
    people: Encounters | None = None,
    look: Callable[[Viewpoint], Panorama] | None = None,
) -> Any:
    """Return the robot of an episode as an agent gets it that needs these.

    One that needs the graph gets a `ViewpointRobot`, which drives to its first viewpoint;
    one that needs the answers a guarded robot that knows the way. Neither can ask people.

    Args:
        robot: The robot itself.
        needs: What the agent declares.
        reference_path: Of the episode, from its start.
        people: Those one can ask; None where there are none.
        look: Describes what is seen from viewpoints; None for templates.

    Raises:
        EpisodeOver: A budget ran out on the way to the first viewpoint.
    """
    if "graph" in needs:
        return ViewpointWalk(robot, graph_of(robot.scene), look)
    if "answers" in needs:
        return RobotThatKnows(robot, needs, reference_path)
    if people is None:
        return GuardedRobot(robot, needs)
    return AskingGuardedRobot(robot, needs, people)


@lru_cache(maxsize=8)
def graph_of(scene: Scene) -> NavigationGraph:
    """Return the navigation graph that robots drive in a scene."""
    return navigation_graph(scene.site, spacing=VIEWPOINT_M, robot_radius=DRIVING_ROOM)
