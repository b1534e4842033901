"""What a walk leaves behind: calls and collisions, as records for files."""

from collections.abc import Mapping
from dataclasses import dataclass

from memorymaze.geometry.pose import Pose


@dataclass(frozen=True, slots=True)
class TraceEvent:
    """One call of the control API, when it was over."""

    time: float
    """Simulated seconds since the start of the episode."""
    pose: Pose
    """Where the robot was when the call returned."""
    call: str
    """Name of the function, such as `move_forward`."""
    arguments: Mapping[str, object]
    """By parameter name; values as JSON knows them."""
    result: object
    """What it returned, as JSON knows it; `{"error": ...}` when it raised."""


@dataclass(frozen=True, slots=True)
class Collision:
    """The robot's body touched something; one record however long the touch lasted."""

    time: float
    """Simulated seconds since the start of the episode."""
    pose: Pose
    """Where the robot was at the first touch."""
    kind: str
    """`wall`, `door` or `landmark`."""
    object_id: str | None
    """Id of the door or landmark; None for a wall."""
