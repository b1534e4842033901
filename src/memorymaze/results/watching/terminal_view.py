"""An episode in the terminal: the plan, the agent's step, and the calls."""

from types import TracebackType
from typing import NamedTuple

from rich.console import Console, ConsoleOptions, RenderResult
from rich.layout import Layout
from rich.live import Live
from rich.panel import Panel
from rich.segment import Segment
from rich.text import Text

from memorymaze.results.replay.current_step import CurrentStep
from memorymaze.results.report.event_words import Event
from memorymaze.results.watching.present import Present
from memorymaze.results.watching.terminal_map import ASCII, UNICODE, TerminalMap
from memorymaze.sites import Route, Site

PERIOD = 1 / 12
TALLEST = 48
"""Rows used of a tall terminal."""
STEP_ROWS = 5
EVENT_STYLES = {"say": "bold", "stop": "bold", "touch": "bold red", "turn": "bold"}


class TerminalView:
    """Redraws the terminal while an episode goes on; use it in a `with`."""

    period = PERIOD

    def __init__(
        self,
        site: Site,
        route: Route,
        instruction: str,
        title: str,
        console: Console | None = None,
    ) -> None:
        """Prepare a view.

        Args:
            site: Where.
            route: The way that the instruction describes.
            instruction: The text.
            title: Of the page.
            console: Where to draw; stderr when None.
        """
        self._console = console or Console(stderr=True)
        utf8 = self._console.encoding.lower().replace("-", "").startswith("utf")
        self._map = TerminalMap(site, route, UNICODE if utf8 else ASCII)
        self._instruction, self._title = instruction, title
        self._live = Live(
            console=self._console, auto_refresh=False, vertical_overflow="crop"
        )

    def show(self, present: Present) -> None:
        """Redraw the terminal."""
        self._live.update(self.page(present), refresh=True)

    def finish(self, words: str) -> None:
        """Leave it to the command line, which says how it ended."""

    def page(self, present: Present) -> "_Page":
        """Return the whole page, to print or to redraw."""
        width, height = self._console.size
        rows = min(height - 1, TALLEST)
        page = Layout()
        plan = Layout(name="plan", size=max(24, round(0.58 * width)))
        words = Layout(name="words", ratio=1)
        page.split_row(plan, words)
        plan.update(
            Panel(
                _Plan(self._map, present),
                title=Text(self._title),
                title_align="left",
                subtitle=Text(f"{present.time:.1f} s, {present.distance:.1f} m driven"),
                subtitle_align="right",
            )
        )
        words.split_column(
            Layout(_panel(Text(self._instruction), "Instruction"), size=rows // 3),
            Layout(_step_panel(present.step), size=STEP_ROWS),
            Layout(_panel(_Log(tuple(present.events)), "Calls and speech")),
        )
        return _Page(page, rows)

    def __enter__(self) -> "TerminalView":
        """Begin to draw."""
        self._live.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Leave the last picture standing."""
        self._live.stop()


class _Page(NamedTuple):
    layout: Layout
    rows: int

    def __rich_console__(
        self, console: Console, options: ConsoleOptions
    ) -> RenderResult:
        yield from console.render(self.layout, options.update(height=self.rows))


class _Plan(NamedTuple):
    """The map, as large as there is room, and what its characters mean."""

    map: TerminalMap
    present: Present

    def __rich_console__(
        self, console: Console, options: ConsoleOptions
    ) -> RenderResult:
        width, height = options.max_width, options.height or options.max_height
        legend = Text(self.map.legend(), style="dim").wrap(console, width)
        rows = max(1, height - len(legend))
        for line in self.map.draw(self.present, width, rows):
            yield from line
            yield Segment.line()
        yield from legend


class _Log(NamedTuple):
    """As many of the latest events as there is room for, the last one at the foot."""

    events: tuple[Event, ...]

    def __rich_console__(
        self, console: Console, options: ConsoleOptions
    ) -> RenderResult:
        height = options.height or options.max_height
        lines: list[Text] = []
        for event in reversed(self.events):
            style = EVENT_STYLES.get(event.kind, "")
            head = Text().append(f"{event.time:6.1f} {event.kind:<5} ", "dim")
            words = Text(event.text, style=style)
            told = words.wrap(console, max(10, options.max_width - len(head)))[:3]
            indent = Text(" " * len(head))
            lines = [
                (indent if number else head) + line for number, line in enumerate(told)
            ] + lines
            if len(lines) >= height:
                break
        yield from lines[-height:]


def _panel(content: Text | _Log, title: str) -> Panel:
    return Panel(content, title=title, title_align="left")


def _step_panel(step: CurrentStep) -> Panel:
    text = Text()
    for number, line in enumerate(step.lines):
        at_work = step.current is None or number == step.current
        sign = "> " if number == step.current and len(step.lines) > 1 else ""
        text.append(f"{sign}{line}\n", "bold" if at_work else "dim")
    return Panel(text, title=step.heading or "Step", title_align="left")
