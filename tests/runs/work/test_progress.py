import io
from collections.abc import Callable

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.work.progress import Progress

Make = Callable[..., EpisodeResult]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_log_gets_a_plain_line_at_the_end(result: Make) -> None:
    stream = io.StringIO()
    with Progress(total=4, done=2, stream=stream, successes=2) as progress:
        progress.count(result("a-1"))
        progress.count(result("b-1", success=False))
    assert stream.getvalue().startswith("4 of 4 episodes, success 0.75, ")
    assert "left" in stream.getvalue()
    assert "\r" not in stream.getvalue()


def test_a_terminal_gets_a_bar_that_starts_where_the_run_was_left(
    result: Make,
) -> None:
    stream = Terminal()
    with Progress(total=4, done=2, stream=stream, successes=2) as progress:
        progress.count(result("a-1"))
        progress.count(result("b-1"))
    assert "2/4" in stream.getvalue()
    assert "4/4" in stream.getvalue()
    assert "success 1.00" in stream.getvalue()
