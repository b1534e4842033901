from collections.abc import Callable
from pathlib import Path

from memorymaze.runs.episodes.in_words import crash_lines
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.trace import trace_content
from memorymaze.runs.episodes.trace_entries import EndEntry, NoteEntry
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder, read_run


def test_a_run_says_of_what_its_agent_crashed_and_where_it_is_written(
    tmp_path: Path,
    record: RunRecord,
    result: Callable[..., EpisodeResult],
) -> None:
    where = ["Traceback (most recent call last):", '  File "own.py", line 7, in follow']
    trace = trace_content([NoteEntry(1.0, "traceback", {"lines": where})])
    error = "ValueError: no way (own.py, line 7)"
    with open_run_folder(tmp_path, record, resume=False) as run:
        for name in ("a-1", "b-1"):
            run.add(result(name, stopped_by="crash", error=error), trace)
        run.add(
            result("c-1", stopped_by="crash", error="WorkerLost: killed"),
            trace_content([EndEntry(1.0, "crash", None)]),
        )
        run.add(result("d-1"), trace_content([EndEntry(1.0, "crash", None)]))
    results = read_run(tmp_path)[1]
    first, file, last = crash_lines(tmp_path, results)
    assert first == f"crash in 2 episodes: {error}"
    assert str(tmp_path / "traces/a-1.jsonl.gz") in file
    assert last == "crash in 1 episode: WorkerLost: killed"
    assert [f"  {line}" for line in where] == crash_lines(
        tmp_path, results, whole=True
    )[1:3]
