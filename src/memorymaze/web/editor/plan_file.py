"""The file that is edited: what it says, what is not saved yet, and saving.

A browser sends the features that it has not touched by their place in the file: what it
sends while its page closes must be small.
"""

import json
import threading
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import SettingsError, SitePlanError
from memorymaze.basics.input_files import parse_json, read_text
from memorymaze.world.sites.plan import written_plan

Plan = dict[str, Any]
SUFFIXES = (".geojson", ".json")


class Edited(BaseModel):
    """A plan as a browser sends it."""

    model_config = ConfigDict(strict=True, frozen=True)

    base: str
    """Fingerprint of the file's text that it began with."""
    members: Plan
    """All members but the features."""
    features: list[Any]
    """A number is the place of a feature in the file that is not changed."""


class TracedPicture(BaseModel):
    """Where the picture of a floor plan lies beneath the plan."""

    model_config = ConfigDict(strict=True, frozen=True)

    x: float
    """Of its upper left corner, metres."""
    y: float
    metres_per_pixel: float
    turn_deg: float
    """Counter-clockwise about that corner."""
    opacity: float


class Kept(BaseModel):
    """What is kept beside the plan: what is not saved, and where the picture lies."""

    base: str = ""
    draft: Plan | None = None
    picture: TracedPicture | None = None


class ChangedMeanwhile(Exception):
    """The file is not what the browser began with; the message says what to do."""


@dataclass(frozen=True, slots=True)
class _Read:
    """The file as it was read."""

    text: str
    plan: Plan
    is_there: bool

    @property
    def base(self) -> str:
        return sha256(self.text.encode()).hexdigest() if self.is_there else ""


class PlanFile:
    """A plan's file and its drafts; several threads may use it."""

    def __init__(self, path: Path) -> None:
        """Read the file, which need not be there; SitePlanError says what is no JSON."""
        if path.suffix not in SUFFIXES:
            raise SettingsError(
                f"{path}: expected a plan's file, *{' or *'.join(SUFFIXES)}, got "
                f"{path.name!r}"
            )
        self.path = path.resolve()  # a link stays a link when the file is replaced
        self._drafts = path.with_name(f".{path.stem}.editing.json")
        self._lock = threading.RLock()
        self._kept = self._read_kept()
        self._read = self._read_file()

    def contents(self) -> dict[str, Any]:
        """Return what a page begins with, from the disk."""
        with self._lock:
            self._read = self._read_file()
            return {
                "base": self._read.base,
                "plan": self._read.plan,
                "draft": self._kept.draft,
                "is_old_draft": self._kept.base != self._read.base,
                "picture": self._kept.picture and self._kept.picture.model_dump(),
            }

    def document(self, edited: Edited) -> Plan:
        """Return what a browser sent as a whole plan."""
        with self._lock:
            if edited.base != self._read.base:
                raise ChangedMeanwhile(
                    f"{self.path.name} was saved in another window since it was loaded here."
                )
            there = self._read.plan.get("features")
            there = there if isinstance(there, list) else []
            if any(
                isinstance(e, int) and not 0 <= e < len(there) for e in edited.features
            ):
                raise ChangedMeanwhile(f"{self.path.name} has other features now.")
            features = [
                there[each] if isinstance(each, int) else each
                for each in edited.features
            ]
        return {**edited.members, "features": features}

    def keep_draft(self, edited: Edited) -> Plan:
        """Keep what is not saved, and return it as a whole plan."""
        with self._lock:
            document = self.document(edited)
            draft = None if _is_same(document, self._read.plan) else document
            self._keep(base=self._read.base, draft=draft)
        return document

    def discard_draft(self) -> None:
        """Forget what is not saved."""
        with self._lock:
            self._keep(draft=None)

    def keep_picture(self, picture: TracedPicture) -> None:
        """Keep where the picture lies."""
        with self._lock:
            self._keep(picture=picture)

    def save(self, edited: Edited) -> str:
        """Write the file, and return its new fingerprint.

        ChangedMeanwhile says that somebody else changed the file since it was read: who
        wants to replace it all the same reads it again first.
        """
        with self._lock:
            document = self.document(edited)
            if self._is_changed_on_disk():
                raise ChangedMeanwhile(
                    f"{self.path.name} was changed on the disk since it was loaded here."
                )
            if not (self._read.is_there and _is_same(document, self._read.plan)):
                content = written_plan({"type": "FeatureCollection", **document})
                write_whole(self.path, content)
                self._read = _Read(content.decode(), document, is_there=True)
            self._keep(draft=None)
            return self._read.base

    def _read_file(self) -> _Read:
        if not self.path.exists():
            return _Read("", _new_plan(self.path.stem), is_there=False)
        text = read_text(self.path, SitePlanError)
        try:
            document = parse_json(text)
        except ValueError as error:
            raise SitePlanError(
                f"{self.path}: {error}; correct it in a text editor first"
            ) from None
        if not isinstance(document, dict):
            raise SitePlanError(
                f'{self.path}: expected {{"type": "FeatureCollection", …}} at the top'
            )
        return _Read(text, document, is_there=True)

    def _is_changed_on_disk(self) -> bool:
        if not self.path.exists():
            return self._read.is_there
        if not self._read.is_there:
            return True
        return read_text(self.path, SitePlanError) != self._read.text

    def _read_kept(self) -> Kept:
        if not self._drafts.exists():
            return Kept()
        try:
            return Kept.model_validate_json(read_text(self._drafts, SitePlanError))
        except ValidationError as error:
            raise SitePlanError(
                f"{self._drafts}: expected a draft that this page kept; repair or "
                f"remove it ({error.errors()[0]['msg']})"
            ) from None

    def _keep(self, **changed: Any) -> None:
        self._kept = self._kept.model_copy(update=changed)
        if self._kept.draft is None and self._kept.picture is None:
            self._drafts.unlink(missing_ok=True)
        else:
            write_whole(self._drafts, json.dumps(self._kept.model_dump()).encode())


def _is_same(one: Plan, other: Plan) -> bool:
    """Tell whether plans are the same to a browser, where 5 is 5.0 and 1 is not true."""
    one, other = (
        json.loads(json.dumps(each), parse_int=float) for each in (one, other)
    )
    return json.dumps(one, sort_keys=True) == json.dumps(other, sort_keys=True)


def _new_plan(name: str) -> Plan:
    """Return a plan in which nothing stands yet."""
    return {
        "type": "FeatureCollection",
        "name": name,
        "title": name.replace("_", " ").capitalize(),
        "floor": "ground floor",
        "ceiling_height_m": 2.8,
        "anchor": None,
        "description": "",
        "features": [],
    }
