import errno
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.results import EpisodeResult, result_to_line
from memorymaze.runs.work.run_folder import (
    RunRecord,
    open_run_folder,
    read_instructions,
    read_plans,
    read_run,
)
from memorymaze.texts.corpus.corpus import load_instructions
from memorymaze.world.sites import Site

Make = Callable[..., EpisodeResult]


def write(path: Path, record: RunRecord, *results: EpisodeResult) -> None:
    with open_run_folder(path, record, resume=True) as run:
        for one in results:
            run.add(one)


def test_what_was_written_is_read_by_episode_id(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    write(tmp_path / "deep/run", record, result("b-1"), result("a-1"))
    read, results = read_run(tmp_path / "deep/run")
    assert read == record
    assert results == [result("a-1"), result("b-1")]


def test_resuming_knows_what_is_finished(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    write(tmp_path, record, result("a-1"))
    with open_run_folder(tmp_path, record, resume=True) as run:
        assert run.finished == {"a-1": result("a-1")}
        run.add(result("b-1"))
    assert len(read_run(tmp_path)[1]) == 2


def test_a_kill_anywhere_in_the_last_line_loses_at_most_that_line(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    write(tmp_path, record, result("a-1"))
    file = tmp_path / "episodes.jsonl"
    whole = file.read_bytes()
    last = result_to_line(result("b-1", error="左")).encode()
    for cut in [*range(0, len(last), 5), len(last) - 1, len(last)]:
        file.write_bytes(whole + last[:cut])
        assert len(read_run(tmp_path)[1]) == 1 + (cut == len(last))
        with open_run_folder(tmp_path, record, resume=True) as run:
            assert set(run.finished) == (
                {"a-1", "b-1"} if cut == len(last) else {"a-1"}
            )
        kept = file.read_bytes()
        assert kept == whole + (last + b"\n" if cut == len(last) else b"")


def test_zeros_that_a_power_cut_left_at_the_end_are_cut_off(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    write(tmp_path, record, result("a-1"))
    file = tmp_path / "episodes.jsonl"
    whole = file.read_bytes()
    file.write_bytes(whole + b"\0" * 100)
    write(tmp_path, record)
    assert file.read_bytes() == whole


def test_a_damaged_line_in_the_middle_is_named_and_nothing_is_removed(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    write(tmp_path, record, result("a-1"))
    file = tmp_path / "episodes.jsonl"
    damaged = b"nonsense\n" + file.read_bytes()
    file.write_bytes(damaged)
    with pytest.raises(RunFolderError, match=r"episodes\.jsonl:1: expected"):
        write(tmp_path, record)
    assert file.read_bytes() == damaged


def test_an_episode_has_one_result(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    with open_run_folder(tmp_path, record, resume=False) as run:
        run.add(result("a-1"))
        with pytest.raises(RunFolderError, match="'a-1' has a result already"):
            run.add(result("a-1"))
    file = tmp_path / "episodes.jsonl"
    file.write_bytes(file.read_bytes() * 2)
    with pytest.raises(RunFolderError, match=r"jsonl:2: .* second one of 'a-1'"):
        read_run(tmp_path)


def test_a_second_writer_is_kept_out_until_the_first_is_done(
    tmp_path: Path, record: RunRecord
) -> None:
    with (
        open_run_folder(tmp_path, record, resume=False),
        pytest.raises(RunFolderError, match=r"another process \(id \d+\)"),
    ):
        write(tmp_path, record)
    write(tmp_path, record)


def test_a_run_is_not_begun_over_another_one(tmp_path: Path, record: RunRecord) -> None:
    write(tmp_path, record)
    with (
        pytest.raises(RunFolderError, match="holds a run already; add --resume"),
        open_run_folder(tmp_path, record, resume=False),
    ):
        pass


def test_a_folder_with_other_settings_is_not_resumed(
    tmp_path: Path, record: RunRecord
) -> None:
    write(tmp_path, record)
    settings = replace(
        record.settings,
        seed=7,
        agent=replace(record.settings.agent, name="stop"),
        instructions=(replace(record.settings.instructions[0], sha256="99"),),
        time_budget=60.0,
        simulation=replace(record.settings.simulation, time_budget=60.0),
    )
    with pytest.raises(RunFolderError, match="cannot resume") as caught:
        write(tmp_path, replace(record, settings=settings))
    for part in (
        "agent.name: 'guide' there, 'stop' here",
        "instructions[0]: 'some.jsonl 12ab' there, 'some.jsonl 99' here",
        "seed: 0 there, 7 here",
        "simulation.time_budget: 529.0 there, 60.0 here",
    ):
        assert part in str(caught.value)


def test_a_folder_made_by_other_code_is_not_resumed(
    tmp_path: Path, record: RunRecord
) -> None:
    write(tmp_path, record)
    code = replace(record.code, sha256="99", packages={"numpy": "3.0"})
    with pytest.raises(RunFolderError, match="memorymaze's code") as caught:
        write(tmp_path, replace(record, code=code))
    assert "numpy: 2.4 there, 3.0 here" in str(caught.value)


def test_where_replies_are_kept_makes_no_other_run(
    tmp_path: Path, record: RunRecord
) -> None:
    write(tmp_path, record)
    asked = ModelSettings(replay="b", record="c", base_url="d")
    agent = replace(record.settings.agent, language_model=asked)
    write(tmp_path, replace(record, settings=replace(record.settings, agent=agent)))


@pytest.mark.parametrize(
    ("content", "said"),
    [
        pytest.param("{", "cannot be read", id="no json"),
        pytest.param("[" * 99_999, "cannot be read", id="nested"),
        pytest.param("[]", "the whole is wrong", id="list"),
        pytest.param('{"format": 3}', "expected format 2, got 3", id="later format"),
        pytest.param('{"format": 2}', "settings is wrong", id="empty"),
    ],
)
def test_a_damaged_run_json_is_named(
    tmp_path: Path, record: RunRecord, content: str, said: str
) -> None:
    write(tmp_path, record)
    (tmp_path / "run.json").write_text(content, encoding="utf-8")
    with pytest.raises(RunFolderError, match=said) as caught:
        read_run(tmp_path)
    assert str(tmp_path / "run.json") in str(caught.value)


def test_a_settings_value_without_meaning_in_run_json_is_named(
    tmp_path: Path, record: RunRecord
) -> None:
    write(tmp_path, record)
    file = tmp_path / "run.json"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace('"seed": 0', '"seed": -1'), encoding="utf-8")
    with pytest.raises(RunFolderError, match=r"run\.json: .*seed: expected"):
        read_run(tmp_path)


def test_a_folder_that_is_no_run_is_named(tmp_path: Path) -> None:
    with pytest.raises(RunFolderError, match=r"without run\.json"):
        read_run(tmp_path)
    with pytest.raises(RunFolderError, match="no such folder"):
        read_run(tmp_path / "none")
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(RunFolderError, match="got a file"):
        read_run(tmp_path / "file")


def test_results_without_run_json_are_not_written_to(
    tmp_path: Path, record: RunRecord
) -> None:
    (tmp_path / "episodes.jsonl").write_text("", encoding="utf-8")
    with pytest.raises(RunFolderError, match=r"no run\.json"):
        write(tmp_path, record)


def test_what_a_killed_writer_left_unfinished_is_removed(
    tmp_path: Path, record: RunRecord
) -> None:
    write(tmp_path, record)
    left = [tmp_path / "run.json.1.unfinished", tmp_path / "traces/a.1.unfinished"]
    for path in left:
        path.write_bytes(b"half")
    write(tmp_path, record)
    assert not any(path.exists() for path in left)


def test_a_folder_that_cannot_be_made_is_named(
    tmp_path: Path, record: RunRecord
) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(RunFolderError, match="cannot be read or written"):
        write(tmp_path / "file" / "run", record)


def test_a_run_keeps_the_plans_and_instructions_it_was_made_with(
    tmp_path: Path, record: RunRecord, tiny_sites: dict[str, Site]
) -> None:
    told = sorted(load_instructions()[:3], key=lambda each: each.id)
    for resume in (False, True):
        with open_run_folder(
            tmp_path,
            record,
            resume=resume,
            sites=tiny_sites.values(),
            instructions=told,
        ):
            pass
    kept = read_plans(tmp_path)
    assert kept == tiny_sites
    assert Path(kept["loop"].source).is_relative_to(tmp_path)
    assert read_instructions(tmp_path) == told


def test_an_edited_plan_is_named_when_its_run_is_resumed(
    tmp_path: Path, record: RunRecord, loop_site: Site
) -> None:
    with open_run_folder(tmp_path, record, resume=False, sites=[loop_site]):
        pass
    other = replace(loop_site, title="Another loop")
    with (
        pytest.raises(
            RunFolderError, match=r"loop\.geojson\.gz: expected what the run"
        ),
        open_run_folder(tmp_path, record, resume=True, sites=[other]),
    ):
        pass


@pytest.mark.parametrize(
    "damage", [b"", b"no gzip", b"\x1f\x8b\x08\0\0\0\0\0\0\xff\xff"]
)
def test_a_damaged_plan_of_a_run_is_named(
    tmp_path: Path, record: RunRecord, loop_site: Site, damage: bytes
) -> None:
    with open_run_folder(tmp_path, record, resume=False, sites=[loop_site]):
        pass
    (tmp_path / "plans/loop.geojson.gz").write_bytes(damage)
    with pytest.raises(RunFolderError, match=r"loop\.geojson\.gz: the file is damaged"):
        read_plans(tmp_path)


def test_a_run_that_does_not_keep_what_it_was_made_with_is_to_be_run_again(
    tmp_path: Path, record: RunRecord
) -> None:
    write(tmp_path, record)
    with pytest.raises(RunFolderError, match="run it again"):
        read_plans(tmp_path)
    with pytest.raises(RunFolderError, match="run it again"):
        read_instructions(tmp_path)


def test_a_full_disk_names_the_file_and_how_to_go_on(
    tmp_path: Path, record: RunRecord, result: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    with open_run_folder(tmp_path, record, resume=False) as run:
        run.add(result("a-1"), b"trace")

        def refuse(handle: int) -> None:
            raise OSError(errno.ENOSPC, "No space left on device")

        monkeypatch.setattr(os, "fsync", refuse)
        with pytest.raises(RunFolderError, match="--resume") as caught:
            run.add(result("b-1"), b"trace")
        assert str(tmp_path / "traces/b-1.jsonl.gz") in str(caught.value)
        assert "No space left on device" in str(caught.value)
        with pytest.raises(RunFolderError, match=r"summary\.json: .*--resume"):
            run.write_summary({})
    assert [each.episode_id for each in read_run(tmp_path)[1]] == ["a-1"]
    assert not list(tmp_path.rglob("*.unfinished"))
