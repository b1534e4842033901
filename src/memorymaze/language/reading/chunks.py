"""Cutting text into chunks: the smallest pieces that mean something on their own.

Kinds of chunk, one letter each so that rules can be patterns over strings of kinds:

`.` sentence end, `,` comma, `&` and/but/or, `>` then, `L` a bare direction, `S` a side
(`on the left`), `2` two turns in one word (`right-left`), `m` both sides, `H` straight,
`O` ordinal, `J` junction noun, `M` length, `n` number, `E` end of the way, `T` turn
verb, `G` go verb, `K` the way bends, `V` see verb, `B` is/there is, `Z` it's/that's,
`A` at/by/when/where, `w` next to, `b` go back, `Q` before/after, `U` until/to, `t` into, `P` past, `I` ignore,
`X` not, `Y` take that one, `D` by itself, `C` sorry/no wait, `c` if, `o` too far,
`s` back to the wall, `u` turn around, `R` you have arrived, `a` again, `l` here, `p` I and my, `r` so, `e` yes, `d` front right, `i` at once, `h` maybe, `f` filler, `N` a thing's name (made of
the content words `W`).
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from memorymaze.language.plans import Length, Way
from memorymaze.language.reading.lengths import (
    LENGTH,
    NUMBER,
    PLACES,
    VAGUE_LENGTH,
    read_length,
    read_number,
    read_places,
    read_vague,
)
from memorymaze.language.reading.spelling import spelt
from memorymaze.language.reading.spoken_numbers import with_plain_numbers
from memorymaze.language.reading.vocabulary import (
    CLOCK,
    FILLERS,
    LOOKS,
    ORDINALS,
    PATTERNS,
    PLAIN_WORDS,
    SPELLINGS,
    Pattern,
)

_LENGTH = re.compile(LENGTH)
_PLACES = re.compile(PLACES)
_VAGUE = re.compile(VAGUE_LENGTH)
_NUMBER = re.compile(NUMBER + r"\b")
_WORD = re.compile(r"[^\W_][\w&+-]*(?:'(?!(?:s|d|ll)\b)\w+)?")
_ADVERB = re.compile(r"[a-z]+(?:ica|ic|i?ous|[ai]b|ful|less|iv|ari|tial|nal)l?ly")
_SPELT = re.compile(r"(?<![\w'-])[a-z']+(?![\w'-])")
_COUNTED = re.compile(
    r"(?:(?<=^)|(?<=[.;!?\n]))\s*(?:and |ok(?:ay)?,? |so,? )?"
    r"(?:\(?(?:\d{1,2}|[a-h](?=\)))[.):]+(?!\d)"
    r"|(?:(?:number|step|point|sign|part|stage)\s+)?"
    r"(?:one|two|three|four|five|six|seven|eight|nine|ten|\d{1,2})\s*[,:.)]"
    r"(?!\s*(?:two|three|four|five|six|seven|eight|nine|ten|\d)\b)"
    r"|(?:first(?:ly)?|second(?:ly)?|third(?:ly)?|fourth(?:ly)?|fifth(?:ly)?|sixth(?:ly)?"
    r"|seventh(?:ly)?|eighth(?:ly)?|ninth(?:ly)?|tenth(?:ly)?|last(?:ly)?|finally)\s*[,:])\s*"
)
_JOINER = re.compile(
    r"(?:of (?:the |a |an )?|that (?:says?|reads?) |which says |saying |marked |labell?ed "
    r"|called |named |with (?:the )?(?:name|text|words?|letters?) |about (?:the )?)"
)

_PROPER_WAY = re.compile(
    r"(?:corridor|hallway|hall|passage|passageway|walkway|way|street|path|lane|road|aisle"
    r"|alley|exit)s?"
)


_LISTED_SIDES = re.compile(
    rf"(?<!take )(?<!make )(?P<openings>\b(?P<count>{NUMBER}) (?:(?!turns?\b|bends?\b|curves?\b|corners?\b)\w+ ){{0,2}}?"
    r"(?:openings?|turnings?|gaps?|corridors?|hallways?|halls?|passages?|ways|roads?|streets?|holes?"
    r"|branches|exits?|junctions?|side \w+)(?: (?!left\b|right\b)[a-z]+){0,3})"
    r"(?P<sides>,? ?[,:(] ?(?:(?:one|two|three|four|\d|a|the|on|to|at|from|and|then|first|second|third"
    r"|side|hand|left|right|,|/)\b[ ,/]*|[,/ ]+)*\b(?:left|right)(?: side| hand)?\)?)(?= *[.,;:!?)]|$)"
)
"""Openings that are counted, and then their sides."""

_ISH = re.compile(rf"\b({'|'.join(sorted(LOOKS))})ish\b")
_SAME_SIDE = re.compile(
    r"\b(?P<bound>(?:on|to|at|from) )?(?:(?:the|that|this|your) (?:very )?)?same (?:side|hand)\b(?! (?:as|of|with)\b)"
    r"|\bon (?:that|this) (?:side|hand)\b(?! of\b)"
)
"""The side that was told last: `on that same side`."""
_SIDE = re.compile(
    r"(?<!all )\b(?:left|right)\b(?! (?:after|there|ahead|at|before|in|away|now|alone|here|up|by|next|past|behind|be)\b)"
)
_HESITATION = re.compile(
    r"(?<!first)(?<!second)(?<!third)(?<!last), *(?:u+h+m*|u+m+|e+r+m?|e+hm*|h+m+)\b *(?:,|\.\.\.)"
)
"""Said with a pause before and after, which are no joints then."""
_DANGLING = re.compile(
    r"\b(to|to the|at|at the|of the|on the|the|your|into|into the|past|past the|by the|an?)"
    r" ?\.{2,}\s+(?=[a-z])"
)
"""A pause in the middle of a phrase: `to the... other side`."""
_DRAWN_OUT = re.compile(r"([a-z])\1{2,}(?=[a-z]*\b)")
"""Letters drawn out: `sooo long`."""
_PLAIN_SIGNS = {
    "\u2019": "'", "\u2018": "'", "`": "'", "\u201c": '"', "\u201d": '"',
    "\u2026": "...", "\u2014": ", ", " \u2013 ": ", ", "\u2013": "-",
    " - ": ", ", "->": " then ", ">": " then ", "@": " at ", "w/": "with ", "\u2192": " then ", "\u00bd": ".5", "\t": " ", "\r": "\n",
}  # fmt: skip
"""Quotes, dashes and arrows, and what is read for them."""


_Direction = Way | Literal["forward"]
"""What a word for a direction can mean; `forward` is no turn."""


@dataclass(frozen=True, slots=True)
class Chunk:
    """One piece of a description."""

    kind: str
    text: str
    start: int
    """Offset in the normalised text."""
    way: _Direction | None = None
    """Direction of `L` and `S`; first direction of `2`."""
    second_turn: Way | None = None
    """Second direction of `2`."""
    number: float | None = None
    """Value of `O` and `n`."""
    or_number: int | None = None
    """Of `O`: the other one of `second or third`."""
    length: Length | None = None
    """Value of `M`."""

    @property
    def turn(self) -> Way | None:
        """Where one turns to by it; None for straight on."""
        return None if self.way == "forward" else self.way


def normalise(text: str) -> str:
    """Return the text in lower case with plain quotes, dashes and list marks."""
    text = spelt(text).lower()
    for old, new in _PLAIN_SIGNS.items():
        text = text.replace(old, new)
    text = _ISH.sub(r"\1", text)
    text = _HESITATION.sub(" ", text)
    text = _DRAWN_OUT.sub(r"\1", _DANGLING.sub(r"\1 ", text))
    text = _SPELT.sub(lambda match: SPELLINGS.get(match[0], match[0]), text)
    text = re.sub(r"\b(left|right)-(\w+)-(left|right)\b(?! hand)", _unless_and, text)
    text = with_plain_numbers(_drop_inline_counting(text))
    text = _LISTED_SIDES.sub(_without_sides, text)
    for row in PLAIN_WORDS:
        text = row.regex.sub(row.work, text)
    return _COUNTED.sub("; ", _with_same_sides(text))


def _with_same_sides(text: str) -> str:
    """Put the side told last for `on that same side`."""

    def side_of(match: re.Match[str]) -> str:
        told = _SIDE.findall(text, 0, match.start())
        return f"{match['bound'] or 'on '}the {told[-1]} side" if told else match[0]

    return _SAME_SIDE.sub(side_of, text)


def _unless_and(match: re.Match[str]) -> str:
    if match[2] in {"and", "then"}:
        return f"{match[1]}-{match[3]}"
    return f"{match[1]}, {match[2]}, {match[3]}"


def _without_sides(match: re.Match[str]) -> str:
    """Take out the sides of openings that were counted: `two gaps, one left, one right`."""
    told = re.findall(
        rf"(?:\b({NUMBER}) (?:\w+ ){{0,2}})?\b(?:left|right)\b", match["sides"]
    )
    named = sum(read_number(count) if count else 1.0 for count in told)
    return match["openings"] if named == read_number(match["count"]) else match[0]


def _drop_inline_counting(text: str) -> str:
    """Turn `1 straight 2 left 3 right` into three sentences."""
    marks: list[re.Match[str]] = []
    for match in re.finditer(
        r"(?<![\w.,-])(\d{1,2})(?=[.):]?\s+[a-z])(?!\s*(?:m|met|step|sec|min|pace|block|feet|ft|yard|o'?clock|or|to|and)\b)(?!\s*(?:met|step|sec|min|pace|block|yard|o'?clock))",
        text,
    ):
        if int(match[1]) == len(marks) + 1:
            marks.append(match)
    if len(marks) < 3 or marks[0].start() > len(text) // 2:
        return text
    for match in reversed(marks):
        rest = re.sub(r"^[.):]", "", text[match.end() :])
        text = text[: match.start()] + "; " + rest
    return text


def cut(text: str, names: Sequence[str] = ()) -> list[Chunk]:
    """Cut a normalised text into chunks; content words become names of things.

    `names` are known ones, in lower case, the longest first.
    """
    return _with_pronouns(_join_names(_join_ordinals(chunks_of(text, names)), text))


def chunks_of(text: str, names: Sequence[str] = ()) -> list[Chunk]:
    """Cut a normalised text into chunks, every content word and name one of its own."""
    named = re.compile(rf"(?:{'|'.join(map(re.escape, names))})(?![\w'-])")
    chunks: list[Chunk] = []
    at = 0
    while at < len(text):
        if text[at] == " ":
            at += 1
            continue
        name = named.match(text, at) if names else None
        chunk = Chunk("W", name[0], at) if name else _chunk_at(text, at)
        if chunk is None:
            at += 1
            continue
        chunks.append(chunk)
        at += max(len(chunk.text), 1)
    return chunks


def _join_ordinals(chunks: list[Chunk]) -> list[Chunk]:
    """Make one chunk of `second or third`."""
    joined: list[Chunk] = []
    for chunk in chunks:
        kinds = "".join(each.kind for each in joined[-2:])
        if chunk.kind == "O" and kinds == "O&" and joined[-1].text == "or":
            joined.pop()
            joined[-1] = replace(joined[-1], or_number=int(chunk.number or 1))
        else:
            joined.append(chunk)
    return joined


def _with_pronouns(chunks: list[Chunk]) -> list[Chunk]:
    """Put the last thing's name for `it` in `face the clock and go to it`."""
    resolved: list[Chunk] = []
    name: Chunk | None = None
    for chunk in chunks:
        before = "".join(each.kind for each in resolved[-3:])
        if chunk.text == "it" and name is not None and re.search("GH?U$", before):
            resolved.append(replace(name, start=chunk.start))
            continue
        if chunk.kind == "N":
            name = chunk
        resolved.append(chunk)
    return resolved


def _chunk_at(text: str, at: int) -> Chunk | None:
    match = _LENGTH.match(text, at)
    if match:
        return Chunk("M", match[0], at, length=read_length(match))
    match = _PLACES.match(text, at)
    if match:
        return Chunk("M", match[0], at, length=read_places(match))
    match = _VAGUE.match(text, at)
    if match:
        return Chunk("M", match[0], at, length=read_vague(match[0]))
    found = claimed_at(text, at)
    if found is not None:
        pattern, words = found
        return _valued(pattern.work, words, at)
    match = _NUMBER.match(text, at)
    if match:
        word = match[0]
        if word in {"a", "an", "some", "half", "one"} or not read_number(word):
            return Chunk("f", word, at)
        return Chunk("n", word, at, number=read_number(word))
    match = _WORD.match(text, at)
    if match:
        idle = match[0] in FILLERS or _ADVERB.fullmatch(match[0])
        kind = "f" if idle else "W"
        return Chunk(kind, match[0], at)
    return None


def claimed_at(text: str, at: int) -> tuple[Pattern, str] | None:
    """Return the first pattern that matches at a place, and the words it claims."""
    for pattern in PATTERNS:
        match = pattern.regex.match(text, at)
        if match and match[0].strip():
            return pattern, match[0]
    return None


def _valued(kind: str, words: str, at: int) -> Chunk:
    chunk = Chunk(kind, words, at)
    if kind == "O":
        ordinal = ORDINALS.get(words.removeprefix("very "))
        if ordinal is None:
            ordinal = read_number(words.split()[-1].strip("#."))
        return replace(chunk, number=float(ordinal))
    if kind == "2":
        first, second = re.findall(r"left|right", words)[:2]
        return replace(chunk, way=first, second_turn=second)
    if kind == "d":
        side, other = ("left", "right") if "left" in words else ("right", "left")
        return replace(chunk, way=side, second_turn=other)
    if kind in {"L", "S"}:
        return replace(chunk, way=_way_of(words))
    if kind == "s" and (side := re.search(r"\b(left|right)\b", words)):
        return replace(chunk, way=_way_of(side[1]))
    return chunk


def _way_of(words: str) -> _Direction | None:
    clock = re.search(r"(\w+) ?o'? ?clock", words)
    if clock:
        way = CLOCK.get(clock[1])
        return None if way == "behind" else way  # type: ignore[return-value]
    side = "left" if "left" in words else "right"
    slanted = re.search(
        r"slight|half|soft|gentl|\bbit\b|little|diagonal|touch|tad\b|shade|smidge|whisker|ish\b"
        r"|keep|stay|bear|veer",
        words,
    )
    if slanted:
        return "slight_left" if side == "left" else "slight_right"
    return side  # type: ignore[return-value]


def _join_names(chunks: list[Chunk], text: str) -> list[Chunk]:
    """Join content words and what binds them into names of things."""
    joined: list[Chunk] = []
    at = 0
    while at < len(chunks):
        chunk = chunks[at]
        looks = chunk.text in LOOKS and [c.kind for c in chunks[at + 1 : at + 2]] == [
            "W"
        ]
        if chunk.kind != "W" and not _is_code(chunk) and not looks:
            joined.append(chunk)
            at += 1
            continue
        last = at
        while True:
            after = last + 1
            if after >= len(chunks):
                break
            following = chunks[after]
            gap = text[chunks[last].start + len(chunks[last].text) : following.start]
            if following.kind in "Wn" and gap in {"", " ", "-", " - ", "' "}:
                last = after
                continue
            if (
                following.kind == "J"
                and gap == " "
                and _PROPER_WAY.fullmatch(following.text)
            ):
                last = after
                continue
            if gap == "'" and following.kind == "W":
                last = after
                continue
            if following.text == "'s" and after + 1 < len(chunks):
                if chunks[after + 1].kind == "W":
                    last = after + 1
                    continue
                break
            bound = _JOINER.match(text, following.start)
            if bound and following.kind in "fAZBw":
                tail = [
                    i
                    for i in range(after, min(after + 5, len(chunks)))
                    if chunks[i].start >= bound.end()
                ]
                if tail and (chunks[tail[0]].kind in "Wn"):
                    last = tail[0]
                    continue
            break
        end = chunks[last].start + len(chunks[last].text)
        joined.append(Chunk("N", text[chunk.start : end], chunk.start))
        at = last + 1
    return joined


def _is_code(chunk: Chunk) -> bool:
    return chunk.kind == "n" and chunk.text.isdigit() and len(chunk.text) >= 3
