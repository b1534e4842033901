"""How to come close to a thing seen, and into the place that it is or leads to."""

import math
import re

from memorymaze.agents.walking.floor_map import Sighting, along_and_aside, is_sign
from memorymaze.agents.walking.walker import Walker
from memorymaze.language.reading import place_on_sign

IN_FRONT = 1.3
"""Metres from the nearest part of the destination at which to stop."""
CLOSE = 0.7
"""Metres from its middle to come to from the middle of the way."""
BEYOND_SIGN, UNDER_SIGN = 6.0, 2.5
"""Metres to go on at most under a hanging sign that names a place; and under one that was
told as the destination itself, which may be the place or what leads to it."""
BESIDE_WORDS = 4.0
"""Metres from words on a wall or above a way within which the place is that they name."""
DOOR, DOOR_BESIDE = "door", 2.5
"""What a sign on a wall may be the sign of, and how many metres from it at most."""
ABOVE = 1.0
"""Metres beside the way within which words hang above it."""
INSIDE = 2.0
"""Metres to walk on into a place through its door."""

OPENS = re.compile(r"automatic|sliding|revolving|gate|entrance")


def walk_up_to(walker: Walker, sighting: Sighting, names: tuple[str, ...] = ()) -> None:
    """Walk up to a thing just seen, and into the place that it names or leads to."""
    leads_elsewhere = False
    for _ in range(10 + int(2 * sighting.distance)):
        seen = walker.look((sighting.phrase,))
        again = [each for each in seen if sighting.is_again(each)]
        if sighting.is_written:
            again = [*_borne_by(sighting, seen), *again]
        sighting = again[0] if again else sighting
        opens = OPENS.search(sighting.label) is not None
        if opens and sighting.side != "ahead" and not leads_elsewhere:
            turned = walker.turn_in(sighting)
            if turned:
                walker.walk_on(2 * INSIDE)
                return
            leads_elsewhere = turned is False
        if again and sighting.distance <= IN_FRONT and not opens:
            if is_sign(sighting.label) and "hanging" not in sighting.label:
                _go_to_its_place(walker, sighting, names)
            return
        rest = walker.metres_until_abreast(sighting) - (0.0 if opens else 0.3)
        if rest <= 0.2:
            break
        if not walker.step(min(rest, 0.8)):
            break
    if OPENS.search(sighting.label):
        walker.walk_on(walker.metres_until_abreast(sighting) + INSIDE)
    elif "hanging" in sighting.label or _is_written_above(sighting, walker):
        _enter(walker, sighting, names)
    else:
        stand_before(walker, sighting)
        if is_sign(sighting.label):
            _go_to_its_place(walker, sighting, names)


def _borne_by(written: Sighting, seen: list[Sighting]) -> list[Sighting]:
    """Return what is not a sign, and stands where words were read, the nearest first."""
    things = [
        each
        for each in seen
        if not is_sign(each.label)
        and math.dist(each.place, written.place) <= BESIDE_WORDS
    ]
    return sorted(things, key=lambda each: each.distance)


def _is_written_above(sighting: Sighting, walker: Walker) -> bool:
    _, aside = along_and_aside(sighting.place, walker.place, walker.heading)
    return sighting.is_written and aside <= ABOVE


def _go_to_its_place(walker: Walker, sign: Sighting, names: tuple[str, ...]) -> None:
    """Go on from a sign on a wall to the place beside it that bears its name, or its door."""
    wanted = (place_on_sign(sign.phrase) or sign.phrase, *names, DOOR)
    seen = walker.glance(dict.fromkeys(wanted), None)
    beside = _borne_by(sign, [each for each in seen if each.phrase != DOOR])
    doors = [
        each
        for each in seen
        if each.phrase == DOOR and math.dist(each.place, sign.place) <= DOOR_BESIDE
    ]
    if beside:
        stand_before(walker, beside[0])
    elif doors:
        stand_before(
            walker, min(doors, key=lambda each: math.dist(each.place, sign.place))
        )


def _enter(walker: Walker, sighting: Sighting, names: tuple[str, ...]) -> None:
    """Go on under a hanging sign to the place that it names."""
    place = place_on_sign(sighting.phrase)
    wanted = [*([place] if place else []), *names]
    begun = walker.travelled
    on = BEYOND_SIGN if place is None else UNDER_SIGN
    while walker.travelled - begun < on:
        for seen in walker.look(wanted):
            if seen.track != sighting.track and not is_sign(seen.label):
                walk_up_to(walker, seen)
                return
        if not walker.step(0.8):
            return


def stand_before(walker: Walker, sighting: Sighting) -> None:
    """Leave the middle of the way for a thing that stands beside it, seen now or before."""
    dx = sighting.place[0] - walker.place[0]
    dy = sighting.place[1] - walker.place[1]
    distance = math.hypot(dx, dy)
    if distance <= CLOSE + 0.4 or distance > 5.0:
        return
    walker.turn_to(math.atan2(dy, dx))
    walker.step(distance - CLOSE)
