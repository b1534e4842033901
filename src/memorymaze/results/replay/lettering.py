"""Letters on pictures: fonts by size, and texts cut into lines that fit."""

from functools import lru_cache
from pathlib import Path

import matplotlib
from matplotlib.font_manager import fontManager
from PIL import ImageFont

Font = ImageFont.FreeTypeFont

WIDE_FROM = 0x2E80
"""Characters from here on are not in the font that comes with matplotlib."""
WIDE_FONTS = (
    "Noto Sans CJK JP",
    "Noto Sans JP",
    "IPAexGothic",
    "IPAGothic",
    "TakaoPGothic",
    "WenQuanYi Zen Hei",
)


def font_for(text: str, size: int, *, bold: bool = False, mono: bool = False) -> Font:
    """Return a font for a text; characters that no font has are drawn as boxes.

    Args:
        text: What is to be written.
        size: Pixels.
        bold: Whether the strokes are heavy.
        mono: Whether all letters are equally wide.
    """
    if any(ord(letter) >= WIDE_FROM for letter in text):
        wide = _wide_font()
        if wide is not None:
            return _font(wide, size)
    name = "DejaVuSansMono" if mono else "DejaVuSans"
    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    return _font(str(folder / f"{name}{'-Bold' if bold else ''}.ttf"), size)


def lines_of(text: str, font: Font, width: float, most: int) -> list[str]:
    """Cut a text into lines that fit; what is too much ends in an ellipsis.

    Args:
        text: Line ends in it are kept.
        font: What it is written in.
        width: Pixels.
        most: Lines, at least 1.
    """
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
    return next((installed[name] for name in WIDE_FONTS if name in installed), None)
