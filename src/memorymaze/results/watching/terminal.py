"""An episode in the terminal: the plan with the robot on it, its step, and the calls.

Solid parts of the plan are half blocks, so that a cell shows two; everything that
matters has a character of its own and is told by it also without colours.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import groupby
from operator import itemgetter
from types import TracebackType
from typing import NamedTuple, TextIO

from rich.console import Console, ConsoleOptions, RenderResult
from rich.layout import Layout
from rich.live import Live
from rich.panel import Panel
from rich.segment import Segment
from rich.style import Style
from rich.text import Text
from shapely import LineString, get_coordinates, segmentize

from memorymaze.drawing.cells import CellMap, Extent, cell_map, plan_extent
from memorymaze.passers_by import Briefing
from memorymaze.results.story.events import Event
from memorymaze.results.story.understanding import CurrentStep
from memorymaze.results.watching.keyboard import type_answer
from memorymaze.results.watching.onlooker import Present
from memorymaze.sites import Route, Site

PERIOD = 1 / 12
TALLEST = 48
"""Rows used of a tall terminal."""
STEP_ROWS = 5
EVENT_STYLES = {"say": "bold", "stop": "bold", "touch": "bold red", "turn": "bold"}
AROUND = 8.0
"""Metres shown round the way described."""


class Signs(NamedTuple):
    """Characters of a map."""

    blocks: tuple[str, str, str, str]
    """Nothing solid, the upper half, the lower half, both."""
    arrows: str
    """The robot, facing east and on, counter-clockwise in eighths of a turn."""
    walked: str
    way: str
    start: str = "S"
    goal: str = "G"
    person: str = "o"
    thing: str = "x"
    asked: str = "+"


UNICODE = Signs((" ", "▀", "▄", "█"), "→↗↑↖←↙↓↘", "•", "·")
ASCII = Signs((" ", "#", "#", "#"), ">/^\\</v\\", "*", ".")
STYLES = {
    name: Style.parse(words)
    for name, words in {
        "solid": "grey42",
        "way": "bold red",
        "walked": "bold cyan",
        "ends": "bold white on red",
        "person": "bold magenta",
        "thing": "bold yellow",
        "asked": "bold green",
        "robot": "bold black on bright_yellow",
    }.items()
}


class TerminalMap:
    """Draws one episode's plan at any size."""

    def __init__(self, site: Site, route: Route, signs: Signs = UNICODE) -> None:
        """Stand for a plan."""
        self._site, self._signs = site, signs
        west, south, east, north = route.line.bounds
        self._extent = Extent(
            west - AROUND, south - AROUND, east + AROUND, north + AROUND
        )
        self._way = route.line
        self.asked: Sequence[tuple[float, float]] = ()
        """A way that a passer-by is asked for, metres; empty while none is."""
        self._cells: CellMap | None = None
        self._size = (0, 0)

    def draw(self, present: Present, columns: int, rows: int) -> list[list[Segment]]:
        """Draw how things stand in some columns and rows, at least one of each.

        A robot that leaves the part shown makes the whole plan be shown, and so does a
        way asked for that does.
        """
        places = (present.pose[:2], *self.asked)
        if not all(self._extent.holds(*place) for place in places):
            self._extent, self._cells = plan_extent(self._site), None
        if self._cells is None or self._size != (columns, rows):
            self._size = (columns, rows)
            self._cells = cell_map(self._site, self._extent, columns, rows)
        marks = dict(self._marks(self._cells, present))
        solid = self._cells.solid
        numbers = (solid[::2] + 2 * solid[1::2]).tolist()
        blocks = self._signs.blocks
        lines: list[list[Segment]] = []
        for row, cells in enumerate(numbers):
            line: list[Segment] = []
            signed = (
                marks.get((row, column), (blocks[number], "solid"))
                for column, number in enumerate(cells)
            )
            # Terminals are slow where every character has a style of its own.
            for style, group in groupby(signed, key=itemgetter(1)):
                text = "".join(sign for sign, _ in group)
                line.append(Segment(text, STYLES[style]))
            lines.append(line)
        return lines

    def legend(self) -> str:
        """Say what the characters mean."""
        signs = self._signs
        asked = f"  {signs.asked} way asked for" if self.asked else ""
        return (
            f"{signs.arrows[0]} robot  {signs.walked} driven  {signs.way} way described  "
            f"{signs.start} start  {signs.goal} goal  {signs.person} person  "
            f"{signs.thing} thing in the way{asked}"
        )

    def _marks(
        self, cells: CellMap, present: Present
    ) -> Iterator[tuple[tuple[int, int], tuple[str, str]]]:
        """Return sign and name of its style by cell; later ones lie on top."""
        signs = self._signs
        for x, y in get_coordinates(segmentize(self._way, cells.metres)).tolist():
            yield cells.cell(x, y), (signs.way, "way")
        for place in present.path:
            yield cells.cell(*place), (signs.walked, "walked")
        if self.asked:
            line = LineString(self.asked)
            for x, y in get_coordinates(segmentize(line, cells.metres)).tolist():
                yield cells.cell(x, y), (signs.asked, "asked")
        ends = get_coordinates(self._way)[[0, -1]].tolist()
        for (x, y), sign in zip(ends, (signs.start, signs.goal), strict=True):
            yield cells.cell(x, y), (sign, "ends")
        for pose in present.things.values():
            yield cells.cell(pose.x, pose.y), (signs.thing, "thing")
        for pose in present.people.values():
            yield cells.cell(pose.x, pose.y), (signs.person, "person")
        eighth = round(present.pose.heading / (math.pi / 4)) % 8
        robot = signs.arrows[eighth]
        yield cells.cell(present.pose.x, present.pose.y), (robot, "robot")


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
        """Prepare a view on a console; that of stderr when None."""
        self._console = console or Console(stderr=True)
        utf8 = self._console.encoding.lower().replace("-", "").startswith("utf")
        self._map = TerminalMap(site, route, UNICODE if utf8 else ASCII)
        self._instruction, self._title = instruction, title
        self._live = self._new_live()
        self._shown: Present | None = None

    def _new_live(self) -> Live:
        return Live(console=self._console, auto_refresh=False, vertical_overflow="crop")

    def show(self, present: Present) -> None:
        """Redraw the terminal."""
        self._shown = present
        self._live.update(self.page(present), refresh=True)

    def answer(self, briefing: Briefing) -> str:
        """Leave a picture with the way asked for, and have an answer typed beneath it."""
        self._map.asked = briefing.way
        try:
            if self._shown is not None:
                self.show(self._shown)
            self._live.stop()
            return type_answer(briefing)
        finally:
            self._map.asked = ()
            # One that goes on would draw over the dialogue.
            self._live = self._new_live()
            self._live.start()

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


class PlainView:
    """Prints every event once, and every new step."""

    period = 0.2

    def __init__(self, stream: TextIO) -> None:
        """Print to a stream."""
        self._stream = stream
        self._step: CurrentStep | None = None

    def show(self, present: Present) -> None:
        """Print what is new."""
        for event in present.fresh:
            self._say(f"{event.time:7.1f} s  {event.text}")
        if present.step != self._step and present.step.heading:
            self._step = step = present.step
            line = step.lines[step.current or 0] if step.lines else ""
            self._say(f"{present.time:7.1f} s  {step.heading}: {line}")

    def finish(self, words: str) -> None:
        """Leave it to the command line, which says how it ended."""

    def _say(self, text: str) -> None:
        print(" ".join(text.splitlines()), file=self._stream, flush=True)
