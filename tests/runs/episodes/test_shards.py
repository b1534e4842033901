from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import memorymaze as mm
from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import Shard, parse_shard
from memorymaze.runs.episodes.shards import episodes_of_shard, part_folder
from memorymaze.runs.episodes.trace import trace_content, trace_path
from memorymaze.runs.episodes.trace_entries import EndEntry
from memorymaze.runs.report import read_sources
from memorymaze.runs.story.recorded_episode import load_episode
from memorymaze.runs.tables import load_runs, run_tables
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import (
    RunRecord,
    open_run_folder,
    read_instructions,
    read_plans,
    read_run,
)
from memorymaze.texts.corpus import Corpus, load_corpus
from memorymaze.texts.corpus.records import Episode
from memorymaze.world.sites import Site

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


def test_a_run_in_parts_is_read_as_the_run_in_one_piece(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    (tmp_path / "walker.py").write_text(WALKER, encoding="utf-8")
    agent = f"{tmp_path}/walker.py:Walker"
    whole = run_plan(tiny_plan(agent, seed=3), tmp_path / "whole", workers=1)
    big = tmp_path / "big"
    for shard in (Shard(2, 2), Shard(1, 2)):
        plan = tiny_plan(agent, seed=3, shard=shard)
        assert len(run_plan(plan, part_folder(big, shard), workers=1)) == 6
    assert sorted(each.name for each in big.iterdir()) == ["part-1-of-2", "part-2-of-2"]
    record, results = read_run(big)
    there, _ = read_run(tmp_path / "whole")
    assert timeless(results) == timeless(whole)
    assert (record.settings, record.code) == (there.settings, there.code)
    assert read_plans(big).keys() == read_plans(tmp_path / "whole").keys()
    assert read_instructions(big) == read_instructions(tmp_path / "whole")
    for result in whole:
        one, other = (
            trace_path(folder, result.episode_id).read_bytes()
            for folder in (tmp_path / "whole", big)
        )
        assert one == other
    texts = [
        str(run_tables(load_runs([tmp_path / each]))[0]).replace(each, "run")
        for each in ("whole", "big")
    ]
    assert texts[0].split() == texts[1].split()
    episode = load_episode(big, whole[0].episode_id)
    assert episode.result == results[0]


def timeless(results: list[EpisodeResult]) -> list[EpisodeResult]:
    return [replace(result, wall_s=0.0) for result in results]


@pytest.fixture
def shard_folder(
    tmp_path: Path,
    record: RunRecord,
    result: Make,
    loop_site: Site,
    everything: tuple[Episode, ...],
) -> Callable[..., Path]:
    """Write the folder of a part of `run` with one finished episode."""

    def write(number: int, of: int = 2, episodes: int = 1, **changes: Any) -> Path:
        settings = replace(
            record.settings, shard=Shard(number, of), episodes=episodes, **changes
        )
        folder = part_folder(tmp_path / "run", Shard(number, of))
        with open_run_folder(
            folder,
            replace(record, settings=settings),
            resume=False,
            sites=[loop_site],
            instructions=[everything[number].instruction],
        ) as run:
            run.add(
                result(f"p{number}-1"), trace_content([EndEntry(1.0, "agent", None)])
            )
        return folder

    return write


def test_parts_of_other_settings_are_refused_by_name(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    shard_folder(1)
    other = shard_folder(2, seed=7)
    with pytest.raises(RunFolderError, match="seed: 0 there, 7 here") as caught:
        read_run(tmp_path / "run")
    assert str(other) in str(caught.value)


def test_parts_of_other_code_are_refused(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    shard_folder(1)
    file = shard_folder(2) / "run.json"
    text = file.read_text(encoding="utf-8").replace('"56ef"', '"99ff"')
    file.write_text(text, encoding="utf-8")
    with pytest.raises(RunFolderError, match="memorymaze's code"):
        read_run(tmp_path / "run")


def test_missing_and_repeated_parts_are_named(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    first = shard_folder(1, of=3)
    shard_folder(3, of=3)
    with pytest.raises(RunFolderError, match=r"part-3-of-3; missing: 2/3"):
        read_run(tmp_path / "run")
    first.rename(tmp_path / "run" / "part-2-of-3")
    shard_folder(1, of=3)
    with pytest.raises(RunFolderError, match=r"is part 1/3, as .* is"):
        read_run(tmp_path / "run")


def test_parts_of_another_number_do_not_belong_together(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    shard_folder(1, of=2)
    shard_folder(2, of=2)
    shard_folder(3, of=3)
    with pytest.raises(RunFolderError, match="expected all 3 parts of the run"):
        read_run(tmp_path / "run")


def test_a_part_that_is_not_finished_lacks_episodes_of_the_run(
    tmp_path: Path, shard_folder: Callable[..., Path]
) -> None:
    shard_folder(1, episodes=4)
    shard_folder(2)
    record, results = read_run(tmp_path / "run")
    assert (record.settings.episodes, len(results)) == (5, 2)


def test_a_whole_run_is_no_part(
    tmp_path: Path,
    record: RunRecord,
    result: Make,
    shard_folder: Callable[..., Path],
) -> None:
    part = shard_folder(1)
    with open_run_folder(part.with_name("part-2-of-2"), record, resume=False) as run:
        run.add(result("a-1"))
    with pytest.raises(RunFolderError, match="got a whole run"):
        read_run(tmp_path / "run")


def test_a_folder_holds_a_whole_run_or_parts_and_stays_as_it_was_when_refused(
    tmp_path: Path, record: RunRecord, shard_folder: Callable[..., Path]
) -> None:
    shard_folder(1)
    other = replace(record, settings=replace(record.settings, shard=Shard(1, 2)))
    with open_run_folder(tmp_path / "whole", record, resume=False):
        pass
    before = sorted(tmp_path.rglob("*"))
    with (
        pytest.raises(RunFolderError, match="holds parts of a run"),
        open_run_folder(tmp_path / "run", record, resume=False),
    ):
        pass
    with (
        pytest.raises(RunFolderError, match="holds a whole run"),
        open_run_folder(tmp_path / "whole" / "part-1-of-2", other, resume=False),
    ):
        pass
    assert sorted(tmp_path.rglob("*")) == before


def test_shards_are_evaluated_into_the_folder_of_the_run(
    tiny_corpus: Corpus, tmp_path: Path
) -> None:
    with pytest.raises(SettingsError, match=r"shard 1/2: name the folder"):
        mm.evaluate("stop", tiny_corpus, shard="1/2", workers=1)
    for shard in ("1/2", "2/2"):
        mm.evaluate(
            "stop", tiny_corpus, shard=shard, limit=4, workers=1, out=tmp_path / "big"
        )
    run = mm.load_run(tmp_path / "big")
    assert (len(run), run.record.settings.shard) == (4, None)


def test_shards_to_which_no_episode_falls_are_parts_of_the_run(
    tiny_corpus: Corpus, tmp_path: Path
) -> None:
    runs = [
        mm.evaluate(
            "stop", tiny_corpus, shard=f"{n}/3", limit=2, workers=1, out=tmp_path
        )
        for n in (1, 2, 3)
    ]
    assert [len(run) for run in runs] == [1, 1, 0]
    assert "stop, 0 episodes" in repr(runs[2])
    assert len(read_sources([tmp_path]).instructions) == 2
