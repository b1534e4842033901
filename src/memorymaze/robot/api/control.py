"""The control API that programs, agents and people drive a guide robot with.

The docstrings of `Robot` are the specification a language model is prompted with
(`memorymaze.robot.api.specification`), so they say exactly what an implementation does.
"""

from dataclasses import dataclass
from typing import Literal, Protocol, runtime_checkable

Direction = Literal[
    "left",
    "right",
    "forward",
    "slight_left",
    "slight_right",
    "sharp_left",
    "sharp_right",
    "around",
]
"""Directions relative to the robot. `around` is only an argument of `turn`."""

DIRECTIONS: tuple[Direction, ...] = (
    "left",
    "right",
    "forward",
    "slight_left",
    "slight_right",
    "sharp_left",
    "sharp_right",
    "around",
)

MoveEnd = Literal["done", "wall", "obstacle", "budget"]
"""Why a `move_forward` ended."""

DETECTION_RANGE = 4.0
"""Detections farther than this many metres are dropped (paper, Sec. III-B)."""

READING_RANGE = 6.0
"""Texts farther than this many metres are not read."""


@dataclass(frozen=True, slots=True)
class MoveResult:
    """What a `move_forward` did."""

    distance: float
    """Metres really moved; less than asked for when something was in the way."""
    reason: MoveEnd
    """`done`, `wall`, `obstacle`, or `budget` (the episode's budget ran out)."""


@dataclass(frozen=True, slots=True)
class TurnResult:
    """What a `turn` did."""

    turned: bool
    """False when there is no way in that direction; the robot did not move."""
    angle_deg: float
    """Degrees really turned, left positive; 0 when it did not turn."""
    message: str
    """What happened, in words; where it did not turn, the directions there are."""


@dataclass(frozen=True, slots=True)
class Detection:
    """One object the camera sees within 4 m."""

    label: str
    """What it is, as the detector names it, for example `bench`."""
    box: tuple[float, float, float, float]
    """Pixels (left, top, right, bottom) in the 640x480 picture."""
    score: float
    """How well it fits the words asked for, 0 to 1. What fits badly is left out
    already: no threshold is needed."""
    distance: float
    """Metres from the camera to the nearest part seen of it."""
    bearing_deg: float
    """Direction of its middle, degrees, left positive, 0 straight ahead."""
    track_id: int
    """The same number each time the same thing is seen."""


@dataclass(frozen=True, slots=True)
class SignText:
    """One text the camera can read within 6 m."""

    text: str
    """The words as they are written, on one line; a letter may be read wrongly."""
    distance: float
    """Metres from the camera to the text."""
    bearing_deg: float
    """Direction of its middle, degrees, left positive, 0 straight ahead."""
    track_id: int
    """The same number each time the same text is read."""


@runtime_checkable
class Robot(Protocol):
    """A wheeled guide robot that walks beside a blind person indoors.

    It is 0.5 m wide, drives at up to 1.0 m/s, and has a camera that looks ahead
    (640x480 pixels, 90 degrees wide, 1.25 m above the floor). It knows neither a map
    nor where the goal is.

    At the start it faces the way the description begins with: what one comes from
    ("from the lifts") is behind it, and every turn that is told is still to be made.
    It may stand inside a turning point already, that of the first turn.

    Time is limited, to a small multiple of what the way takes; so are calls, to
    10,000. After 40 calls in a row without motion or anything new the walk is over.
    """

    def move_forward(self, distance: float) -> MoveResult:
        """Drive ahead for up to `distance` metres, keeping to the corridor's middle.

        The robot follows the straight corridor it faces; in an open area it goes
        straight on. It goes round obstacles where there is room. It does not stop at
        turning points. It follows bends of up to 15 degrees; sharper ones are turning
        points, in which it halts with `wall` until `turn` is called. `obstacle` is a
        thing that blocks the way, or a person it has waited for, about 15 seconds: for
        a person try again, which waits again; for a thing that never helps. Use small
        distances (0.5) in a loop to look for something while walking; use one long
        distance only when the description gives one.

        Args:
            distance: Metres, greater than 0.

        Returns:
            `distance` really moved in metres, and `reason`: `done`, `wall`,
            `obstacle` or `budget`.

        Example:
            >>> result = move_forward(0.5)
            >>> if result.reason == "wall":
            ...     say("The corridor ends here.")
        """
        ...

    def detect_turning_point(self) -> list[Direction]:
        """Return the directions one can go from the turning point the robot is in.

        Inside a turning point (a corner, junction, crossing, or where a hall begins)
        these are relative to the way the robot faces: `forward` up to 15 degrees off
        it, `slight_left` and `slight_right` up to 60, `left` and `right` up to 120,
        `sharp_left` and `sharp_right` up to 160. Elsewhere, and at dead ends, the list
        is empty. Ways are corridors and open floor, also where automatic doors stand
        open to it; doors of rooms, lifts and stairs are none.

        A corner where the way only bends right gives `["right"]`, a fork
        `["slight_left", "slight_right"]` without `forward`, a place that only leads
        straight on `["forward"]`. A way on the left and one on the right that do not
        face each other are two turning points.

        The way by which the robot came into the turning point is never in the list,
        even when it has turned there and faces it; `turn` then takes it. A turning
        point is several metres long, so consecutive steps see the same one: use
        `turning_point_id()` to tell one from the next.

        Example:
            >>> while "left" not in detect_turning_point():
            ...     if move_forward(0.5).reason == "wall":
            ...         break
            >>> turn("left")
        """
        ...

    def turning_point_id(self) -> int | None:
        """Return the number of the turning point the robot is in, or None outside.

        The first turning point it meets is 1, the next new one 2; one it comes back
        to keeps its number. Use it to count junctions, for example for "the third
        corridor on the left".

        Example:
            >>> here = turning_point_id()
            >>> while turning_point_id() == here:
            ...     if move_forward(0.5).reason != "done":
            ...         break
        """
        ...

    def turn(self, direction: str) -> TurnResult:
        """Turn on the spot to face the way that lies in a direction.

        Works inside a turning point, where the robot moves to the middle of it if
        need be and then faces along the way chosen. Where no way carries the very
        word, `left` finds one from 30 to 150 degrees, `slight_left` from 10 to 75,
        `sharp_left` from 105 to 165 (the same to the right), and `forward` the one
        that bends least, up to 60: between just a left and a right way it is refused.
        `around` turns back and works anywhere. Where no way lies in the direction, the
        robot does not move and `turned` is False. To face what is no way, use
        `turn_by`.

        Args:
            direction: `left`, `right`, `forward`, `slight_left`, `slight_right`,
                `sharp_left`, `sharp_right` or `around`.

        Example:
            >>> if not turn("left").turned:
            ...     say("There is no way to the left.")
        """
        ...

    def turn_by(self, degrees: float) -> TurnResult:
        """Turn on the spot by an angle, anywhere: to face a door, a thing or a sign.

        Directions then count from there, and `move_forward` drives that way, up to
        what is faced; but along a corridor if one runs within 30 degrees of it.

        Args:
            degrees: Left positive, from -360 to 360.

        Example:
            >>> for door in detect_from_RGB_image("yellow door"):
            ...     turn_by(door.bearing_deg)
            ...     break
        """
        ...

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        """Look for an object in the camera's picture; the nearest one first.

        Any English words can be asked for: "door", "red chair", "vending machine",
        "sign that says Library". Only things within 4 m and in view (45 degrees to
        either side of straight ahead, not hidden by walls or other things) are
        found. Rooms are found by their doors ("library", "room 12"), floors by what
        covers them ("carpet", "tiled floor"); walls, corridors and halls are not.
        Numbers match whole: "sign that says 12" finds neither 112 nor 13. A sign may
        bear the words and only point the way: read it.
        The same thing seen again keeps its `track_id`, so counting different
        `track_id`s counts things.

        Args:
            object: What to look for, in a few words.

        Example:
            >>> seen = set()
            >>> while len(seen) < 4:
            ...     for door in detect_from_RGB_image("door"):
            ...         seen.add(door.track_id)
            ...     if move_forward(0.5).reason == "wall":
            ...         break
        """
        ...

    def read_signs(self) -> list[SignText]:
        """Read what is written in the camera's picture; the nearest text first.

        Signs, room numbers, labels on doors, posters and screens are read where they
        are within 6 m, in view, turned towards the robot, and their letters are large
        enough. One flat on a side wall is read while walking past, for a few steps of
        0.5 m before the robot is beside it: read at each of them, or face it with
        `turn_by`. The text comes as it is written, so compare it in lower case and look
        for single words. One with an arrow, a distance, "left", "right" or "straight"
        points the way; one without is mostly at the place.

        Example:
            >>> for sign in read_signs():
            ...     if "library" in sign.text.lower():
            ...         say("The sign here says " + sign.text)
        """
        ...

    def say(self, text: str) -> None:
        """Say something to the person beside the robot.

        Example:
            >>> say("We turn left here.")
        """
        ...

    def distance_travelled(self) -> float:
        """Return the metres driven since the start, by the odometer.

        Example:
            >>> start = distance_travelled()
            >>> while distance_travelled() - start < 20:
            ...     if move_forward(0.5).reason != "done":
            ...         break
        """
        ...

    def stop(self) -> None:
        """End the walk here, as at the destination. Nothing can follow it.

        It counts as arrived less than 3 m from the destination, as one walks. A program
        that reaches its last line stops too.

        Example:
            >>> stop()
        """
        ...
