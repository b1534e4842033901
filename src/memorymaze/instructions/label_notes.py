"""Labels of instructions that sit ill with the building."""

import re
from collections.abc import Iterable, Iterator, Mapping

from memorymaze.errors import did_you_mean
from memorymaze.instructions.error_kinds import ERROR_KINDS
from memorymaze.instructions.files import InstructionProblem, place_of
from memorymaze.instructions.records import Failure, Instruction
from memorymaze.sites.records import Route, Site

_ENDS = frozenset(("start", "beginning", "end", "goal", "destination", "route", "way"))
"""Places that every route has."""
_ID = re.compile(r"[a-z]+\d*(?:_[a-z0-9]+)+")
_WORD = re.compile(r"\w+")


class PlaceNames:
    """All by which a place of a building can be named."""

    def __init__(self, site: Site) -> None:
        """Read them from the plan."""
        self.site = site
        places = (*site.corridors, *site.areas, *site.turning_points, *site.rooms)
        self.ids = frozenset(
            part.id for part in (*places, *site.doors, *site.landmarks)
        )
        said = [place.name for place in places]
        said += [place.shape for place in site.turning_points]
        said += [door.label for door in site.doors]
        for thing in site.landmarks:
            said += [thing.name, thing.category, thing.text]
        names = {_words(words.replace("_", " ")) for words in said if words}
        self.names = frozenset(name for name in names if name)

    def has(self, where: str) -> bool:
        """Tell whether some words name a place of the building, or an end of a route.

        An id counts, and a name, category, label, inscription or shape of the plan when
        all of its words are there, with or without the s of a plural.
        """
        if self.ids.intersection(_WORD.findall(where)):
            return True
        said = _words(where)
        return bool(said & _ENDS) or any(name <= said for name in self.names)


def _words(text: str) -> frozenset[str]:
    words = _WORD.findall(text.casefold())
    return frozenset(word.removesuffix("s") or word for word in words)


def label_notes(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> list[InstructionProblem]:
    """List labels that contradict the site or what the study was like."""
    notes: list[InstructionProblem] = []
    names = {name: PlaceNames(site) for name, site in sites.items()}
    for each in instructions:
        routes = sites[each.site].routes if each.site in sites else ()
        for route in routes:
            if route.id == each.reference_route:
                notes += [
                    InstructionProblem(place_of(each), message)
                    for message in _notes(each, names[each.site], route)
                ]
    return notes


def _notes(each: Instruction, names: PlaceNames, route: Route) -> Iterator[str]:
    if each.study == "online" and route.role == "alternative":
        yield (
            f"field 'reference_route': {route.id!r} is an alternative way, but online "
            "everyone saw a walk along the reference route"
        )
    known = [kind.name for kind in ERROR_KINDS]
    for number, failure in enumerate(each.failures):
        field = f"field 'failures.{number}"
        if failure.kind not in known:
            hint = did_you_mean(failure.kind, known) or f": {', '.join(known)}"
            yield f"{field}.kind': {failure.kind!r} is none of the paper's kinds{hint}"
        if failure in each.failures[:number]:
            yield f"{field}': the same failure stands there twice"
        where = _where_note(failure, names, route)
        if where is not None:
            yield f"{field}.where': {where}"


def _where_note(failure: Failure, names: PlaceNames, route: Route) -> str | None:
    site = names.site
    where = failure.where.strip()
    if not where:
        return "empty; name a turning point's id or a place of the plan"
    if _ID.fullmatch(where):
        points = {point.id: point for point in site.turning_points}
        if where in points:
            if points[where].polygon.distance(route.line) > 0:
                return f"turning point {where!r} is not on {route.id}"
            return None
        if where in names.ids:
            return None
        return (
            f"{where!r} is not in the plan of {site.name}{did_you_mean(where, points)}"
        )
    if not names.has(where):
        return f"{where!r} names no turning point, place or thing of {site.name}"
    return None
