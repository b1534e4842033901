"""The track with obstacles, from plan to tables; and runs made before there was one."""

import json
from collections.abc import Callable
from dataclasses import asdict, replace
from itertools import pairwise
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.runs.episodes.in_words import result_lines
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.results import EpisodeResult, result_from_line
from memorymaze.runs.episodes.settings import RunDefinition, differences
from memorymaze.runs.episodes.summary import summarise
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import PeopleEntry, ThingsEntry
from memorymaze.runs.tables import load_runs, run_tables
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder, read_run

Make = Callable[..., EpisodeResult]
Plan = Callable[..., RunPlan]

BUSY = ObstacleSettings(things_per_100m=10, people=2, seed=5)


def test_the_same_seed_gives_the_same_results_in_other_processes(
    tiny_plan: Plan, tmp_path: Path
) -> None:
    plan = tiny_plan("oracle", limit=4, obstacles=BUSY)

    first = run_plan(plan, tmp_path / "one", workers=1)
    second = run_plan(plan, tmp_path / "two", workers=2)

    assert [replace(each, wall_s=0) for each in first] == [
        replace(each, wall_s=0) for each in second
    ]
    for each in first:
        name = each.episode_id
        traces = [list(read_trace(tmp_path / run, name)) for run in ("one", "two")]
        assert traces[0] == traces[1]
        assert [entry for entry in traces[0] if isinstance(entry, ThingsEntry)]
        [people] = [entry for entry in traces[0] if isinstance(entry, PeopleEntry)]
        times = [place[0] for place in people.walks["person-1"]]
        assert times[0] == 0
        assert all(1 <= b - a < 1.2 for a, b in pairwise(times))
        assert times[-1] > each.duration_s - 1.2
    assert read_run(tmp_path / "one")[0].settings.obstacles == BUSY


def test_results_from_before_there_were_people_are_read(result: Make) -> None:
    line = asdict(result())
    for name in ("person_collisions", "near_misses", "waiting_s"):
        del line[name]

    assert result_from_line(json.dumps(line), "episodes.jsonl:1") == result()


def test_settings_from_before_there_were_obstacles_are_those_without(
    record: RunRecord, result: Make, tmp_path: Path
) -> None:
    with open_run_folder(tmp_path, record, resume=False) as run:
        run.add(result())
    path = tmp_path / "run.json"
    content = json.loads(path.read_text(encoding="utf-8"))
    del content["settings"]["obstacles"]
    path.write_text(json.dumps(content), encoding="utf-8")

    with open_run_folder(tmp_path, record, resume=True) as run:
        assert list(run.finished) == ["a-1"]


def test_a_run_without_obstacles_is_not_taken_up_with_them(
    record: RunRecord, settings: RunDefinition, tmp_path: Path
) -> None:
    with open_run_folder(tmp_path, record, resume=False):
        pass
    busy = replace(settings, obstacles=BUSY)

    assert differences(settings, busy)
    with (
        pytest.raises(RunFolderError, match="obstacles"),
        open_run_folder(tmp_path, replace(record, settings=busy), resume=True),
    ):
        pass


def test_tables_and_summaries_show_the_track_and_how_safe_it_was(
    record: RunRecord, settings: RunDefinition, result: Make, tmp_path: Path
) -> None:
    busy = replace(settings, obstacles=BUSY)
    results = [
        result("a-1", path_length=60.0, near_misses=3, waiting_s=4.0),
        result("b-1", path_length=40.0, collisions=2, person_collisions=1),
    ]
    for name, chosen in (("plain", settings), ("busy", busy)):
        folder = tmp_path / name
        with open_run_folder(
            folder, replace(record, settings=chosen), resume=False
        ) as run:
            for each in results:
                run.add(each)
    runs = load_runs([tmp_path / "plain", tmp_path / "busy"])

    assert [run.label for run in runs] == ["guide", "guide, with obstacles"]
    text = " ".join(run_tables(runs)[0].text().split())
    assert text.count("TRACK WITH OBSTACLES AND PEOPLE") == 1
    assert "10 things per 100 m, 2 people, obstacle seed 5" in text
    assert "2.000 collisions, 1.000 of them with people, 3.00 near misses" in text
    assert "waiting 2.0 s per episode" in text
    csv = run_tables(runs)[0].csv()
    assert ",obstacles,10,1.0,2,5,2.0,1.0,3.0,2.0" in csv.replace("10.0", "10")
    assert ",default," in csv
    assert summarise(results, busy)["track"] == "obstacles"
    assert "3.00 near misses" in "\n".join(result_lines(busy, results))
    plain = "\n".join(result_lines(settings, results))
    assert "near misses" not in plain
