"""IMDF archives: Apple's Indoor Mapping Data Format, a community standard of the OGC.

A zip file with one GeoJSON file for each type of feature. Levels, units, openings,
amenities, fixtures, kiosks, occupants with their anchors are read; the rest is not.
"""

import io
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path

from shapely import LineString, MultiPolygon, Polygon

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.input_files import LARGEST_FILE, read_file
from memorymaze.world.importing.found import FoundDoor, FoundRoom, FoundThing
from memorymaze.world.importing.geojson_features import (
    SourceFeature,
    read_features,
    within_reach,
)
from memorymaze.world.importing.imported import (
    ImportedSite,
    ImportNotes,
    LocalFrame,
    chosen_floor,
    imported_building,
)
from memorymaze.world.importing.outlines import Outlines, plan_outlines
from memorymaze.world.importing.shapes import polygons
from memorymaze.world.importing.ways import OpenArea

FILES = (
    "level",
    "unit",
    "opening",
    "amenity",
    "fixture",
    "kiosk",
    "occupant",
    "anchor",
    "venue",
)
WITHOUT_PLACES = ("address", "building", "manifest.json")
"""Files of an archive that say nothing about a floor."""
CORRIDORS = ("walkway", "footbridge", "ramp", "movingwalkway")
"""Categories of units that are corridors; what follows a point is a special kind."""
AREAS = ("lobby", "platform", "terrace", "unenclosedarea")
OPEN_AIR = ("terrace",)
BLOCKS = ("brick", "column", "concrete", "drywall", "glass", "structure", "wood")
HOLLOW = ("opentobelow", "vegetation", "road", "parking", "fieldofplay")
"""Neither floor nor rooms."""
ROOM_USES = {
    "auditorium": "hall", "classroom": "classroom", "conferenceroom": "conference_room",
    "elevator": "stairwell", "foodservice": "shop", "huddleroom": "conference_room",
    "kitchen": "kitchen", "laboratory": "lab", "library": "library",
    "lounge": "hall", "mailroom": "storage", "movietheater": "hall", "office": "office",
    "restroom": "restroom", "serverroom": "storage", "stairs": "stairwell",
    "storage": "storage", "theater": "hall", "waitingroom": "hall",
}  # fmt: skip
THINGS = {
    "artinstallation": "sculpture", "atm": "cash machine", "baggagecarts": "trolley", "coinlocker": "coin lockers",
    "copymachine": "photocopier", "handsanitizerstation": "hand sanitizer",
    "defibrillator": "AED", "desk": "reception desk", "drinkingfountain": "drinking fountain",
    "exhibit": "display case", "fireextinguisher": "fire extinguisher",
    "information": "information desk", "reception": "reception desk", "kiosk": "information kiosk",
    "mailbox": "mailboxes", "seat": "bench", "seating": "bench",
    "ticketing": "ticket machine", "vegetation": "planter",
    "vendingmachine": "vending machine",
}  # fmt: skip
"""Categories of amenities and fixtures that are things."""
DOOR_KINDS = {"glass": "glass", "metal": "steel"}


def import_imdf(path: Path, floor: str | None = None) -> ImportedSite:
    """Return one floor of an IMDF archive as a building.

    Walkways become corridors, lobbies and the like areas, other units rooms named like
    their occupants, openings doors, amenities and fixtures things.
    """
    notes = ImportNotes()
    files = _files(path, notes)
    if not files["level"] or not files["unit"]:
        lacking = "level" if not files["level"] else "unit"
        raise ImportFileError(
            f"{path}: expected {lacking}s in {lacking}.geojson, got none"
        )
    places = [
        (x, y)
        for unit in files["unit"]
        if unit.geometry is not None
        for x, y in [unit.geometry.representative_point().coords[0]]
    ]
    if not places:
        raise ImportFileError(f"{path}: expected units with outlines, got none")
    frame = LocalFrame.around(places)
    files = {kind: within_reach(each, frame, notes) for kind, each in files.items()}
    ordinals: dict[str, float] = {}
    floors: dict[float, str] = {}
    for level in files["level"]:
        ordinal = level.number("ordinal")
        if ordinal is None:
            notes.miss("levels without an ordinal", level.id)
            continue
        ordinals[level.id] = ordinal
        floors[ordinal] = level.text("short_name", "name") or f"{ordinal:g}"
    if not floors:
        raise ImportFileError(f"{path}: expected levels with ordinals, got none")
    chosen = chosen_floor(dict(sorted(floors.items())), floor, str(path))
    here: dict[str, list[SourceFeature]] = {}
    for kind in ("unit", "opening", "fixture", "kiosk"):
        here[kind] = []
        for feature in files[kind]:
            level = feature.text("level_id")
            if level not in ordinals:
                notes.miss(f"{kind}s on a level that is not in the file", feature.id)
            elif ordinals[level] == chosen:
                here[kind].append(feature)
    here["amenity"] = _amenities(files, here["unit"], notes)
    drawn = Outlines()
    _draw_units(here["unit"], _occupants(files, notes), frame, drawn, notes)
    _draw_openings(here["opening"], here["unit"], frame, drawn, notes)
    _draw_things(here, frame, drawn, notes)
    try:
        parts = plan_outlines(drawn, notes)
    except ImportFileError as error:
        raise ImportFileError(f"{path}: level {floors[chosen]}: {error}") from None
    title = next(filter(None, (venue.text("name") for venue in files["venue"])), None)
    return notes.imported(
        imported_building(path, title, floors[chosen], frame.anchor, parts)
    )


def _files(path: Path, notes: ImportNotes) -> dict[str, list[SourceFeature]]:
    """Return the features of an archive by type; files it lacks have none."""
    found: dict[str, list[SourceFeature]] = {kind: [] for kind in FILES}
    try:
        with zipfile.ZipFile(io.BytesIO(read_file(path, ImportFileError))) as archive:
            for entry in archive.infolist():
                kind = Path(entry.filename).name.removesuffix(".geojson")
                if kind not in FILES or not entry.filename.endswith(".geojson"):
                    if not entry.is_dir() and kind not in WITHOUT_PLACES:
                        notes.miss("files that are not read", entry.filename)
                    continue
                with archive.open(entry) as file:
                    content = file.read(LARGEST_FILE + 1)
                if len(content) > LARGEST_FILE:
                    raise ImportFileError(
                        f"{path}: {entry.filename}: expected at most "
                        f"{LARGEST_FILE // 2**20} MiB, got a longer file"
                    )
                found[kind] += read_features(
                    content, f"{path}: {entry.filename}", notes
                )
    # Whatever is wrong with a zip file, its reader has an error of another kind for it.
    except (
        zipfile.BadZipFile,
        OSError,
        EOFError,
        RuntimeError,
        NotImplementedError,
        ValueError,
        zlib.error,
    ) as error:
        raise ImportFileError(
            f"{path}: expected an IMDF archive (zip), got: {error}"
        ) from None
    return found


def _occupants(
    files: Mapping[str, Sequence[SourceFeature]], notes: ImportNotes
) -> dict[str, str]:
    """Return the names of occupants by the units that they are in."""
    units = {anchor.id: anchor.text("unit_id") for anchor in files["anchor"]}
    found: dict[str, str] = {}
    for occupant in files["occupant"]:
        unit, name = units.get(occupant.text("anchor_id") or ""), occupant.text("name")
        if unit is None or name is None:
            notes.miss("occupants without a name or an anchor in a unit", occupant.id)
        elif unit in found:
            notes.miss("occupants of a unit that has another one", occupant.id)
        else:
            found[unit] = name
    return found


def _kind(feature: SourceFeature) -> str:
    """Return a feature's category without its special kind."""
    return (feature.text("category") or "unspecified").split(".")[0]


def _draw_units(
    units: Sequence[SourceFeature],
    occupants: Mapping[str, str],
    frame: LocalFrame,
    drawn: Outlines,
    notes: ImportNotes,
) -> None:
    for unit in units:
        parts = _outline(unit, frame)
        kind, name = _kind(unit), unit.text("name", "alt_name")
        if not parts:
            notes.miss("units without an outline", unit.id)
        elif kind in CORRIDORS:
            drawn.floor += [(part, name) for part in parts]
        elif kind in AREAS:
            drawn.areas += [OpenArea(part, name, kind in OPEN_AIR) for part in parts]
        elif kind in BLOCKS:
            drawn.blocks += parts
        elif kind in HOLLOW:
            notes.miss(f"units that are no rooms: {kind}", unit.id)
        else:
            called = name or occupants.get(unit.id) or kind.capitalize()
            use = ROOM_USES.get(kind)
            drawn.rooms += [FoundRoom(unit.id, part, called, use) for part in parts]


def _outline(feature: SourceFeature, frame: LocalFrame) -> list[Polygon]:
    if not isinstance(feature.geometry, Polygon | MultiPolygon):
        return []
    return polygons(frame.placed(feature.geometry))


def _draw_openings(
    openings: Sequence[SourceFeature],
    units: Sequence[SourceFeature],
    frame: LocalFrame,
    drawn: Outlines,
    notes: ImportNotes,
) -> None:
    upwards = [
        part
        for unit in units
        if _kind(unit) == "elevator"
        for part in _outline(unit, frame)
    ]
    for opening in openings:
        if not isinstance(opening.geometry, LineString):
            notes.miss("openings that are no lines", opening.id)
            continue
        line = frame.placed(opening.geometry)
        door = opening.properties.get("door")
        said = SourceFeature(opening.id, door if isinstance(door, dict) else {}, None)
        if any(part.distance(line) < 0.3 for part in upwards):
            kind = "elevator"
        elif said.properties.get("automatic") is True:
            kind = "automatic"
        elif _kind(opening) == "emergencyexit":
            kind = "fire"
        else:
            kind = DOOR_KINDS.get(said.text("material") or "", "wood")
        middle = line.interpolate(0.5, normalized=True)
        found = FoundDoor(
            opening.id,
            (middle.x, middle.y),
            kind,
            opening.text("name", "alt_name"),
            line.length,
            said.text("type") == "open",
        )
        drawn.doors.append((found, line))


def _amenities(
    files: Mapping[str, Sequence[SourceFeature]],
    units: Sequence[SourceFeature],
    notes: ImportNotes,
) -> list[SourceFeature]:
    """Return the amenities in units of the floor."""
    here = {unit.id for unit in units}
    everywhere = {unit.id for unit in files["unit"]}
    found: list[SourceFeature] = []
    for amenity in files["amenity"]:
        named = amenity.properties.get("unit_ids")
        inside = (
            {each for each in named if isinstance(each, str)}
            if isinstance(named, list)
            else set()
        )
        if inside & here:
            found.append(amenity)
        elif not inside & everywhere:
            notes.miss("amenities in no unit of the file", amenity.id)
    return found


def _draw_things(
    here: Mapping[str, Sequence[SourceFeature]],
    frame: LocalFrame,
    drawn: Outlines,
    notes: ImportNotes,
) -> None:
    for source in ("amenity", "fixture", "kiosk"):
        for feature in here[source]:
            kind = "kiosk" if source == "kiosk" else _kind(feature)
            if feature.geometry is None or kind not in THINGS:
                notes.miss(f"{source} that is no thing: {kind}", feature.id)
                continue
            middle = frame.placed(feature.geometry).representative_point()
            name = feature.text("name", "alt_name")
            place = (middle.x, middle.y)
            drawn.things.append(FoundThing(feature.id, place, THINGS[kind], name))
