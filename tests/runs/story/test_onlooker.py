from collections.abc import Callable
from dataclasses import asdict
from io import StringIO

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.runs.episodes.episode import EpisodeRun, Watcher
from memorymaze.runs.episodes.navigation import navigate
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.episodes.trace_entries import CallEntry
from memorymaze.runs.story.onlooker import Onlooker, PlainView, Present
from memorymaze.world.sites import Site

Walk = Callable[..., EpisodeRun]

TEXT = "Go to the T and turn left."


@pytest.fixture
def walk(t_site: Site) -> Callable[..., EpisodeRun]:
    """Let `guide` follow a text on the T, with someone watching or not."""

    def run(watcher: Watcher | None = None) -> EpisodeRun:
        route = t_site.find_route("R1")
        return navigate(t_site, route, TEXT, AgentSettings("guide"), watcher=watcher)

    return run


class Seen:
    """A view that keeps what it is shown."""

    period = 0.0

    def __init__(self) -> None:
        self.shown: list[Present] = []

    def show(self, present: Present) -> None:
        self.shown.append(present)


class Broken(Seen):
    """A view whose pipe is closed after a while."""

    def show(self, present: Present) -> None:
        super().show(present)
        if len(self.shown) > 3:
            raise BrokenPipeError("nobody looks any more")


class Clock:
    """Time that passes only in sleep."""

    def __init__(self) -> None:
        self.now = 0.0

    def read(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


def told(run: EpisodeRun) -> dict[str, object]:
    """Return all of a result that must not depend on who looks."""
    return {**asdict(run.result), "wall_s": None}


def test_watching_changes_neither_result_nor_trace(walk: Walk) -> None:
    watched = walk(Onlooker(PlainView(StringIO())))
    alone = walk()
    assert told(watched) == told(alone)
    assert watched.trace == alone.trace


def test_a_view_that_breaks_does_not_break_the_walk(walk: Walk) -> None:
    onlooker = Onlooker(Broken())
    watched = walk(onlooker)
    onlooker.end()
    assert isinstance(onlooker.trouble, BrokenPipeError)
    assert told(watched) == told(walk())


@pytest.mark.parametrize("pace", [1.0, 10.0])
def test_a_walk_takes_its_simulated_time_over_the_pace(walk: Walk, pace: float) -> None:
    clock = Clock()
    run = walk(Onlooker(Seen(), pace, clock.read, clock.sleep))
    assert clock.now == pytest.approx(run.result.duration_s / pace, abs=0.2)


def test_every_event_is_told_once_and_the_end_last(walk: Walk) -> None:
    seen = Seen()
    onlooker = Onlooker(seen)
    run = walk(onlooker)
    onlooker.end()
    events = [event for present in seen.shown for event in present.fresh]
    moves = [
        entry
        for entry in run.trace
        if isinstance(entry, CallEntry) and entry.call == "move_forward"
    ]
    assert len([each for each in events if each.kind == "move"]) == len(moves)
    assert [each.time for each in events] == sorted(each.time for each in events)
    assert events[-1].kind == "stop"
    assert seen.shown[-1].distance == pytest.approx(run.result.path_length, abs=0.05)


def test_plain_lines_tell_calls_and_steps(walk: Walk) -> None:
    stream = StringIO()
    onlooker = Onlooker(PlainView(stream))
    walk(onlooker)
    onlooker.end()
    lines = stream.getvalue().splitlines()
    assert any("turn(left)" in line for line in lines)
    assert any("Step 1 of" in line for line in lines)
    assert "stop()" in lines[-1]
    assert "\x1b" not in stream.getvalue()


@pytest.mark.parametrize("pace", [0.0, -1.0, float("nan"), 1e9])
def test_a_pace_without_meaning_is_refused(pace: float) -> None:
    with pytest.raises(SettingsError, match="--pace"):
        Onlooker(Seen(), pace)
