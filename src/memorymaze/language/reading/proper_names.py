"""Names that are written with capitals, such as `Duty Free Shop` or `Flower Stand`.

Their words mean nothing by themselves: nobody is told to stand there.
"""

import re
from functools import lru_cache

from memorymaze.language.reading.vocabulary import FILLERS, LOOKS, PATTERNS

_RUN = re.compile(
    r"(?<![\w'-])[A-Z][a-z]+(?:'s)?(?: (?:(?:and|of|the|&) )*[A-Z][a-z]+(?:'s)?)+(?![\w'-])"
)
_WORD = re.compile(r"[A-Za-z]+")
_BEGINS = re.compile(
    r"(?:\A|[.!?:;\n\"(]|(?:\A|[\s(])\d+[.)]|\b[Ss]tep \d+)[\s\"(\d.)-]*\Z"
)
"""What stands before the first word of a sentence, which has a capital anyhow."""
LOOKED_BACK = 16
"""Letters before a word that are looked at."""
EMPHATIC = 0.3
"""Share of words for ways with capitals from which on capitals tell nothing."""


def proper_names(text: str) -> tuple[str, ...]:
    """Return names of two words and more, in lower case, the longest first."""
    found: set[str] = set()
    rest = text
    for run in _RUN.finditer(text):
        name = run[0].lower().split(" ")
        if _begins(text, run.start()) and _tells_a_way(name[0]):
            name = name[1:]
        while name[0] in {"and", "of", "the", "&"}:
            name = name[1:]
        if len(name) > 1 and not all(map(_tells_a_way, name)):
            found.add(" ".join(name))
            blank = " " * (run.end() - run.start())
            rest = rest[: run.start()] + blank + rest[run.end() :]
    said = [
        word[0][0].isupper()
        for word in _WORD.finditer(rest)
        if _tells_a_way(word[0].lower()) and not _begins(text, word.start())
    ]
    if sum(said) > EMPHATIC * len(said):
        return ()
    return tuple(sorted(found, key=len, reverse=True))


def _begins(text: str, at: int) -> bool:
    before = text[max(at - LOOKED_BACK, 0) : at]
    if at > LOOKED_BACK:
        before = "…" + before
    return _BEGINS.search(before) is not None


@lru_cache(maxsize=4096)
def _tells_a_way(word: str) -> bool:
    """Tell whether a word means something in any description of a way."""
    if word in FILLERS or word in LOOKS:
        return True
    return any(
        (match := pattern.regex.match(word)) and match[0].strip() == word
        for pattern in PATTERNS
    )
