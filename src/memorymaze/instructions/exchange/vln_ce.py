"""VLN-CE files: episodes in continuous space, with the actions that solve them.

Format: Krantz et al. 2020, "Beyond the Nav-Graph" (ECCV), R2R_VLNCE_v1-3.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.exchange.discrete_actions import FORWARD, walk_along
from memorymaze.instructions.exchange.habitat_frame import (
    from_position,
    to_heading,
    to_position,
    to_rotation,
)
from memorymaze.instructions.exchange.packed_json import read_json, write_json
from memorymaze.instructions.exchange.records import (
    OWN_FIELD,
    Unlabelled,
    by_split,
    own_or_new,
    split_of,
)
from memorymaze.instructions.exchange.vocabulary import WordNumbers
from memorymaze.instructions.line_format import instruction_record
from memorymaze.instructions.records import Instruction
from memorymaze.sites.records import Route, Site

SAME_PLACE = 0.01
"""Metres within which two points are the same."""
SAME_HEADING = math.radians(0.5)

Position = Annotated[list[FiniteFloat], Field(min_length=3, max_length=3)]


class _Text(BaseModel):
    model_config = ConfigDict(extra="allow")

    instruction_text: str


class _Episode(BaseModel):
    model_config = ConfigDict(extra="allow")

    episode_id: int | str
    scene_id: str
    start_position: Position
    start_rotation: Annotated[list[FiniteFloat], Field(min_length=4, max_length=4)]
    instruction: _Text
    reference_path: Annotated[list[Position], Field(min_length=2)]
    info: dict[str, Any] = {}


class _File(BaseModel):
    model_config = ConfigDict(extra="allow")

    episodes: list[_Episode]


def write_vln_ce(
    folder: str | Path,
    instructions: Iterable[Instruction],
    sites: Mapping[str, Site],
    *,
    success_distance: float = 3.0,
    step: float = 0.25,
    turn: float = math.radians(15),
) -> list[Path]:
    """Write `SPLIT/SPLIT.json.gz` and `SPLIT/SPLIT_gt.json.gz` for each split.

    Positions are in Habitat's frame. The ground truth holds the actions and places of
    a walk along the reference route. What VLN-CE has no place for is kept in
    `info.memorymaze`.

    Args:
        folder: Where; made if need be.
        instructions: Whose sites and routes exist.
        sites: Sites by name.
        success_distance: Radius of the goals, metres.
        step: Metres of a step forward in the ground truth.
        turn: Radians of a turn in the ground truth.

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
            route = sites[each.site].route(each.reference_route)
            trajectory = trajectories.setdefault(way, len(trajectories) + 1)
            if way not in walks:
                walks[way] = _ground_truth(route, step, turn)
            episodes.append({
                "episode_id": number,
                "trajectory_id": trajectory,
                **_episode(each, route, words, success_distance),
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
        try:
            content = _File.model_validate(read_json(path))
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(map(str, first["loc"])) or "the file"
            raise InstructionFileError(
                f"{path}: expected VLN-CE episodes, got a file where {where} is wrong "
                f"({first['msg']})"
            ) from None
        for episode in content.episodes:
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
    instruction: Instruction, route: Route, words: WordNumbers, success_distance: float
) -> dict[str, Any]:
    points = [to_position(x, y) for x, y, *_ in route.line.coords]
    return {
        "scene_id": f"memorymaze/{instruction.site}.geojson",
        "start_position": points[0],
        "start_rotation": to_rotation(route.start_heading),
        "goals": [{"position": points[-1], "radius": success_distance}],
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


def _ground_truth(route: Route, step: float, turn: float) -> dict[str, Any]:
    walk = walk_along(
        [point[:2] for point in route.line.coords], route.start, step=step, turn=turn
    )
    return {
        "locations": [to_position(x, y) for x, y in walk.places],
        "forward_steps": walk.actions.count(FORWARD),
        "actions": list(walk.actions),
    }


def _routes_of(
    episode: _Episode, sites: Mapping[str, Site], place: str
) -> list[tuple[Site, Route]]:
    name = Path(episode.scene_id).stem
    site = sites.get(name)
    if site is None:
        raise InstructionFileError(
            f"{place}: expected a scene_id that ends in one of the sites "
            f"({', '.join(sorted(sites))}), got {episode.scene_id!r}; give the folder of "
            "its plan with --sites"
        )
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
            f"{place}: expected start and reference_path of a route of {name} ({known}), "
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
