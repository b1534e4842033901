"""Texts that were damaged on their way: wrong encodings, lost and invisible characters."""

import re
import unicodedata

_OUTSIDE_ASCII = re.compile(r"[^\x00-\x7f]+")
_INVISIBLE = re.compile("[\u00ad\u200b-\u200f\u202a-\u202e\u2060-\u2069\ufeff]")
"""Soft hyphens, zero-width characters, and those that turn the direction of writing."""
REPLACEMENT = "\ufffd"


def text_damage(text: str) -> list[str]:
    """Say what in a text cannot be what was written.

    Returns:
        One message per sort of damage: characters that were lost, UTF-8 that was read
        as another encoding, and control characters other than line ends and tabs.
    """
    said: list[str] = []
    lost = text.count(REPLACEMENT)
    if lost:
        said.append(
            f"expected what was written, got {lost} replacement "
            f"{'character' if lost == 1 else 'characters'} (U+FFFD), which stand for "
            "what a wrong encoding lost; take the text from its source again"
        )
    garbled = mojibake(text)
    if garbled is not None:
        wrong, right = garbled
        said.append(
            f"expected {right!r}, got {wrong!r}: UTF-8 that was read as another "
            "encoding; read the source as UTF-8"
        )
    controls = sorted({
        character
        for character in text
        if unicodedata.category(character) == "Cc" and character not in "\n\r\t"
    })
    if controls:
        shown = ", ".join(f"U+{ord(character):04X}" for character in controls)
        said.append(f"expected text, got control characters ({shown}); remove them")
    return said


def mojibake(text: str) -> tuple[str, str] | None:
    """Return the first stretch of UTF-8 that was read as Windows-1252, and what it was.

    >>> mojibake("it\u00e2\u20ac\u2122s on the left")
    ('\u00e2\u20ac\u2122', '\u2019')
    >>> mojibake("caf\u00e9 \u2013 na\u00efve") is None
    True
    """
    for match in _OUTSIDE_ASCII.finditer(text):
        wrong = match.group()
        raw = b"".join(map(_as_windows, wrong))
        try:
            right = raw.decode("utf-8")
        except UnicodeDecodeError:
            continue
        if len(right) < len(wrong):
            return wrong, right
    return None


def _as_windows(character: str) -> bytes:
    """Return the byte that Windows-1252 shows as a character; a bad byte for others."""
    try:
        return character.encode("cp1252")
    except UnicodeEncodeError:
        return (
            character.encode("latin-1", "replace") if ord(character) < 256 else b"\xff"
        )


def invisible_characters(text: str) -> list[str]:
    """Return the invisible characters in a text, such as `U+200B`, each once."""
    return sorted({f"U+{ord(found):04X}" for found in _INVISIBLE.findall(text)})
