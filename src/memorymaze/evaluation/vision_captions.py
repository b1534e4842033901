"""Has a vision model describe what is seen from viewpoints, once for each.

What it said is kept in one SQLite file, to which several processes may write at once.
"""

import hashlib
import json
import math
import sqlite3
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from memorymaze.agents.agent import Journal
from memorymaze.durable_files import open_database
from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.geometry.pose import Pose
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    Message,
    Picture,
)
from memorymaze.language.prompt_texts import load_prompt
from memorymaze.robot.viewpoints import EIGHT_DIRECTIONS, Panorama
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.viewpoint_walk import look_around, sector_headings
from memorymaze.sites import Site
from memorymaze.sites.navigation_graph import Viewpoint

_REPLIES = TypeAdapter(tuple[Completion, ...])
TABLE = """
CREATE TABLE IF NOT EXISTS captions (
    scene TEXT NOT NULL,
    viewpoint TEXT NOT NULL,
    model TEXT NOT NULL,
    prompt TEXT NOT NULL,
    replies TEXT NOT NULL,
    PRIMARY KEY (scene, viewpoint, model, prompt)
)
"""


PICTURE_WIDTH, PICTURE_HEIGHT = 256, 512
"""Pixels. As wide as a direction, and high enough for floor and ceiling."""
PICTURE_FOV = math.radians(45)
JPEG_QUALITY = 85
TRIES = 2
"""Requests for the captions of a viewpoint, when a reply cannot be read."""
LONGEST_REPLY = 2000
"""Tokens."""

Shoot = Callable[[Scene, Viewpoint], tuple[Picture, ...]]


@dataclass(frozen=True, slots=True)
class CaptionKey:
    """What determines the captions of a viewpoint."""

    scene: str
    """Digest of the site plan."""
    viewpoint: str
    """Id in the navigation graph."""
    model: str
    """Name of the vision model."""
    prompt: str
    """Digest of what the model is asked, and of how its pictures are taken."""


class CaptionStore:
    """Replies by what determines them."""

    def __init__(self, path: Path | str) -> None:
        """Open or make the file."""
        self._path = Path(path).absolute()
        try:
            with open_database(self._path, make=True) as database:
                database.execute(TABLE)
        except (sqlite3.Error, OSError) as error:
            raise SettingsError(
                f"{path}: expected a place for a file of captions ({error}); choose "
                "another one with --set caption_file=FILE"
            ) from error

    def find(self, key: CaptionKey) -> tuple[Completion, ...]:
        """Return the replies kept under a key, the last one usable; empty for none."""
        try:
            with open_database(self._path) as database:
                row = database.execute(
                    "SELECT replies FROM captions WHERE scene = ? AND viewpoint = ? "
                    "AND model = ? AND prompt = ?",
                    (key.scene, key.viewpoint, key.model, key.prompt),
                ).fetchone()
            return () if row is None else _REPLIES.validate_json(row[0])
        except (sqlite3.Error, ValidationError) as error:
            raise LanguageModelError(
                f"{self._path}: the captions cannot be read ({error})"
            ) from error

    def keep(
        self, key: CaptionKey, replies: Sequence[Completion]
    ) -> tuple[Completion, ...]:
        """Keep replies; return those that are kept, which another process may have."""
        text = json.dumps([asdict(each) for each in replies])
        try:
            with open_database(self._path) as database:
                database.execute(
                    "INSERT OR IGNORE INTO captions VALUES (?, ?, ?, ?, ?)",
                    (key.scene, key.viewpoint, key.model, key.prompt, text),
                )
        except sqlite3.Error as error:
            raise LanguageModelError(
                f"{self._path}: captions could not be kept ({error})"
            ) from error
        return self.find(key)


@dataclass(frozen=True, slots=True)
class Captions:
    """What a vision model says of a viewpoint."""

    views: tuple[str, ...]
    """A sentence for each of eight directions, north first, then clockwise."""
    summary: str


class VisionCaptions:
    """Sentences by a vision model; things, angles and distances as the camera has them.

    The pictures show the building as in its plan, without an episode's people and
    things, so that captions can be kept and used again. Each episode counts those of
    every viewpoint it comes to, as if they were made on the way, kept or not: what an
    episode costs must not depend on which came before.
    """

    def __init__(
        self,
        model: LanguageModel,
        store: CaptionStore,
        shoot: Shoot | None = None,
    ) -> None:
        """Prepare."""
        self._model = model
        self._store = store
        self._shoot = shoot or take_pictures
        self._prompt = load_prompt("describe_viewpoint")
        self._asked = digest(
            f"{self._prompt} {PICTURE_WIDTH}x{PICTURE_HEIGHT} {PICTURE_FOV:.4f}"
        )

    def in_episode(
        self, robot: SimulatedRobot, journal: Journal
    ) -> Callable[[Viewpoint], Panorama]:
        """Return what looks around from viewpoints in one episode.

        It raises `LanguageModelError` where the model does not answer as it was asked
        to, `RenderingError` where this machine cannot draw, and `SettingsError` where
        the site was not read from a file.
        """
        told: dict[str, Captions] = {}

        def look(viewpoint: Viewpoint) -> Panorama:
            if viewpoint.id not in told:
                told[viewpoint.id] = self._captions(robot.scene, viewpoint, journal)
            captions = told[viewpoint.id]
            seen = look_around(robot, viewpoint.x, viewpoint.y)
            return Panorama(
                tuple(
                    replace(outlook, scene=sentence)
                    for outlook, sentence in zip(
                        seen.outlooks, captions.views, strict=True
                    )
                ),
                captions.summary,
                self._model.name,
            )

        return look

    def _captions(
        self, scene: Scene, viewpoint: Viewpoint, journal: Journal
    ) -> Captions:
        key = CaptionKey(
            _fingerprint(scene.site), viewpoint.id, self._model.name, self._asked
        )
        kept = self._store.find(key)
        if not kept:
            replies: list[Completion] = []
            try:
                self._ask(self._shoot(scene, viewpoint), replies)
            except LanguageModelError:
                _count(replies, journal)
                raise
            kept = self._store.keep(key, replies)
        _count(kept, journal)
        return read_captions(kept[-1].text)

    def _ask(self, pictures: tuple[Picture, ...], replies: list[Completion]) -> None:
        """Ask until a reply can be read; all of them are added to `replies`."""
        messages = (
            Message("system", self._prompt),
            Message("user", "The eight pictures:", pictures),
        )
        problem = ""
        for _ in range(TRIES):
            completion = self._model.complete(
                CompletionRequest(messages, max_tokens=LONGEST_REPLY)
            )
            replies.append(completion)
            try:
                read_captions(completion.text)
            except ValueError as error:
                problem = str(error)
                messages += (
                    Message("assistant", completion.text or "(nothing)"),
                    Message("user", f"That cannot be used: {problem}. Answer again."),
                )
            else:
                return
        raise LanguageModelError(
            f"{self._model.name}: no captions in {TRIES} replies: {problem}"
        )


def _count(replies: Iterable[Completion], journal: Journal) -> None:
    for completion in replies:
        journal.count(completion, stage="caption")


def read_captions(reply: str) -> Captions:
    """Read the JSON object of captions in a reply, whatever stands around it."""
    expected = (
        f'expected one JSON object with "views", {EIGHT_DIRECTIONS} sentences, and '
        '"summary", a sentence'
    )
    try:
        record: Any = json.loads(reply[reply.index("{") : reply.rindex("}") + 1])
        views: Any = record["views"]
        summary: Any = record["summary"]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise ValueError(f"{expected}; got none") from None
    good = isinstance(views, list) and all(
        isinstance(each, str) and each.strip() for each in [*views, summary]
    )
    if not good:
        raise ValueError(f"{expected}; got other things in it")
    if len(views) != EIGHT_DIRECTIONS:
        raise ValueError(f"{expected}; got {len(views)} views")
    return Captions(tuple(map(_one_line, views)), _one_line(summary))


def take_pictures(scene: Scene, viewpoint: Viewpoint) -> tuple[Picture, ...]:
    """Return eight pictures from a viewpoint: north, then clockwise."""
    camera = _camera(scene)
    pictures: list[Picture] = []
    for number, heading in enumerate(sector_headings()):
        pixels = camera.picture(Pose(viewpoint.x, viewpoint.y, heading))
        name = f"{viewpoint.id}-{number}"
        pictures.append(Picture.of_pixels(pixels, name, quality=JPEG_QUALITY))
    return tuple(pictures)


@lru_cache(maxsize=4)
def _camera(scene: Scene) -> Any:
    # Runs that never draw load neither OpenGL nor the looks of things.
    from memorymaze.pictures.rendering import RenderedCamera
    from memorymaze.pictures.rendering.robot_eyes import visual_scene_of

    # Captions are kept by the building and the viewpoint, whatever looks a run has.
    looks = visual_scene_of(scene, "own")
    return RenderedCamera(looks, PICTURE_WIDTH, PICTURE_HEIGHT, PICTURE_FOV)


@lru_cache(maxsize=8)
def _fingerprint_of_file(path: str) -> str:
    return digest(Path(path).read_bytes())


def _fingerprint(site: Site) -> str:
    try:
        return _fingerprint_of_file(site.source)
    except OSError as error:
        raise SettingsError(
            f"{site.name}: captions are kept by the site plan's file, which cannot be "
            f"read ({error.strerror}); take --set captions=templates"
        ) from None


def _one_line(text: str) -> str:
    return " ".join(text.split())


def digest(text: str | bytes) -> str:
    """Return the fingerprint of a text or of a file's bytes."""
    content = text.encode() if isinstance(text, str) else text
    return hashlib.sha256(content).hexdigest()
