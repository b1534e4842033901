"""Driving the robot from crossing to crossing, with eyes open."""

import math
from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from functools import partial

from memorymaze.agents.walking.floor_map import (
    STRIDE,
    Crossing,
    FloorMap,
    Point,
    Sighting,
    Stretch,
    along_and_aside,
    is_on_a_pointer,
)
from memorymaze.basics.geometry.pose import moved, wrap_angle
from memorymaze.robot.api.control import Detection, Direction, Robot, SignText
from memorymaze.robot.perception.detector import LONGEST_QUERY
from memorymaze.robot.perception.matching import points_elsewhere
from memorymaze.robot.perception.noun_phrase import words_of

LONG_STRIDE = 1.2
"""Metres between two looks for turning points alone; they are 1.5 m long or more."""
READING_STRIDE = 1.5
"""Metres between two readings of signs."""
IN_PLACE = math.radians(12)
"""A way that differs less from the heading needs no turn."""
AHEAD = math.radians(12)
"""A thing that differs less from it lies ahead."""
BACK = math.radians(155)
"""A way that differs more from the heading is the way back."""
MEANT, NEAR_ENOUGH = math.radians(35), math.radians(63)
"""A way told of that differs no more from the one wanted is that one; or may stand for it."""
SHARP = math.radians(126)
"""Where a way that differs more is not found, the robot turns around."""

LEADS_TO = math.radians(45)
"""How far beside a way, as one faces along it, what it leads to stands at most: a camera sees
it then."""

GLANCES = {"left": math.radians(75), "right": math.radians(-75)}
"""How far it turns to look beside a way, radians."""

IDLE, SHORTEST = frozenset({"the", "of", "for", "and", "shop", "room"}), 4
"""Words of a name that many leave out, and letters to which it is shortened at most."""
AS_WRITTEN = 0.65
"""Score of a thing of which the words alone were read."""

_ANGLES: dict[Direction, float] = {
    "forward": 0.0,
    "slight_left": math.radians(40),
    "slight_right": math.radians(-40),
    "left": math.radians(90),
    "right": math.radians(-90),
    "sharp_left": math.radians(140),
    "sharp_right": math.radians(-140),
    "around": math.pi,
}
"""The middle of each direction, radians, left positive."""


class Walker:
    """Keeps track of where the robot is and draws the map while it walks."""

    def __init__(self, robot: Robot, *, reads_signs: bool = False) -> None:
        """Begin where the robot stands; at each look it may also read what is written."""
        self.map = FloorMap()
        self._robot = robot
        self._reads_signs = reads_signs
        self._read_at = -math.inf
        self.place: Point = (0.0, 0.0)
        self.heading = 0.0
        self.at = 0
        """Number of the crossing the robot is at."""
        self.travelled = 0.0
        self._stretch = (0, 0)
        self._entered: float | None = None
        """Metres travelled at the rim of the crossing it is in; None where it set off."""
        number = robot.turning_point_id()
        if number is not None:
            self._arrive_in(number)
            self._entered = None

    # -- walking

    def follow_exit(
        self,
        exit: int,
        phrases: Iterable[str],
        until: Callable[[list[Sighting]], bool] | None = None,
    ) -> Stretch | None:
        """Leave the crossing by an exit and walk to the next, looking for things.

        `until` is told what is seen at each look; where it says True the robot stays.
        None is returned then, and where the exit is closed.
        """
        start = self.map.crossings[self.at]
        if not self.face(exit):
            start.closed.add(exit)
            return None
        exit_heading = self.heading
        self._stretch = (start.number, exit)
        begin = self.travelled
        wanted = list(dict.fromkeys(phrases))
        outside = self._robot.turning_point_id() != start.number
        while True:
            seen = self.look(wanted)
            if not outside and self.travelled == begin:
                self.map.note_view(start.number, exit, wanted, seen)
            if until is not None and until(seen):
                return None
            result = self._robot.move_forward(STRIDE if wanted else LONG_STRIDE)
            self._advance(result.distance)
            number = self._robot.turning_point_id()
            if not outside and number != start.number:
                self._note_rim(start)
            if number is None:
                outside = True
            elif number != start.number or (outside and start.number > 0):
                self._arrive_in(number)
                self.look(wanted)
                break
            if result.reason != "done":
                if number == start.number and not outside:
                    start.closed.add(exit)
                    return None
                dead_end = self.map.new_dead_end(self.place)
                self.at = dead_end.number
                break
        start.exits[exit] = exit_heading
        stretch = Stretch(
            start.number,
            exit,
            self.at,
            self.heading,
            max(self.travelled - begin, 0.1),
            frozenset(wanted),
        )
        self.map.add_stretch(stretch)
        return stretch

    def go_to(self, goal: int) -> bool:
        """Walk back along known stretches; False when there is no way."""
        tries = 0
        while self.at != goal:
            way = self.map.path(self.at, goal)
            if not way:
                return False
            if not self._repeat(way[0]) or self.at != way[0].end:
                self._recover()
                tries += 1
                if tries > 2:
                    return False
        return True

    def _recover(self) -> None:
        """After losing the way in an open area, look for any turning point."""
        for _ in range(2):
            if self._robot.turning_point_id() is not None:
                return
            self._turn("around")
            for _ in range(25):
                result = self._robot.move_forward(LONG_STRIDE)
                self._advance(result.distance)
                number = self._robot.turning_point_id()
                if number is not None:
                    self._arrive_in(number)
                    return
                if result.reason != "done":
                    break

    def _repeat(self, stretch: Stretch) -> bool:
        """Walk a known stretch with long strides."""
        start = self.map.crossings[self.at]
        if not self.face(stretch.exit):
            start.closed.add(stretch.exit)
            self.map.stretches.pop((stretch.start, stretch.exit), None)
            return False
        walked = 0.0
        left = False
        while True:
            rest = stretch.length - 1.5 - walked
            result = self._robot.move_forward(max(rest, 0.8))
            walked += result.distance
            self._advance(result.distance)
            number = self._robot.turning_point_id()
            left = left or number != start.number
            if number is not None and left:
                self._arrive_in(number)
                break
            reached = walked >= stretch.length - 0.3
            if stretch.end <= 0 and (reached or result.reason != "done"):
                self.at = stretch.end
                self.place = self.map.crossings[stretch.end].place
                break
            if result.reason != "done" or walked > stretch.length + 8.0:
                dead_end = self.map.new_dead_end(self.place)
                self.at = dead_end.number
                self.map.stretches.pop((stretch.start, stretch.exit), None)
                dead_end.add_exit(wrap_angle(self.heading + math.pi))
                self.map.add_stretch(
                    Stretch(
                        start.number,
                        stretch.exit,
                        dead_end.number,
                        self.heading,
                        max(walked, 0.1),
                        frozenset(),
                    )
                )
                break
        return True

    @property
    def is_in_turning_point(self) -> bool:
        """Whether the robot is where ways part, also before it is known as a place."""
        return self._robot.turning_point_id() is not None

    def halt(self) -> None:
        """Take where the robot stands on a way for a place of its own, to go on from."""
        number, exit = self._stretch
        length = math.dist(self.map.crossings[number].place, self.place)
        spot = self.map.new_dead_end(self.place)
        spot.add_exit(self.heading)
        self.at = spot.number
        self.map.add_stretch(
            Stretch(
                number, exit, spot.number, self.heading, max(length, 0.1), frozenset()
            )
        )

    def step(self, distance: float) -> bool:
        """Walk a little on; False when something is in the way."""
        result = self._robot.move_forward(distance)
        self._advance(result.distance)
        return result.reason == "done"

    def walk_on(self, distance: float) -> None:
        """Walk on by small steps until something is in the way."""
        while distance > 0.2 and self.step(min(distance, 1.0)):
            distance -= 1.0

    def metres_until_abreast(self, sighting: Sighting) -> float:
        """Return the metres to walk ahead until something is abreast."""
        return along_and_aside(sighting.place, self.place, self.heading)[0]

    def _advance(self, distance: float) -> None:
        self.place = moved(self.place, self.heading, distance)
        self.travelled += distance

    def _note_rim(self, crossing: Crossing) -> None:
        """Take note how far it was through a crossing that the robot left just now."""
        if crossing.number > 0 and self._entered is not None:
            crossing.rim = (self.travelled - self._entered) / 2

    def _arrive_in(self, number: int) -> None:
        """Take note of a turning point and of the ways out of it."""
        known = self.map.crossings.get(number)
        if known is None:
            inside = self.map.usual_rim - STRIDE / 2
            known = Crossing(number, moved(self.place, self.heading, inside))
            self.map.crossings[number] = known
        else:
            self.place = known.place
        self.at = number
        self._entered = self.travelled
        self._note_exits(known)

    def _note_exits(self, crossing: Crossing) -> None:
        """Take note of the ways out that are found from where the robot faces."""
        for direction in self._robot.detect_turning_point():
            crossing.add_exit(wrap_angle(self.heading + _ANGLES[direction]))

    # -- turning

    def face(self, exit: int) -> bool:
        """Face an exit of the crossing; False when the robot finds no way there."""
        crossing = self.map.crossings[self.at]
        angle = wrap_angle(crossing.exits[exit] - self.heading)
        if abs(angle) <= IN_PLACE:
            return True
        if abs(angle) >= BACK or crossing.number <= 0:
            return self._turn("around")
        offered = self._robot.detect_turning_point()
        word = min(offered, key=lambda each: _off(each, angle), default=None)
        off = math.inf if word is None else _off(word, angle)
        # The way it came is not told of, but it can be turned to.
        back = min(_ANGLES, key=lambda each: _off(each, angle))
        if off > MEANT and self._turn(back):
            crossing.exits[exit] = self.heading
            return True
        if word is None or off > NEAR_ENOUGH:
            return abs(angle) > SHARP and self._turn("around")
        if word == "forward":
            return True
        turned = self._turn(word)
        if turned:
            crossing.exits[exit] = self.heading
        return turned

    def _turn(self, direction: Direction) -> bool:
        before = self._robot.distance_travelled()
        result = self._robot.turn(direction)
        moved = self._robot.distance_travelled() - before
        if result.turned and direction != "around" and self.at > 0:
            self._advance(min(moved, 6.0))
            self.map.crossings[self.at].place = self.place
        self.heading = wrap_angle(self.heading + math.radians(result.angle_deg))
        return result.turned

    def turn_by(self, degrees: float) -> None:
        """Face what is no way: a door, a thing, a wall; left positive."""
        result = self._robot.turn_by(degrees)
        self.heading = wrap_angle(self.heading + math.radians(result.angle_deg))

    def turn_to(self, heading: float) -> None:
        """Face a heading, whether or not there is a way."""
        self.turn_by(math.degrees(wrap_angle(heading - self.heading)))

    def turn_in(self, sighting: Sighting) -> bool | None:
        """Turn into the way at the end of which something stands, on its side.

        None where the robot has come to no way on that side. False where it leads to
        somewhere else: it faces on then.
        """
        if self._robot.turning_point_id() == self.at:
            return None
        for direction in self._robot.detect_turning_point():
            if direction.endswith(sighting.side):
                ahead = self.heading
                if not self._turn(direction):
                    return False
                along, aside = along_and_aside(sighting.place, self.place, self.heading)
                if aside <= max(along, 0.0) * math.tan(LEADS_TO):
                    return True
                self.turn_to(ahead)
                return False
        return None

    def say(self, words: str) -> None:
        """Say something to the person beside the robot."""
        self._robot.say(words)

    # -- looking

    def look_about(self, phrases: Iterable[str]) -> None:
        """Find all ways out of where the robot stands, and look along each.

        It may face any way afterwards.
        """
        crossing = self.map.crossings[self.at]
        if crossing.number > 0:
            for _ in range(2):
                self._note_exits(crossing)
                self._turn("around")
                # The way it came is not told of, but a way ahead can be turned to.
                if self._turn("forward"):
                    crossing.add_exit(self.heading)
        else:
            crossing.add_exit(math.pi)
        self.survey(phrases)

    def survey(self, phrases: Iterable[str]) -> None:
        """Look along every way out of the crossing the robot is at that it did not walk."""
        wanted = tuple(dict.fromkeys(phrases))
        crossing = self.map.crossings[self.at]
        order = sorted(
            range(len(crossing.exits)),
            key=lambda exit: abs(wrap_angle(crossing.exits[exit] - self.heading)),
        )
        for exit in order:
            view = self.map.views.get((crossing.number, exit))
            if (
                exit in crossing.closed
                or (crossing.number, exit) in self.map.stretches
                or (view is not None and view.asked.issuperset(wanted))
            ):
                continue
            if self.face(exit):
                self._stretch = (self.at, exit)
                self.map.note_view(self.at, exit, wanted, self.look(wanted))

    def glance(self, phrases: Iterable[str], side: str | None) -> list[Sighting]:
        """Look to a side, or to both, and face on; return what points nowhere else.

        A camera that looks ahead sees little of what stands beside a wide way.
        """
        wanted, ahead = list(phrases), self.heading
        seen: list[Sighting] = []
        for angle in [GLANCES[side]] if side in GLANCES else GLANCES.values():
            self.turn_to(ahead + angle)
            seen += [each for each in self.look(wanted) if not self.points_on(each)]
        self.turn_to(ahead)
        return seen

    def points_on(self, seen: Sighting) -> bool:
        """Tell whether what was just seen is a sign that points to somewhere else."""
        read = self._read()
        return is_on_a_pointer(seen, (*self.map.texts, *read))

    def look(self, phrases: Collection[str]) -> list[Sighting]:
        """Look for things; what is seen, or read from farther away, goes on the map."""
        seen: list[Sighting] = []
        for phrase in phrases:
            # No camera can be asked for it: it is a sentence that was taken for a thing.
            if len(phrase) > LONGEST_QUERY:
                continue
            for found in self._robot.detect_from_RGB_image(phrase):
                sighting = self._placed(phrase, found.label, found.score, found)
                self.map.note(sighting)
                seen.append(sighting)
        if self._reads_signs and self._is_time_to_read():
            for text in self._read():
                for phrase in filter(partial(_is_written, text.phrase), phrases):
                    written = replace(
                        text,
                        phrase=phrase,
                        label="sign",
                        score=AS_WRITTEN,
                        track=-text.track,
                    )
                    if self.map.note_written(written):
                        seen.append(written)
        return seen

    def _read(self) -> list[Sighting]:
        """Return what is written in view; it goes on the map of who reads signs."""
        texts = [
            self._placed(each.text, each.text, 1.0, each)
            for each in self._robot.read_signs()
        ]
        if self._reads_signs:
            for text in texts:
                self.map.note_text(text)
        return texts

    def _is_time_to_read(self) -> bool:
        """Tell whether it came far enough since it last read, or turned: signs are large."""
        here = self.travelled + 10 * self.heading
        if abs(here - self._read_at) < READING_STRIDE:
            return False
        self._read_at = here
        return True

    def _placed(
        self, phrase: str, label: str, score: float, found: Detection | SignText
    ) -> Sighting:
        """Return what was found with where it is on the map."""
        bearing = math.radians(found.bearing_deg)
        angle = self.heading + bearing
        side = "left" if bearing > 0 else "right"
        if abs(bearing) < AHEAD:
            side = "ahead"
        return Sighting(
            phrase,
            label,
            score,
            moved(self.place, angle, found.distance),
            self.place,
            found.distance,
            found.track_id,
            self._stretch,
            side,
            bearing,
        )


def _is_written(text: str, phrase: str) -> bool:
    """Tell whether a text says what is looked for, in full or shortened, and nothing else.

    >>> _is_written("Toy Plane", "door that says Toy Plane"), _is_written("2103", "room 2103")
    (True, True)
    >>> _is_written("Physiotherapy", "physio"), _is_written("Bakery", "baker")
    (True, True)
    """
    if points_elsewhere(text):
        return False
    asked = words_of(phrase.rpartition(" that says ")[2])
    numbers = [word for word in asked if any(map(str.isdigit, word))]
    if numbers:
        return {*numbers} == {*words_of(text)}
    wanted, said = ({*words} - IDLE or {*words} for words in (asked, words_of(text)))
    pairs = [(one, two) for one in wanted for two in said if _is_short_for(one, two)]
    found = {one for one, _ in pairs}, {two for _, two in pairs}
    return bool(wanted) and len(wanted) == len(said) and found == (wanted, said)


def _is_short_for(one: str, two: str) -> bool:
    """Tell whether two words are the same, or one is the beginning of the other."""
    short, long = sorted((one, two), key=len)
    return one == two or (len(short) >= SHORTEST and long.startswith(short))


def _off(direction: Direction, angle: float) -> float:
    """Return by how much the middle of a direction differs from an angle."""
    return abs(wrap_angle(_ANGLES[direction] - angle))
