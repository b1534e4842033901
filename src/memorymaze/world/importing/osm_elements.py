"""OpenStreetMap data: nodes, ways and relations with their tags, from XML or JSON.

XML is read without document types, so no entities can grow; JSON is what Overpass gives.
"""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import cast
from xml.parsers import expat

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.input_files import read_text
from memorymaze.world.importing.imported import ImportNotes, listed_in

LEVEL = re.compile(r"\s*(-?\d+(?:\.\d+)?)(?:\s*-\s*(-?\d+(?:\.\d+)?))?\s*")
MOST_LEVELS = 200
"""Levels of one element."""


@dataclass
class Element:
    """A node, a way or a relation."""

    id: str
    """Such as `way/12`."""
    tags: dict[str, str] = field(default_factory=dict[str, str])
    place: tuple[float, float] | None = None
    """Longitude and latitude of a node."""
    members: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    """Ids of a way's nodes or a relation's members, with their roles."""

    @property
    def is_closed(self) -> bool:
        """Whether it is a way that ends where it starts."""
        return len(self.members) > 3 and self.members[0] == self.members[-1]

    def levels(self) -> set[float]:
        """Return the levels that it is on, also those it repeats on."""
        found: set[float] = set()
        for tag in ("level", "repeat_on"):
            for part in self.tags.get(tag, "").split(";"):
                match = LEVEL.fullmatch(part)
                if not match:
                    continue
                low, high = float(match[1]), float(match[2] or match[1])
                steps = min(math.ceil(high - low), MOST_LEVELS)
                found |= {low, high, *(low + step for step in range(1, steps))}
        return found


def read_elements(path: Path, notes: ImportNotes) -> dict[str, Element]:
    """Return the elements of an .osm file or an Overpass answer by id."""
    text = read_text(path, ImportFileError)
    if text.lstrip().startswith(("{", "[")):
        found = _from_json(text, path, notes)
    else:
        found = _from_xml(text, path, notes)
    if not found:
        raise ImportFileError(f"{path}: expected OpenStreetMap elements, got none")
    return found


def _placed(longitude: object, latitude: object) -> tuple[float, float] | None:
    try:
        place = (float(cast(str, longitude)), float(cast(str, latitude)))
    except (TypeError, ValueError, OverflowError):
        return None
    sound = abs(place[0]) <= 180 and abs(place[1]) <= 90
    return place if sound else None


class _Reader:
    """What an XML parser calls."""

    def __init__(
        self, path: Path, parser: expat.XMLParserType, notes: ImportNotes
    ) -> None:
        self._path, self._parser, self._notes = path, parser, notes
        self._current: Element | None = None
        self._is_first = True
        self.found: dict[str, Element] = {}

    def begin(self, name: str, said: Mapping[str, str]) -> None:
        if self._is_first and name != "osm":
            line = self._parser.CurrentLineNumber
            raise ImportFileError(f"{self._path}:{line}: expected <osm>, got <{name}>")
        self._is_first = False
        if name in KINDS:
            self._current = Element(f"{name}/{said.get('id')}")
            if name == "node":
                self._current.place = _placed(said.get("lon"), said.get("lat"))
        elif self._current is None:
            return
        elif name == "tag" and "k" in said and "v" in said:
            self._current.tags[said["k"]] = said["v"]
        elif name == "nd":
            self._current.members.append((f"node/{said.get('ref')}", ""))
        elif name == "member":
            member = f"{said.get('type')}/{said.get('ref')}"
            self._current.members.append((member, said.get("role", "")))

    def end(self, name: str) -> None:
        if name in KINDS and self._current is not None:
            _keep(self._current, self.found, self._notes)
            self._current = None

    def refuse(self, *_: object) -> None:
        raise ImportFileError(
            f"{self._path}:{self._parser.CurrentLineNumber}: expected OpenStreetMap XML "
            "without a document type, got <!DOCTYPE …>"
        )


KINDS = ("node", "way", "relation")
MEMBERS = {"node": (), "way": ("node/",), "relation": ("node/", "way/")}
"""What an element of a kind is made of."""


def _from_xml(text: str, path: Path, notes: ImportNotes) -> dict[str, Element]:
    parser = expat.ParserCreate()
    reader = _Reader(path, parser, notes)
    parser.StartElementHandler = reader.begin
    parser.EndElementHandler = reader.end
    parser.StartDoctypeDeclHandler = reader.refuse
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        raise ImportFileError(
            f"{path}:{error.lineno}: expected XML, got: {error}"
        ) from None
    return reader.found


def _from_json(text: str, path: Path, notes: ImportNotes) -> dict[str, Element]:
    elements = listed_in(text, "elements", "an Overpass answer", str(path))
    found: dict[str, Element] = {}
    for index, raw in enumerate(elements):
        said = cast(dict[str, object], raw) if isinstance(raw, dict) else {}
        kind = said.get("type")
        if kind not in KINDS:
            notes.miss(
                "elements that are no nodes, ways or relations", f"elements[{index}]"
            )
            continue
        element = Element(f"{kind}/{said.get('id')}")
        tags = said.get("tags")
        if isinstance(tags, dict):
            element.tags = {
                name: value
                for name, value in cast(dict[str, object], tags).items()
                if isinstance(value, str)
            }
        if kind == "node":
            element.place = _placed(said.get("lon"), said.get("lat"))
        element.members = list(_members(said))
        _keep(element, found, notes)
    return found


def _members(said: Mapping[str, object]) -> Sequence[tuple[str, str]]:
    nodes, members = said.get("nodes"), said.get("members")
    if isinstance(nodes, list):
        return [(f"node/{each}", "") for each in cast(list[object], nodes)]
    if not isinstance(members, list):
        return []
    known = [
        cast(dict[str, object], each)
        for each in cast(list[object], members)
        if isinstance(each, dict)
    ]
    return [
        (f"{each.get('type')}/{each.get('ref')}", str(each.get("role", "")))
        for each in known
    ]


def _keep(element: Element, found: dict[str, Element], notes: ImportNotes) -> None:
    kind = element.id.split("/")[0]
    # What refers to its like could go round in circles.
    element.members = [
        (member, role)
        for member, role in element.members
        if member.startswith(MEMBERS[kind])
    ]
    if kind == "node" and element.place is None:
        notes.miss("nodes without a place", element.id)
    elif element.id in found:
        notes.miss("elements that are in the file twice", element.id)
    else:
        found[element.id] = element
