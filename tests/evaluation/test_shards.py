import json
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.errors import RunFolderError, SettingsError
from memorymaze.evaluation.driver import run_plan
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import (
    RunRecord,
    open_run_folder,
    read_instructions,
    read_plans,
    read_run,
)
from memorymaze.evaluation.settings import Shard, parse_shard
from memorymaze.evaluation.shards import episodes_of_shard, merge_shards
from memorymaze.evaluation.trace import trace_content, trace_path
from memorymaze.instructions import load_corpus
from memorymaze.instructions.records import Episode
from memorymaze.sites import Site

Plan = Callable[..., RunPlan]
Make = Callable[..., EpisodeResult]

WALKER = """
class Walker:
    name = "walker"

    def follow(self, instruction, robot, journal, rng):
        robot.move_forward(1 + rng.random())
"""


@pytest.fixture(scope="module")
def everything() -> tuple[Episode, ...]:
    """All shipped episodes."""
    return load_corpus().episodes


@given(of=st.integers(1, 40))
def test_shards_are_alike_and_make_the_whole(
    everything: tuple[Episode, ...], of: int
) -> None:
    parts = [episodes_of_shard(everything, Shard(n, of)) for n in range(1, of + 1)]
    assert max(map(len, parts)) - min(map(len, parts)) <= 1
    assert sorted(each.id for part in parts for each in part) == sorted(
        each.id for each in everything
    )
    routes = [
        Counter((e.instruction.site, e.instruction.route) for e in part)
        for part in parts
    ]
    for route in set().union(*routes):
        counts = [count[route] for count in routes]
        assert max(counts) - min(counts) <= 1


def test_no_shard_is_the_whole_run(everything: tuple[Episode, ...]) -> None:
    assert episodes_of_shard(everything, None) == list(everything)


@pytest.mark.parametrize("text", ["0/3", "4/3", "1/0", "2", "a/b", "1/2/3", "-1/2", ""])
def test_what_is_no_shard_is_refused(text: str) -> None:
    with pytest.raises(SettingsError, match="shard"):
        parse_shard(text)


def test_merged_shards_equal_the_run_in_one_piece(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    (tmp_path / "walker.py").write_text(WALKER, encoding="utf-8")
    agent = f"{tmp_path}/walker.py:Walker"
    whole = run_plan(tiny_plan(agent, seed=3), tmp_path / "whole", workers=1)
    for shard in ("1/2", "2/2"):
        plan = tiny_plan(agent, seed=3, shard=shard)
        assert len(run_plan(plan, tmp_path / shard.replace("/", "-"), workers=1)) == 6
    merged = merge_shards([tmp_path / "2-2", tmp_path / "1-2"], tmp_path / "merged")
    assert timeless(merged) == timeless(whole)
    assert timeless(read_run(tmp_path / "merged")[1]) == timeless(whole)
    there, here = (said_of(tmp_path / name) for name in ("whole", "merged"))
    assert here == there
    for folder in ("plans", "traces"):
        assert contents(tmp_path / "merged" / folder) == contents(
            tmp_path / "whole" / folder
        )
    assert (
        read_plans(tmp_path / "merged").keys() == read_plans(tmp_path / "whole").keys()
    )
    assert read_instructions(tmp_path / "merged") == read_instructions(
        tmp_path / "whole"
    )


def timeless(results: list[EpisodeResult]) -> list[EpisodeResult]:
    return [replace(result, wall_s=0.0) for result in results]


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def said_of(folder: Path) -> list[Any]:
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    del record["started"]
    return [record, without_clock(summary)]


def without_clock(value: Any) -> Any:
    if not isinstance(value, Mapping):
        return [without_clock(e) for e in value] if isinstance(value, list) else value
    return {k: without_clock(v) for k, v in value.items() if k != "wall_s"}


@pytest.fixture
def shard_folder(
    tmp_path: Path,
    record: RunRecord,
    result: Make,
    loop_site: Site,
    everything: tuple[Episode, ...],
) -> Callable[..., Path]:
    """Write the folder of a shard with one finished episode."""

    def write(number: int, of: int = 2, episodes: int = 1, **changes: Any) -> Path:
        settings = replace(
            record.settings, shard=Shard(number, of), episodes=episodes, **changes
        )
        folder = tmp_path / f"shard-{len(list(tmp_path.iterdir()))}"
        with open_run_folder(
            folder,
            replace(record, settings=settings),
            resume=False,
            sites=[loop_site],
            instructions=[everything[number].instruction],
        ) as run:
            run.add(result(f"p{number}-1"), trace_content([{"kind": "end"}]))
        return folder

    return write


def test_shards_of_other_settings_are_refused_by_name(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    one, other = shard_folder(1), shard_folder(2, seed=7)
    with pytest.raises(RunFolderError, match="seed: 0 there, 7 here") as caught:
        merge_shards([one, other], tmp_path / "out")
    assert str(other) in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_shards_of_other_code_are_refused(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    one, other = shard_folder(1), shard_folder(2)
    file = other / "run.json"
    text = file.read_text(encoding="utf-8").replace('"56ef"', '"99ff"')
    file.write_text(text, encoding="utf-8")
    with pytest.raises(RunFolderError, match="memorymaze's code"):
        merge_shards([one, other], tmp_path / "out")


def test_missing_and_repeated_shards_are_named(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    one, third = shard_folder(1, of=3), shard_folder(3, of=3)
    with pytest.raises(RunFolderError, match="missing: 2/3"):
        merge_shards([one, third], tmp_path / "out")
    with pytest.raises(RunFolderError, match=r"is shard 1/3, as .* is"):
        merge_shards([one, one, third], tmp_path / "out")


def test_an_unfinished_shard_is_to_be_finished_first(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    one, other = shard_folder(1, episodes=4), shard_folder(2)
    with pytest.raises(
        RunFolderError, match=r"all 4 episodes of shard 1/2, got 1; .*--resume"
    ):
        merge_shards([one, other], tmp_path / "out")


def test_a_trace_that_is_gone_is_named_and_no_run_is_begun(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    one, other = shard_folder(1), shard_folder(2)
    trace_path(other, "p2-1").unlink()
    with pytest.raises(RunFolderError, match="trace of episode 'p2-1'"):
        merge_shards([one, other], tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_whole_run_is_no_shard(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    with open_run_folder(tmp_path / "run", record, resume=False) as run:
        run.add(result("a-1"))
    with pytest.raises(RunFolderError, match="got a whole run"):
        merge_shards([tmp_path / "run"], tmp_path / "out")
