"""SAIL's paragraphs as episodes: four for each, one for every start heading."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.texts.corpus.records import (
    Corpus,
    Episode,
    Followers,
    Instruction,
    was_developed_on,
)
from memorymaze.texts.corpus.sail.folder import load_sail
from memorymaze.texts.corpus.sail.records import Paragraph
from memorymaze.texts.corpus.sail.sites import EDGE, maze_site, route_name, site_name
from memorymaze.world.sites.records import Site

HEADINGS = {"east": 0.0, "north": 90.0, "west": 180.0, "south": 270.0}
"""Start headings by name, degrees counter-clockwise from east."""
DEVELOPMENT = "dev"
"""Split of the writers whose texts were read while the agents were developed."""
SUCCESS_DISTANCE = EDGE / 2
"""Metres: at the right node, not at its neighbour."""
TIME_BUDGET = 400.0
"""Simulated seconds. Three times a perfect walk, as elsewhere, is 188 s; the rest is for
looking about, since nobody tells which way one faces at first."""
DETECTION_RANGE = 40.0
"""Metres: to the end of every hall, which is how far writers and followers saw."""
_MARK = "@"


def sail_corpus(folder: str | Path) -> Corpus:
    """Read a SAIL folder: four episodes for each paragraph, with SAIL's own limits.

    Raises:
        InstructionFileError: The folder or something in it cannot be used.
        SitePlanError: A maze makes no sound plan.
    """
    texts = load_sail(folder)
    mazes = [maze_site(maze, texts.files[0]) for maze in texts.mazes.values()]
    sites = {site.name: site for site in mazes}
    return Corpus(
        "SAIL",
        tuple(sail_episodes(texts.paragraphs, sites)),
        sites,
        tuple(map(Path, texts.files)),
        success_distance=SUCCESS_DISTANCE,
        time_budget=TIME_BUDGET,
        detection_range=DETECTION_RANGE,
        start_heading_is_told=False,
        was_half_read=True,
    )


def sail_episodes(
    paragraphs: Sequence[Paragraph], sites: Mapping[str, Site]
) -> list[Episode]:
    """Return four episodes for each paragraph, in order.

    The goal is the middle of the goal's node, and the path compared with is a shortest
    one, whatever way the paragraph tells. The study is `sail`, the iteration always 1.

    Args:
        paragraphs: What to follow.
        sites: From `maze_site`, by name.
    """
    return [
        _episode(paragraph, sites[site_name(paragraph.maze)], heading)
        for paragraph in paragraphs
        for heading in HEADINGS
    ]


def paragraph_of(episode_id: str) -> str:
    """Return the id of the paragraph that an episode is about."""
    return episode_id.partition(_MARK)[0]


def _episode(paragraph: Paragraph, site: Site, heading: str) -> Episode:
    name = route_name(paragraph.start_position, paragraph.goal_position)
    route = site.find_route(name)
    told = Instruction(
        id=paragraph.id,
        site=site.name,
        route=name,
        study="sail",
        participant=paragraph.writer,
        text=paragraph.text,
        reference_route=route.id,
        split=DEVELOPMENT if was_developed_on(paragraph.writer) else "test",
        followers=Followers(paragraph.usable, paragraph.followers, paragraph.arrived),
    )
    path = tuple((float(x), float(y)) for x, y, *_ in route.line.coords)
    x, y = path[0]
    start = Pose(x, y, wrap_angle(math.radians(HEADINGS[heading])))
    return Episode(f"{paragraph.id}{_MARK}{heading}", told, start, path[-1], path)
