"""One frame of a replay: where the pictures and the words stand on it."""

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np
from matplotlib.font_manager import fontManager
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from memorymaze.runs.story.events import Event
from memorymaze.runs.story.understanding import CurrentStep
from memorymaze.world.drawing.axes import OTHER_SCRIPTS, WIDE_FROM
from memorymaze.world.drawing.shapes import ARRIVED_COLOR, FAILED_COLOR

PAPER, INK, GREY, RULE = "#ffffff", "#16181d", "#5a6270", "#c9ced6"
HEAD, HEAD_INK = "#16181d", "#ffffff"
STEP, STEP_INK = "#fff3c4", "#16181d"
NEWS = "#e8eef7"
"""Behind what happened last."""
MARKS = {
    "move": "→",
    "turn": "↻",
    "look": "◉",
    "ask": "?",
    "say": "»",
    "stop": "■",
    "note": "·",
    "model": "≡",
    "touch": "✖",
    "other": "·",
}
"""Before the words of each kind of event."""
FIXED_SPACE = "\u00a0"
LINE = 1.32
"""Heights of letters from one line to the next."""


Font = ImageFont.FreeTypeFont


class _Box(NamedTuple):
    """A part of a frame, pixels."""

    x: int
    y: int
    width: int
    height: int


class _Layout(NamedTuple):
    """Where everything stands on a frame."""

    size: tuple[int, int]
    letter: int
    """Height of letters, pixels."""
    head: _Box
    camera: _Box | None
    plan: _Box
    story: _Box
    """Of instruction and current step."""
    log: _Box


def layout_of(size: tuple[int, int], *, camera: bool) -> _Layout:
    """Lay out frames of a size, with a picture of the robot's camera or without."""
    width, height = size
    letter = max(9, round(min(height / 48, width / 85)))
    top = round(2.2 * letter)
    head = _Box(0, 0, width, top)
    if not camera:
        plan_wide = round(0.6 * width)
        rest = height - top
        told = round(0.46 * rest)
        return _Layout(
            size,
            letter,
            head,
            None,
            _Box(0, top, plan_wide, rest),
            _Box(plan_wide, top, width - plan_wide, told),
            _Box(plan_wide, top + told, width - plan_wide, rest - told),
        )
    seen_high = round(min(0.375 * width, 0.64 * height))
    seen_wide = round(seen_high * 4 / 3)
    below = height - top - seen_high
    return _Layout(
        size,
        letter,
        head,
        _Box(0, top, seen_wide, seen_high),
        _Box(seen_wide, top, width - seen_wide, seen_high),
        _Box(0, top + seen_high, width // 2, below),
        _Box(width // 2, top + seen_high, width - width // 2, below),
    )


class Page:
    """A frame while it is being filled."""

    def __init__(self, layout: _Layout) -> None:
        """Begin with white paper."""
        self._layout = layout
        self._image = Image.new("RGB", layout.size, PAPER)
        self._pen = ImageDraw.Draw(self._image)

    def copy(self) -> "Page":
        """Return another page on which the same stands."""
        other = Page(self._layout)
        other._image.paste(self._image)
        return other

    def picture(self) -> NDArray[np.uint8]:
        """Return the frame: colours, (height, width, 3)."""
        for box in (self._layout.story, self._layout.log):
            self._pen.line((box.x, box.y, box.x + box.width, box.y), RULE)
        for box in (self._layout.plan, self._layout.log):
            if box.x:
                self._pen.line((box.x, box.y, box.x, box.y + box.height), RULE)
        return np.asarray(self._image)

    def put(self, picture: NDArray[np.uint8], box: _Box) -> None:
        """Put a picture of the box's size into it."""
        self._image.paste(Image.fromarray(picture), (box.x, box.y))

    def write_head(self, left: str, right: str) -> None:
        """Write the title line."""
        box, letter = self._layout.head, self._layout.letter
        self._pen.rectangle((0, 0, box.width, box.height - 1), fill=HEAD)
        middle, gap = box.height / 2, letter
        clock = font_for(right, letter, bold=True, mono=True)
        room = box.width - clock.getlength(right) - 3 * gap
        font = font_for(left, letter, bold=True)
        [title] = lines_of(left, font, room, 1)
        self._pen.text((gap, middle), title, HEAD_INK, font, anchor="lm")
        at = (box.width - gap, middle)
        self._pen.text(at, right, HEAD_INK, clock, anchor="rm")

    def write_story(self, instruction: str, label: str, step: CurrentStep) -> None:
        """Write the instruction and what the agent works on."""
        box, letter = self._layout.story, self._layout.letter
        x, wide = box.x + letter, box.width - 2 * letter
        steps: list[tuple[str, bool]] = []
        program = step.heading.startswith("Program")
        for number, line in enumerate(step.lines):
            at_work = step.current is None or number == step.current
            sign = ""
            if len(step.lines) > 1 and step.current is not None:
                sign = "▶ " if number == step.current else FIXED_SPACE * 2
            # Lines are cut at spaces, which must not take the indentation along.
            inner = line.lstrip(" ")
            line = FIXED_SPACE * (len(line) - len(inner)) + inner
            most = 1 if program else 3
            font = font_for(line, letter, mono=program)
            cut = lines_of(f"{sign}{line}", font, wide - letter, most)
            steps += [(piece, at_work) for piece in cut]
        steps = steps[:4]
        row = LINE * letter
        foot = box.y + box.height
        needed = (len(steps) + 1.6) * row if step.heading else 0.0
        top = foot - needed
        y = box.y + 0.5 * letter
        small = font_for(label, max(8, round(0.85 * letter)))
        self._pen.text((x, y), lines_of(label, small, wide, 1)[0], GREY, small)
        y += row
        room = max(1, int((top - y) / row))
        told = font_for(instruction, letter)
        for line in lines_of(f"“{instruction}”", told, wide, room):
            self._pen.text((x, y), line, INK, told)
            y += row
        if not step.heading:
            return
        self._pen.rectangle((box.x, top, box.x + box.width - 1, foot), fill=STEP)
        y = top + 0.3 * row
        bold = font_for(step.heading, letter, bold=True)
        self._pen.text((x, y), step.heading, STEP_INK, bold)
        for line, at_work in steps:
            y += row
            ink = STEP_INK if at_work else GREY
            self._pen.text((x, y), line, ink, font_for(line, letter, mono=program))

    def write_log(self, events: Sequence[Event]) -> None:
        """Write what happened last, the latest at the foot."""
        box, letter = self._layout.log, self._layout.letter
        row = LINE * letter
        x = box.x + letter
        clock = font_for("", letter, mono=True)
        indent = clock.getlength("0000.0 ") + 1.5 * letter
        wide = box.width - 2 * letter - indent
        y = box.y + box.height - 0.6 * letter
        for place, event in enumerate(reversed(events)):
            font = font_for(event.text, letter)
            lines = lines_of(event.text, font, wide, 2)
            y -= row * len(lines)
            if y < box.y + 0.3 * letter:
                break
            if place == 0:
                edge = (box.x + 1, y - 2, box.x + box.width, y + row * len(lines) + 1)
                self._pen.rectangle(edge, fill=NEWS)
            self._pen.text((x, y), f"{event.time:6.1f}", GREY, clock)
            mark = (x + indent - 1.4 * letter, y)
            self._pen.text(mark, MARKS.get(event.kind, "·"), INK, font_for("", letter))
            for number, line in enumerate(lines):
                self._pen.text((x + indent, y + number * row), line, INK, font)

    def write_legend(self, marks: Sequence[tuple[str, str, str]]) -> None:
        """Say at the plan's foot what its marks mean."""
        box, letter = self._layout.plan, max(8, round(0.85 * self._layout.letter))
        x, y = box.x + 0.6 * letter, box.y + box.height - 0.9 * letter
        top = box.y + box.height - 1.8 * letter
        edge = (box.x, top, box.x + box.width, box.y + box.height)
        self._pen.rectangle(edge, fill=PAPER)
        for sign, colour, meaning in marks:
            for text, ink in ((sign, colour), (meaning, GREY)):
                font = font_for(text, letter)
                self._pen.text((x, y), text, ink, font, anchor="lm")
                x += font.getlength(text) + 0.4 * letter
            x += 0.9 * letter

    def write_outcome(self, text: str, *, arrived: bool) -> None:
        """Write how the episode ended, over the camera's picture or the old news."""
        layout, letter = self._layout, round(1.15 * self._layout.letter)
        font = font_for(text, letter, bold=True)
        row = LINE * letter
        box = layout.camera or layout.log
        lines = lines_of(text, font, box.width - 2 * letter, 4)
        high = round(row * len(lines) + 0.9 * letter)
        top = box.y if layout.camera is None else box.y + box.height - high
        back = ARRIVED_COLOR if arrived else FAILED_COLOR
        self._pen.rectangle((box.x, top, box.x + box.width - 1, top + high), fill=back)
        for number, line in enumerate(lines):
            at = (box.x + letter, top + 0.35 * letter + number * row)
            self._pen.text(at, line, HEAD_INK, font)


def font_for(text: str, size: int, *, bold: bool = False, mono: bool = False) -> Font:
    """Return a font for a text; characters that no font has are drawn as boxes."""
    if any(ord(letter) >= WIDE_FROM for letter in text):
        wide = _wide_font()
        if wide is not None:
            return _font(wide, size)
    name = "DejaVuSansMono" if mono else "DejaVuSans"
    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    return _font(str(folder / f"{name}{'-Bold' if bold else ''}.ttf"), size)


def lines_of(text: str, font: Font, width: float, most: int) -> list[str]:
    """Cut a text into lines that fit; what is too much ends in an ellipsis."""
    lines: list[str] = []
    for paragraph in text.splitlines() or [""]:
        line = ""
        for word in paragraph.split(" "):
            longer = f"{line} {word}" if line else word
            if font.getlength(longer) <= width:
                line = longer
                continue
            if line:
                lines.append(line)
            line = word
            while font.getlength(line) > width and len(line) > 1:
                fits = _fitting(line, font, width)
                lines.append(line[:fits])
                line = line[fits:]
        lines.append(line)
        if len(lines) > most:
            break
    if len(lines) > most:
        last = lines[most - 1]
        while last and font.getlength(f"{last}…") > width:
            last = last[:-1]
        lines = [*lines[: most - 1], f"{last}…"]
    return lines


def _fitting(word: str, font: Font, width: float) -> int:
    count = 1
    while count < len(word) and font.getlength(word[: count + 1]) <= width:
        count += 1
    return count


@lru_cache(maxsize=64)
def _font(path: str, size: int) -> Font:
    return ImageFont.truetype(path, size)


@lru_cache(maxsize=1)
def _wide_font() -> str | None:
    installed = {font.name: font.fname for font in fontManager.ttflist}
    return next((installed[name] for name in OTHER_SCRIPTS if name in installed), None)
