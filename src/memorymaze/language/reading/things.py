"""Names of things and of floors: which words a detector should look for."""

import re
from itertools import takewhile

from memorymaze.language.nouns import singular
from memorymaze.language.plans import Kind
from memorymaze.language.reading.vocabulary import (
    COMMON,
    FILLERS,
    FLOOR_WORDS,
    IDLE_ENDS,
    KINDS_OF_THINGS,
    LOOKS,
    ONES,
    PLAIN,
    PLURALS,
    SIGN_BINDERS,
    SIGNS,
    SURFACES,
    THINGS_IN_ING,
    UNSEEN,
)

ANY_FLOOR = "floor"
"""What to look for to learn whether coverings can be told at all."""

_FLOOR = re.compile(
    r"(?:floors?|flooring|floored|carpet|carpets|carpeting|carpeted|tiles?|tiled"
    r"|lino|linoleum)$"
)
_WAY = re.compile(
    r"(?:halls?|hallways?|paths?|alleys?|aisles?|roads?|streets?|corridors?|areas?"
    r"|lanes?|passages?|passageways?|walkways?)$"
)
_SURFACE = re.compile(r"^(?:grass|bricks?|gravel|cement|concrete|carpet)$")
_PICTURED = re.compile(
    r"^(?:monarch )?(butterfl\w+|butterlfy|fish\w*|(?:eiffel )?towers?)$"
)
_PICTURES = {
    "b": "picture of a butterfly",
    "f": "picture of a fish",
    "t": "picture of a tower",
}
_MOST = 12
"""Numbers up to this one are put in digits in names: `gate seven`."""
_LANES = re.compile(
    r"\b(?:corridor|hallway|passage|passageway|walkway|way|street|path|lane|road|aisle"
    r"|alley|row)$"
)


_IDLE_NAME = re.compile(
    r"(?:lost (?:and found|property)|left luggage|way out"
    r"|waiting (?:rooms?|areas?|halls?|lounges?))\b"
)
"""Names made of words that name nothing by themselves."""
_BINDING = re.compile(
    r" (?:of|with|that|for|on|in|saying|marked|called|named|opposite) "
)
_PARTITIVE = re.compile(
    r"^(?:the |an? )?(?:set|pair|row|couple|bunch|bank|line|flight|series|stack|pile"
    r"|group|lot|kind|sort|type|piece)s? of "
)
_LABELLED = re.compile(
    r" (?:(?:marked|labell?ed|saying|reading|named|called)(?: as)?"
    r"|(?:(?:that|which|who) )*(?:says?|reads?|is written)"
    r"|with (?:the )?(?:name|text|words?|letters?|number))(?: the)? (?=\w)"
)
_NUMBERED = re.compile(
    r"(?:(?:professor's|room|office|door|number|numbers) )*\d{3,}\w?"
)
_LOOK = "(?:" + "|".join(sorted(LOOKS)) + ")"
_HANGS = (
    "(?: (?:hanging|hangs|above|over|overhead|up|down|from|on|in|at|there|the|your|you|head"
    "|ceiling|wall|is))*"
)
"""Where a sign is, between it and what it says."""
_SIGN = re.compile(
    rf"(?P<looks>(?:{_LOOK} )+)?(?:signs?(?P<hangs>{_HANGS})(?: (?:that says|of|for|with|to|names"
    rf"|shows))*(?: (?:the )?(?P<says>.+))?|(?!exit )(?P<said>.*(?!{_LOOK})\b\w+) signs?)"
)


def thing_phrase(words: str) -> str:
    """Return the words to look for, or "" when they name nothing a camera finds."""
    tokens = _PARTITIVE.sub("", words).split()
    if _IDLE_NAME.match(words):
        return _as_asked_for(tokens)
    while tokens and _is_idle(tokens[-1]):
        tokens.pop()
    while tokens and tokens[0] in FILLERS - LOOKS and tokens[:2] != ["first", "aid"]:
        tokens.pop(0)
    if not tokens:
        return ""
    if len(tokens) > 1 and ONES.get(tokens[-1], 99) <= _MOST:
        tokens[-1] = str(ONES[tokens[-1]])
    content = [
        t for t in tokens if t not in FILLERS and t not in SURFACES and t not in UNSEEN
    ]
    if not any(t not in PLAIN or t in COMMON for t in content):
        return ""
    return _as_asked_for(tokens)


def _as_asked_for(tokens: list[str]) -> str:
    """Name a thing as one asks a camera for it: one of its kind, or what is written.

    >>> _as_asked_for(["red", "sofas"]), _as_asked_for(["kitchen", "sign"])
    ('red sofa', 'sign that says kitchen')
    >>> _as_asked_for(["sign", "over", "your", "head", "says", "terrace"])
    'sign that says terrace'
    """
    phrase = " ".join(tokens)
    phrase = _LABELLED.sub(" that says ", phrase)
    if _NUMBERED.fullmatch(phrase):
        return f"door that says {tokens[-1]}"
    sign = _SIGN.fullmatch(phrase)
    if sign is not None:
        looks, said = sign["looks"] or "", sign["said"] or sign["says"]
        if said:
            return f"{looks}sign that says {said}"
        hangs = "hanging " if "hang" in sign["hangs"] else ""
        return f"{looks}{hangs}sign"
    tokens = phrase.split()
    head = len(_BINDING.split(phrase, maxsplit=1)[0].split()) - 1
    return " ".join([*tokens[:head], _singular(tokens[head]), *tokens[head + 1 :]])


def _singular(noun: str) -> str:
    if noun in PLURALS or not noun.endswith("s") or noun.endswith(("ss", "us", "is")):
        return noun
    if noun.endswith("ies"):
        return singular(noun)
    return noun[: -2 if noun.endswith(("ches", "shes", "sses", "xes")) else -1]


def _is_idle(token: str) -> bool:
    if token in IDLE_ENDS:
        return True
    return token.endswith("ing") and token not in THINGS_IN_ING and len(token) > 5


def kind_of(phrase: str) -> Kind:
    """Return what a thing is, by the words for it.

    >>> kind_of("door that says Radiology"), kind_of("green library sign")
    ('door', 'sign')
    """
    head = _BINDING.split(phrase, maxsplit=1)[0].split()[-1]
    return KINDS_OF_THINGS.get(head, "object")


def is_lane(phrase: str) -> bool:
    """Tell whether a phrase names a way to walk on rather than a thing beside it."""
    return _LANES.search(phrase) is not None


def is_common(phrase: str) -> bool:
    """Tell whether a thing is of a kind that is everywhere and has no name."""
    *before, head = phrase.split()
    return head in COMMON and all(word in PLAIN for word in before)


def place_on_sign(phrase: str) -> str | None:
    """Return what a sign names: `library` for `green library sign`; None for no sign.

    >>> place_on_sign("screen that says cafe"), place_on_sign("board room")
    ('cafe', None)
    """
    words = phrase.split()
    head = [*takewhile(lambda word: word not in SIGN_BINDERS, words)][-1:]
    if not any(word in SIGNS for word in head) and "sign" not in words:
        return None
    rest = [
        w for w in words if w not in SIGNS and w not in PLAIN and w not in SIGN_BINDERS
    ]
    return " ".join(rest)


def floor_phrase(words: str) -> str | None:
    """Return what to look for when words name a way by its floor; None for others.

    >>> floor_phrase("pink-flowered carpet hall")
    'flowered floor'
    >>> floor_phrase("vending machine hall") is None
    True
    """
    tokens = words.replace("-", " ").split()
    if not tokens:
        return None
    named = _FLOOR.search(tokens[-1]) or _WAY.search(tokens[-1])
    if not named and not _SURFACE.match(tokens[-1]):
        return None
    text = " ".join(tokens)
    return next((phrase for look, phrase in FLOOR_WORDS if look.search(text)), None)


def wall_phrase(words: str) -> str | None:
    """Return what to look for when words name a way by pictures on its walls.

    >>> wall_phrase("butterfly hallway")
    'picture of a butterfly'
    """
    tokens = words.replace("-", " ").split()
    named = bool(tokens) and _WAY.search(tokens[-1]) is not None
    while tokens[1:] and tokens[0] in LOOKS:
        del tokens[0]
    if named:
        tokens = tokens[:-1]
    shown = _PICTURED.match(" ".join(tokens))
    return _PICTURES[shown[1].removeprefix("eiffel ")[0]] if shown and named else None


def is_floor(phrase: str) -> bool:
    """Tell whether a phrase to look for is a floor."""
    return phrase == ANY_FLOOR or phrase.endswith(" floor")
