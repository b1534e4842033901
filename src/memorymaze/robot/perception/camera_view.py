"""What a camera view offers detectors and readers; no world, no site, no answers inside."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, NoReturn, Protocol

from memorymaze.basics.errors import DetectorError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.steps import CameraPicture

PixelBox = tuple[float, float, float, float]
"""Pixels (left, top, right, bottom)."""


@dataclass(frozen=True, slots=True)
class ObjectDescription:
    """How a person could name a thing they see."""

    category: str
    """Common English noun, such as `vending machine` or `door`."""
    color: str | None = None
    material: str | None = None
    """Such as `glass`, `wood`, `steel`."""
    name: str | None = None
    """Proper name people know it by."""
    text: str | None = None
    """Words written on it."""
    state: Literal["open", "closed"] | None = None
    """Of a door."""


@dataclass(frozen=True, slots=True)
class VisibleObject:
    """A thing of which the camera sees enough to recognise it."""

    description: ObjectDescription
    position: tuple[float, float]
    """Middle of the thing in the world, metres; for tracking only."""
    length: float
    """Its longer side on the floor, metres; for tracking only."""
    box: PixelBox
    """The part in the picture."""
    distance: float
    """Metres from the camera to the nearest part seen."""
    bearing: float
    """Radians from straight ahead, left positive, of its middle."""
    visible_fraction: float
    """Share of the part inside the picture that nothing hides, 0 to 1."""


@dataclass(frozen=True, slots=True)
class VisibleText:
    """What is written on a thing that the camera sees."""

    text: str
    bearer: VisibleObject
    """The thing it is on."""
    facing: float
    """Radians between the way the text faces and the way from it to the camera, 0 to
    pi; 0 is seen squarely, from pi / 2 on the camera sees its back."""
    letter_height: float
    """Of its capital letters in the 640x480 picture, pixels."""
    cut: bool = False
    """Whether the picture's edge cuts through it."""


Wanted = Callable[[ObjectDescription], bool]
"""Whether one looks for a thing; always the same answer of the same function."""


class CameraView(Protocol):
    """One look of the robot's camera."""

    @property
    def pose(self) -> Pose:
        """Where the lens is and which way it looks; for tracking only."""
        ...

    def visible_objects(
        self, range_limit: float, wanted: Wanted | None = None
    ) -> Sequence[VisibleObject]:
        """Return the things seen whose nearest seen part is within `range_limit` metres.

        Where only some are wanted, no others are looked for.
        """
        ...

    def visible_texts(
        self, range_limit: float, widest: float = math.pi
    ) -> Sequence[VisibleText]:
        """Return what is written on them, readable or not.

        What is turned away by more than `widest`, radians, is not looked at.
        """
        ...

    def picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """Draw what is seen: colours and depth of a pinhole camera with square pixels.

        Nothing is drawn until it is asked for.

        Args:
            width: Pixels.
            height: Pixels.
            horizontal_fov: Radians.

        Raises:
            RenderingError: This machine cannot draw; says what to install.
        """
        ...


class Draw(Protocol):
    """Draws or takes a picture of what the camera sees from where the robot is."""

    def __call__(self, width: int, height: int, horizontal_fov: float) -> CameraPicture:
        """Return the picture."""
        ...


class PictureView:
    """One look of a camera of which there is nothing but pictures."""

    def __init__(self, pose: Pose, take: Draw) -> None:
        """Look from a pose, by the robot's odometry."""
        self.pose = pose
        """See `CameraView.pose`."""
        self._take = take

    def picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """See `CameraView.picture`."""
        return self._take(width, height, horizontal_fov)

    def visible_objects(
        self, range_limit: float, wanted: Wanted | None = None
    ) -> NoReturn:
        """Refuse to tell."""
        raise DetectorError(
            "expected a detector that looks at pictures, such as PictureDetector; this one "
            "wants to be told what is seen, which only a simulation can"
        )

    def visible_texts(self, range_limit: float, widest: float = math.pi) -> NoReturn:
        """Refuse to tell."""
        raise DetectorError(
            "expected a reader that looks at pictures, such as PictureSignReader; this one "
            "wants to be told what is written, which only a simulation can"
        )


def box_bearing(box: PixelBox, width: int) -> float:
    """Return where the middle of a box is, radians from straight ahead, left positive.

    The picture is 90 degrees and so many pixels wide.
    """
    return math.atan2(width / 2 - (box[0] + box[2]) / 2, width / 2)


def place_at_bearing(
    pose: Pose, distance: float, bearing: float
) -> tuple[float, float]:
    """Return where something is on the plan, metres."""
    heading = pose.heading + bearing
    return (
        pose.x + distance * math.cos(heading),
        pose.y + distance * math.sin(heading),
    )
