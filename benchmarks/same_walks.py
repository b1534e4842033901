"""Tell whether two run folders hold the same walks: calls, poses and results alike.

For changes that must change nothing: run the same command with the code before and after,
then `python -m benchmarks.same_walks BEFORE AFTER`. It reads the files themselves, so that
either may come from another version of the package. Exit code 1 where they differ.
"""

import gzip
import json
import sys
from pathlib import Path
from typing import Any
from urllib.parse import quote

RESULTS = [
    "success",
    "oracle_success",
    "spd",
    "cls",
    "spl",
    "ndtw",
    "sdtw",
    "path_length",
    "collisions",
    "turns_in_order",
    "duration_s",
    "api_calls",
    "model_calls",
    "tokens",
    "stopped_by",
    "person_collisions",
    "near_misses",
    "waiting_s",
]
"""What is compared of a result: all that a walk determines, and no real time."""


def main(before: str, after: str) -> int:
    """Compare two run folders, episode by episode."""
    old, new = _results(Path(before)), _results(Path(after))
    if old.keys() != new.keys():
        print(f"{len(old.keys() ^ new.keys())} episodes are in one run only")
        return 1
    differing = 0
    for episode in old:
        wrong = [name for name in RESULTS if old[episode][name] != new[episode][name]]
        if _walk(Path(before), episode) != _walk(Path(after), episode):
            wrong.append("calls or poses")
        if wrong:
            differing += 1
            print(f"{episode}: {', '.join(wrong)}")
    print(f"{len(old) - differing} of {len(old)} episodes are the same")
    return int(differing > 0)


def _results(folder: Path) -> dict[str, dict[str, Any]]:
    lines = (folder / "episodes.jsonl").read_text(encoding="utf-8").splitlines()
    return {each["episode_id"]: each for each in map(json.loads, lines)}


def _walk(folder: Path, episode: str) -> list[Any]:
    """Return the calls of an episode with their answers, and its poses."""
    (path,) = (
        each
        for each in (folder / "traces").iterdir()
        if each.name == f"{quote(episode, safe='')}.jsonl.gz"
    )
    with gzip.open(path, "rt", encoding="utf-8") as file:
        entries = [json.loads(line) for line in file]
    return [
        each
        for each in entries
        if each["kind"] in {"call", "trajectory", "collision", "near_miss", "people"}
    ]


if __name__ == "__main__":
    raise SystemExit(main(*sys.argv[1:]))
