"""What a run's agent crashed of, told from its results and traces."""

from collections.abc import Iterable
from pathlib import Path

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.trace import read_trace, trace_path
from memorymaze.evaluation.trace_entries import kept_traceback
from memorymaze.wording import counted

CRASHES = 3
"""Kinds of crash that are told of at the end of a run."""


def crash_lines(
    folder: Path, results: Iterable[EpisodeResult], *, whole: bool = False
) -> list[str]:
    """Say of what an agent crashed, where, in how many episodes, most frequent first.

    Tracebacks are shown whole, one of each kind, or by their files.
    """
    crashes: dict[str, list[str]] = {}
    for result in results:
        if result.stopped_by == "crash" and result.error is not None:
            crashes.setdefault(result.error, []).append(result.episode_id)
    lines: list[str] = []
    ordered = sorted(crashes.items(), key=lambda each: -len(each[1]))
    for error, episodes in ordered[:CRASHES]:
        lines.append(f"crash in {counted(len(episodes), 'episode')}: {error}")
        where = kept_traceback(read_trace(folder, episodes[0]))
        if where and whole:
            lines += [f"  {line}" for line in where]
        elif where:
            lines.append(
                f"  traceback in {trace_path(folder, episodes[0])}; shown with "
                "memorymaze --debug"
            )
    if ordered[CRASHES:]:
        lines.append(f"and {counted(len(ordered) - CRASHES, 'further kind')} of crash")
    return lines
