"""VLN-CE files: episodes in continuous space, with the actions that solve them.

Format: Krantz et al. 2020, "Beyond the Nav-Graph" (ECCV), R2R_VLNCE_v1-3. Positions are
in Habitat's frame: x east, y up, -z north; rotations are quaternions (x, y, z, w), and an
agent without rotation looks along -z, which is north.
"""

import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BaseModel, Field, FiniteFloat, TypeAdapter

from memorymaze.basics.errors import InstructionFileError
from memorymaze.basics.geometry.polyline import length, point_at, points_at, project
from memorymaze.basics.geometry.pose import Pose, bearing_to, moved, wrap_angle
from memorymaze.texts.corpus.record_format import instruction_record
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.exchange.foreign_files import (
    OWN_FIELD,
    Unlabelled,
    by_split,
    own_or_new,
    read_as,
    site_called,
    split_of,
    write_json,
)
from memorymaze.world.sites.records import Route, Site

SAME_PLACE = 0.01
"""Metres within which two points are the same."""
SAME_HEADING = math.radians(0.5)
STOP, FORWARD, LEFT, RIGHT = 0, 1, 2, 3
"""Numbers of the actions in VLN-CE."""
STEP, TURN = 0.25, math.radians(15)
"""Metres and radians of an action."""
GOAL_RADIUS = 3.0
"""Metres; of every goal."""
LOOK_AHEAD = 0.75
"""Metres along the line from where the agent is to where it heads for."""
PADDING, UNKNOWN = 0, 1
TOKEN = re.compile(r"\w+|[^\w\s]")
SHORTEST = 200
"""Numbers per text at least, as in VLN-CE's preprocessed files."""

_Position = Annotated[list[FiniteFloat], Field(min_length=3, max_length=3)]


class _Text(BaseModel):
    instruction_text: str


class _Episode(BaseModel):
    episode_id: int | str
    scene_id: str
    start_position: _Position
    start_rotation: Annotated[list[FiniteFloat], Field(min_length=4, max_length=4)]
    instruction: _Text
    reference_path: Annotated[list[_Position], Field(min_length=2)]
    info: dict[str, Any] = {}


class _File(BaseModel):
    episodes: list[_Episode]


_FILE = TypeAdapter(_File)


class WordNumbers:
    """A vocabulary: the words of some texts, the most frequent first."""

    def __init__(self, texts: Iterable[str]) -> None:
        """Number the words of texts; case does not count."""
        lists = [_tokens(text) for text in texts]
        counts = Counter(token for tokens in lists for token in tokens)
        ordered = sorted(counts, key=lambda word: (-counts[word], word))
        self.words = ["<pad>", "<unk>", *ordered]
        """Every word at the place of its number."""
        self.length = max([SHORTEST, *map(len, lists)])
        """Numbers that stand for one text, padding included."""
        self._numbers = {word: number for number, word in enumerate(self.words)}

    def numbers(self, text: str) -> list[int]:
        """Return a text as numbers, padded to the length of the longest."""
        found = [self._numbers.get(token, UNKNOWN) for token in _tokens(text)]
        return found + [PADDING] * (self.length - len(found))

    def record(self) -> dict[str, Any]:
        """Return VLN-CE's `instruction_vocab`."""
        return {
            "word_list": self.words,
            "word2idx_dict": self._numbers,
            "itos": self.words,
            "stoi": self._numbers,
            "num_vocab": len(self.words),
            "UNK_INDEX": UNKNOWN,
            "PAD_INDEX": PADDING,
        }


def _tokens(text: str) -> Sequence[str]:
    return TOKEN.findall(text.lower())


def write_vln_ce(
    folder: str | Path,
    instructions: Iterable[Instruction],
    sites: Mapping[str, Site],
) -> list[Path]:
    """Write `SPLIT/SPLIT.json.gz` and `SPLIT/SPLIT_gt.json.gz` for each split.

    Positions are in Habitat's frame. The ground truth holds the actions and places of
    a walk along the reference route. What VLN-CE has no place for is kept in
    `info.memorymaze`.

    Args:
        folder: Where; made if need be.
        instructions: Whose sites and routes exist.
        sites: Sites by name.

    Returns:
        The files written.

    Raises:
        InstructionFileError: A file cannot be written.
    """
    folder = Path(folder)
    files: list[Path] = []
    trajectories: dict[tuple[str, str], int] = {}
    number = 0
    for split, members in by_split(instructions).items():
        words = WordNumbers(each.text for each in members)
        episodes: list[dict[str, Any]] = []
        truth: dict[str, Any] = {}
        walks: dict[tuple[str, str], dict[str, Any]] = {}
        for each in members:
            number += 1
            way = (each.site, each.reference_route)
            route = sites[each.site].find_route(each.reference_route)
            trajectory = trajectories.setdefault(way, len(trajectories) + 1)
            if way not in walks:
                walks[way] = _ground_truth(route)
            episodes.append({
                "episode_id": number,
                "trajectory_id": trajectory,
                **_episode(each, route, words),
            })
            truth[str(number)] = walks[way]
        place = folder / split
        files += [place / f"{split}.json.gz", place / f"{split}_gt.json.gz"]
        write_json(
            files[-2], {"episodes": episodes, "instruction_vocab": words.record()}
        )
        write_json(files[-1], truth)
    return files


def read_vln_ce(
    paths: Sequence[str | Path],
    sites: Mapping[str, Site],
    labels: Unlabelled | None = None,
) -> list[Instruction]:
    """Read VLN-CE files whose scenes are sites and whose paths are routes of them.

    Args:
        paths: `SPLIT.json.gz` files; also unpacked.
        sites: Sites by name.
        labels: For files that `write_vln_ce` has not written.

    Raises:
        InstructionFileError: A file is not in the format, an episode runs along no
            route of its site, or labels are needed and not given.
    """
    read: list[Instruction] = []
    for path in map(Path, paths):
        for episode in read_as(_FILE, path, "VLN-CE episodes").episodes:
            place = f"{path}: episode_id {episode.episode_id}"
            read.append(
                own_or_new(
                    episode.info.get(OWN_FIELD),
                    episode.instruction.instruction_text,
                    _routes_of(episode, sites, place),
                    new_id=str(episode.episode_id),
                    split=split_of(path),
                    labels=labels,
                    place=place,
                )
            )
    return read


def _episode(
    instruction: Instruction, route: Route, words: WordNumbers
) -> dict[str, Any]:
    points = [to_position(x, y) for x, y, *_ in route.line.coords]
    return {
        "scene_id": f"memorymaze/{instruction.site}.geojson",
        "start_position": points[0],
        "start_rotation": to_rotation(route.start_heading),
        "goals": [{"position": points[-1], "radius": GOAL_RADIUS}],
        "instruction": {
            "instruction_text": instruction.text,
            "instruction_tokens": words.numbers(instruction.text),
        },
        "reference_path": points,
        "info": {
            "geodesic_distance": route.length,
            OWN_FIELD: instruction_record(instruction),
        },
    }


def _ground_truth(route: Route) -> dict[str, Any]:
    walk = walk_along([point[:2] for point in route.line.coords], route.start)
    return {
        "locations": [to_position(x, y) for x, y in walk.places],
        "forward_steps": walk.actions.count(FORWARD),
        "actions": list(walk.actions),
    }


def _routes_of(
    episode: _Episode, sites: Mapping[str, Site], place: str
) -> list[tuple[Site, Route]]:
    site = site_called(Path(episode.scene_id).stem, sites, place)
    path = [from_position(point) for point in episode.reference_path]
    heading = to_heading(episode.start_rotation)
    found = [
        (site, route)
        for route in site.routes
        if _same_line(path, [(x, y) for x, y, *_ in route.line.coords])
        and abs(math.remainder(heading - route.start_heading, math.tau)) < SAME_HEADING
    ]
    if not found:
        known = ", ".join(route.id for route in site.routes)
        raise InstructionFileError(
            f"{place}: expected start and reference_path of a route of {site.name} ({known}), "
            "got others; add the route to the plan"
        )
    return found


def _same_line(
    one: Sequence[tuple[float, float]], other: Sequence[tuple[float, float]]
) -> bool:
    return len(one) == len(other) and all(
        math.dist(here, there) < SAME_PLACE
        for here, there in zip(one, other, strict=True)
    )


def to_position(x: float, y: float) -> list[float]:
    """Return a point on the floor in Habitat's frame, metres, shape (3,)."""
    return [x, 0.0, -y]


def from_position(position: Sequence[float]) -> tuple[float, float]:
    """Return a point of Habitat's frame on our floor, metres; its height is dropped."""
    x, _, z = position
    return x, -z


def to_rotation(heading: float) -> list[float]:
    """Return a heading (radians from east) as a quaternion about the y axis.

    >>> to_rotation(math.pi / 2)
    [0.0, 0.0, 0.0, 1.0]
    """
    half = (heading - math.pi / 2) / 2
    return [0.0, math.sin(half), 0.0, math.cos(half)]


def to_heading(rotation: Sequence[float]) -> float:
    """Return the heading in radians from east of a rotation about the y axis."""
    _, y, _, w = rotation
    return wrap_angle(2 * math.atan2(y, w) + math.pi / 2)


class DiscreteWalk(NamedTuple):
    """A walk of single actions."""

    actions: tuple[int, ...]
    """Ends with `STOP`."""
    places: tuple[tuple[float, float], ...]
    """Where the agent stands before each action, metres."""


class LineFollower:
    """Decides, step by step, how to go along a line.

    It heads for a point a little ahead on the line, turns as often as brings it nearest
    to that direction, and steps; it stops where another step would not bring it nearer
    to the end. It never strays farther from the line than about a step.
    """

    def __init__(self, line: ArrayLike, turn: float = TURN) -> None:
        """Begin on the line's first vertex, with radians of a turn."""
        self._line = line
        self._turn = turn
        self._total = length(line)
        self._end = tuple(point_at(line, self._total).tolist())
        self._along = 0.0

    def turns_before_step(self, pose: Pose) -> int | None:
        """Return how often to turn left (negative: right) before a step; None: stop."""
        x, y, _ = pose
        self._along = max(self._along, _progress(self._line, self._along, (x, y)))
        ahead = point_at(self._line, min(self._along + LOOK_AHEAD, self._total))
        aim = (float(ahead[0]), float(ahead[1]))
        turns = 0
        if math.dist((x, y), aim) > 1e-9:
            turns = round(bearing_to(pose, aim) / self._turn)
        there = self.after(pose, turns)[:2]
        near_end = self._total - self._along < LOOK_AHEAD
        if near_end and math.dist(there, self._end) >= math.dist((x, y), self._end):
            return None
        return turns

    def after(self, pose: Pose, turns: int) -> Pose:
        """Return where turns and a step lead."""
        heading = wrap_angle(pose.heading + turns * self._turn)
        return Pose(*moved((pose.x, pose.y), heading, STEP), heading)


def walk_along(line: ArrayLike, start: Pose, *, turn: float = TURN) -> DiscreteWalk:
    """Walk along a line with steps of one length and turns of one angle.

    Args:
        line: Vertices, metres, shape (N, 2).
        start: Where the walk begins; on the line's first vertex.
        turn: Radians of `LEFT` and `RIGHT`.
    """
    follower = LineFollower(line, turn)
    pose = start
    actions: list[int] = []
    places: list[tuple[float, float]] = []
    while (turns := follower.turns_before_step(pose)) is not None:
        actions += [LEFT if turns > 0 else RIGHT] * abs(turns) + [FORWARD]
        places += [(pose.x, pose.y)] * (abs(turns) + 1)
        pose = follower.after(pose, turns)
    return DiscreteWalk((*actions, STOP), (*places, (pose.x, pose.y)))


def _progress(line: ArrayLike, along: float, place: tuple[float, float]) -> float:
    """Return the arc length of the nearest place on the next metre of the line."""
    total = length(line)
    stations = np.linspace(along, min(along + 1.0, total), 21)
    return along + project(points_at(line, stations), place).s
