"""Has a vision model describe what is seen from viewpoints, once for each."""

import json
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import count
from typing import Any

from memorymaze.agents.agent import Journal
from memorymaze.agents.asking import ask_until_read, object_in
from memorymaze.basics.geometry.pose import Pose
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
    Picture,
)
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version
from memorymaze.robot.api.viewpoints import EIGHT_DIRECTIONS, Panorama
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.viewpoint_walk import look_around, sector_headings
from memorymaze.world.looks import Looks
from memorymaze.world.sites.navigation_graph import Viewpoint

PICTURE_WIDTH, PICTURE_HEIGHT = 256, 512
"""Pixels. As wide as a direction, and high enough for floor and ceiling."""
PICTURE_FOV = math.radians(45)
JPEG_QUALITY = 85
LOOKS: Looks = "own"
"""Captions are asked for by viewpoint, whatever looks a run has."""
LONGEST_REPLY = 2000
"""Tokens."""

Shoot = Callable[[Scene, Viewpoint], tuple[Picture, ...]]


@dataclass(frozen=True, slots=True)
class Captions:
    """What a vision model says of a viewpoint."""

    views: tuple[str, ...]
    """A sentence for each of eight directions, north first, then clockwise."""
    summary: str


class VisionCaptions:
    """Sentences by a vision model; things, angles and distances as the camera has them.

    The pictures show the building as in its plan, without an episode's people and
    things, so that captions can be used again. Each episode counts those of every
    viewpoint it comes to, as if they were made on the way, asked for or not: what an
    episode costs must not depend on which came before.
    """

    def __init__(self, model: LanguageModel, shoot: Shoot | None = None) -> None:
        """Prepare."""
        self._model = model
        self._shoot = shoot or take_pictures
        self._prompt = load_prompt("describe_viewpoint")
        self._known: dict[str, tuple[Captions, list[Completion]]] = {}
        """By viewpoint, with the replies it took."""

    def in_episode(
        self, robot: SimulatedRobot, journal: Journal
    ) -> Callable[[Viewpoint], Panorama]:
        """Return what looks around from viewpoints in one episode.

        It raises `LanguageModelError` where the model does not answer as it was asked
        to, and `RenderingError` where this machine cannot draw.
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
        place = f"{scene.site.name}/{viewpoint.id}"
        replies: list[Completion] = []
        try:
            if place not in self._known:
                pictures = self._shoot(scene, viewpoint)
                self._known[place] = self._ask(place, pictures, replies), replies
            captions, replies = self._known[place]
        finally:
            for each in replies:
                journal.count(each, stage="caption")
        return captions

    def _ask(
        self, place: str, pictures: tuple[Picture, ...], replies: list[Completion]
    ) -> Captions:
        """Ask until a reply can be read; all that a model gave are added to `replies`."""

        def keep(reply: Completion) -> float:
            replies.append(reply)
            return 0.0

        task = Message("user", "The eight pictures:", pictures)
        request = CompletionRequest(
            (Message("system", self._prompt), task), max_tokens=LONGEST_REPLY
        )
        question = ModelQuestion(
            "caption", prompt_version(self._prompt), instruction=place
        )
        own = Journal(on_completion=keep)
        return ask_until_read(
            self._model, own, request, question, count(1), read_captions
        )


def read_captions(reply: str) -> Captions:
    """Read the JSON object of captions in a reply, whatever stands around it."""
    expected = (
        f'expected one JSON object with "views", {EIGHT_DIRECTIONS} sentences, and '
        '"summary", a sentence'
    )
    try:
        record: Any = json.loads(object_in(reply))
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
    place = f"{scene.site.name}/{viewpoint.id}"
    drawn = f"{LOOKS} {PICTURE_WIDTH}x{PICTURE_HEIGHT}"
    pictures: list[Picture] = []
    for number, heading in enumerate(sector_headings()):
        pixels = camera.picture(Pose(viewpoint.x, viewpoint.y, heading))
        name = f"{place}/{number} {drawn}"
        pictures.append(Picture.of_pixels(pixels, name, quality=JPEG_QUALITY))
    return tuple(pictures)


@lru_cache(maxsize=4)
def _camera(scene: Scene) -> Any:
    # Runs that never draw load neither OpenGL nor the looks of things.
    from memorymaze.robot.simulation.cameras import visual_scene_of
    from memorymaze.world.cameras import RenderedCamera

    looks = visual_scene_of(scene, LOOKS)
    return RenderedCamera(looks, PICTURE_WIDTH, PICTURE_HEIGHT, PICTURE_FOV)


def _one_line(text: str) -> str:
    return " ".join(text.split())
