"""Which of the things named is the destination."""

import re
from collections.abc import Iterable, Iterator, Sequence, Set
from itertools import pairwise, takewhile

from memorymaze.language.nouns import is_noun
from memorymaze.language.plans import Mention, Side
from memorymaze.language.reading.chunks import Chunk
from memorymaze.language.reading.partial_legs import PartialLeg
from memorymaze.language.reading.things import (
    floor_phrase,
    is_common,
    is_floor,
    kind_of,
    place_on_sign,
    thing_phrase,
    wall_phrase,
)
from memorymaze.language.reading.vocabulary import COMMON, FILLERS, ORDINALS, PLAIN

_ANNOUNCED = re.compile(
    r"(?:(?:way|route|directions?|looking|trying to (?:get|go)|want(?:s|ed)? to (?:get|go)"
    r"|guide you|take you|bring you|goal|trip)(?: is)? (?:to|for|into) (?:the |a |your )?"
    r"|arriv(?:e|ed|es|ing) (?:at|to|in)? ?(?:the )?"
    r"|(?:destination|goal|target)(?: is|:)? (?:the )?|finish(?:es)? (?:at|in) (?:the )?)$"
)
_DEFINED = re.compile(
    rf"\b(?:destination|goal) (?:is|will be) (?:the |a )?(?:(?:{'|'.join(ORDINALS)}) )?$"
)
_IS_THERE = re.compile(
    r" (?:is|are) (?:also |just |right )?(?:there|near|nearby|close|around|by)(?= *[.,;!]|$)"
)
"""What is said of things at a turn: `room 2107 is there`."""
_ENTERED = re.compile(
    r"(?:that's|that is|this is|it's|there's|here is|here's|there is|then is|you're (?:at|in|on)"
    r"|you are (?:at|in|on|now on)|means|find|reach|see|to|into) (?:the |your |a |now on the )*$"
)
_ASKED = re.compile(r"\s*(?:[?!.]|:(?! *(?:left|right|straight|turn|go)\b))")
_ALONE = re.compile(
    r"(?:(?:oh|ah|hm+|well|okay|ok|um|uh|so|yes|now|to|for)?[ ,.]*)*(?:[a-z]+: *"
    r"|(?:destination|target|goal|objective|routing to|bound for|en route to|off to) )?(?:the |your )?"
)
"""What may stand around the destination when a text begins with it alone."""
_PAUSE = re.compile(
    r"\s*(?:(?:thing|place|bit|please|then|thanks|yeah|yes) *)*[,:.;!?=/(]"
)
_WANTED = re.compile(
    r"\W*(?:(?:right|ok|okay|so|well|now|ah|oh|hi|hello)[,. ]+)*(?:(?:so )?you(?:'re| are)? (?:want(?:ing)?|need|after"
    r"|looking for|seeking|trying to (?:find|reach|get to)|heading (?:for|to)|bound for|off to)"
    r"|(?:this is )?(?:how|the way|your way|the route|route|directions|instructions)(?: to get)?(?: to| for)"
    r"|(?:getting|to get) to|to (?:reach|find)|for) (?:the |your |our |a )?"
)
"""What stands before the destination in a first sentence that only names it."""
_LABEL = re.compile(r"\W*([a-z]+):")
"""`Drop: the library.`: another word for the destination."""
_TELLS_THE_WAY = frozenset("LS2TGKMEOJuUPQHmVRs")
"""Kinds of chunk of a sentence that says more than where one wants to go."""
_TITLED = 2
"""Names in a first sentence that may be no more than the destination's."""
_ASIDE = re.compile(
    r" (?:is|comes|are|was) (?:just )?(?:before|after|opposite|across|first|behind)\b"
)
_ROOM = re.compile(
    r"(?:door (?:(?:of|to) )?)?((?:(?:\w+ )*(?:room|office|lab|hall) )?(?:\d\w*|[a-z]))"
)
"""A room by its number or letter; what its door says."""
_BEHIND_A_DOOR = re.compile(
    r"(?:\w+ )*door (?:of|to|for) (?:the |a )?(.+)|(\w+?)(?:'s(?: \w+)?)? door"
)
_POINTED = re.compile(
    r"[^.?!;]*?\b(?:that|this|it)(?:'s| is| will be) (?:it\b|your\b|the (?:one|place)\b|where you)"
)
"""What is said of the destination just named: `a wooden door, and that is the one`."""
_ON_IT = re.compile(r"[a-z] (?:(?:is|stands|standing|up|waits) ){0,2}on (?:a |the )?$")
_ON = re.compile(
    r" (?:(?:is|stands|standing|up|waits) ){0,2}on (?:a |the )?(?!left|right|your|this|that|both)([a-z]{4,})\b(?! side)"
)
_NEAR = re.compile(
    r"\b(?:near|next to|by|beside|behind|under|opposite|across from|close to|facing|like|after|past|before) (?:a |the |some )?$"
)
_TOO_FAR = re.compile(r" *\? *(?:that's |that is |is |then )*too far\b")
_NUMBER, _LONG_NUMBER = re.compile(r"\d"), re.compile(r"\d{3}")
_TOLD_FIRST = 2
"""Names at the beginning that may be what is asked for: `Professor, 2347.`"""
_NAMED_FIRST, _SAID_AGAIN = 5.0, 4.0
"""Weights of the name that a text begins with, and of what is called nearly so later."""
_UNKNOWN = 1.0
"""Weight less for what ends with a word that names no kind of thing."""
_DENIED = -5.0
"""Weight of what was said to be too far."""
_SURE = 3.0
"""Weight from which on a name is that of the destination, wherever it was said."""
_MAX = 3


def find_destinations(
    last: PartialLeg, drafts: list[PartialLeg], chunks: list[Chunk], text: str
) -> tuple[tuple[str, ...], Side | None, int | None]:
    """Return words for the destination, its side, and which of its kind it is.

    The likeliest words come first. Things named on the last stretch are weighed by how
    they are named: announced as the destination, said to be ahead or on a side, named
    last or more than once.
    """
    scores: dict[str, float] = {}
    sides: dict[str, Side | None] = {}
    named = _weights_in_text(chunks, text)
    entered = [each for each in _candidates(drafts[-1:]) if each[0].place == "target"]
    candidates = _candidates([last]) or (entered if last.entered else [])
    counted = any(length.unit == "places" for length in last.lengths)
    at_a_floor = any(is_floor(m.phrase) and m.place == "turn" for m in last.mentions)
    if counted or at_a_floor:
        # "You see a clock. Go two blocks.": the end is told by the blocks.
        on_the_way = {"along", "passed"}
    else:
        on_the_way = {"passed"} if last.at_end else set[str]()
    met = {c[0].phrase for c in candidates if c[0].place in on_the_way}
    candidates = [c for c in candidates if c[0].place not in on_the_way]
    sure = {name for name, weight in named.items() if weight >= _SURE}
    candidates = _without_flanks(candidates, sure, at_end=last.at_end)
    if not candidates and drafts and last.is_new:
        candidates = [
            each
            for each in _candidates(drafts[-1:])
            if each[0].place in {"target", "along"}
        ]
    asked_for = [name for name, weight in named.items() if weight >= _NAMED_FIRST]
    beyond = {p for each in (*drafts, last) for p in (*each.too_far, *each.wrong_way)}
    passed = {m.phrase for m in last.mentions if m.side == "behind"} | beyond
    passed |= {length.after for length in last.lengths if length.after is not None}
    passed |= set(last.between)
    label = _LABEL.match(text)
    passed |= {label[1]} if label is not None else set()
    passed |= {phrase for phrase, weight in named.items() if weight <= _DENIED}
    for order, (mention, subject) in enumerate(candidates):
        if mention.phrase in passed or mention.ignored or is_floor(mention.phrase):
            continue
        score = _score(mention, subject=subject) + named.get(mention.phrase, 0.0)
        if any(_is_said_of(mention.phrase, name) for name in asked_for):
            score += _SAID_AGAIN
        score += 3.0 * (order + 1) / len(candidates)
        if score > scores.get(mention.phrase, -9.0):
            scores[mention.phrase] = score
            sides[mention.phrase] = mention.side or sides.get(mention.phrase)
    for phrase in list(scores):
        place = place_on_sign(phrase)
        if place is not None:
            score = scores.pop(phrase)
            if place:
                scores[place] = max(scores.get(place, 0.0), score)
    for phrase, weight in named.items():
        if weight >= _SURE and phrase not in passed:
            scores[phrase] = max(scores.get(phrase, 0.0), weight)
    if not scores and not counted:
        is_at_a_place = last.at_end or last.junction is not None or at_a_floor
        before = _named_on_the_way(drafts if is_at_a_place else drafts[:-1])
        before |= met | passed | {draft.origin for draft in (*drafts, last)}
        scores = {
            p: w + text.rfind(p) / len(text)
            for p, w in named.items()
            if p not in before
        }
    if not scores:
        return (), last.side, None
    if not all(map(is_common, scores)):
        scores = {
            p: score - (1.5 if sides.get(p) else 3.0) * is_common(p)
            for p, score in scores.items()
        }
    scores = {p: s - _UNKNOWN * (not _is_a_word(p)) for p, s in scores.items()}
    ranked = sorted(scores, key=lambda phrase: -scores[phrase])
    best = scores[ranked[0]]
    kept = tuple(
        p
        for p in ranked
        if scores[p] >= best - 1.6 and not _is_another_of(p, ranked[0])
    )[:_MAX]
    nth = next((m.nth for m in last.mentions if m.nth and m.phrase in kept), None)
    nth = nth or next((m.nth for m in last.mentions if m.nth), None)
    side: Side | None = sides.get(kept[0]) or last.side
    if side is None:
        side = next(
            (m.side for m in last.mentions if is_common(m.phrase) and m.side), None
        )
    side = side or _side_of_what_it_is_in(kept[0], last.mentions)
    names = [*kept, *_in_full(kept[0], named, text)]
    if all(map(is_common, names)):
        names += _on_signs(drafts[-3:])
    # Any office is not office 2347: where a number is told, only it will do.
    numbered = [name for name in names if _NUMBER.search(name)]
    if (
        numbered[:1] == names[:1]
        or is_common(names[0])
        or any(map(_LONG_NUMBER.search, numbered))
    ):
        return shown_names(numbered or names), side, nth
    return shown_names(names), side, nth


def _is_said_of(name: str, asked: str) -> bool:
    """`Chemistry door`, said later of `chemistry`: not the same name, yet the same thing."""
    shared = set(name.split()) & set(asked.split()) - PLAIN - FILLERS - COMMON
    if _NUMBER.search(asked) and not _NUMBER.search(name):
        return False  # "lab 503" is not any lab
    return bool(shared) and name != asked and not _is_another_of(name, asked)


def _is_a_word(name: str) -> bool:
    """Tell whether the last word of a name is a noun, a number or a letter."""
    last = name.split()[-1]
    return is_noun(last) or len(last) == 1 or _NUMBER.search(last) is not None


def _is_another_of(name: str, best: str) -> bool:
    """`Room 5` beside `room 6`: another of the same kind, and not the same one."""
    words, others = name.split(), best.split()
    numbered = _NUMBER.search(words[-1]) and _NUMBER.search(others[-1])
    return bool(numbered) and words[-1] != others[-1] and words[:-1] == others[:-1]


def _side_of_what_it_is_in(name: str, mentions: Sequence[Mention]) -> Side | None:
    """`Office 2347 in GHI Hall is on the left`: said of both."""
    for mention, following in pairwise(mentions):
        if mention.phrase == name and following.kind == "place":
            return following.side
    return None


def _in_full(name: str, named: Iterable[str], text: str) -> Iterator[str]:
    """Yield fuller names: the robot on a stage, the space station for `the station`."""
    stands = _ON.match(text, text.rfind(name) + len(name))
    if stands is not None and thing_phrase(stands[1]):
        yield f"{name} on a {stands[1]}"
    fuller = (each for each in named if each.endswith(f" {name}"))
    yield from (each for each in fuller if kind_of(each) not in {"sign", "door"})


def _on_signs(drafts: Sequence[PartialLeg]) -> list[str]:
    """Return what the last sign at a turn names: `at the sign Terrace`, then a door."""
    signs = [
        place_on_sign(mention.phrase)
        for draft in drafts
        for mention in draft.mentions
        if mention.kind == "sign" and mention.place == "turn"
    ]
    return [signs[-1]] if signs and signs[-1] else []


def shown_names(names: Sequence[str]) -> tuple[str, ...]:
    """Return what shows each destination, three at most: of a numbered room its door.

    >>> shown_names(("room 6",)), shown_names(("glass door of the library",))
    (('door that says room 6', 'room 6'), ('glass door of the library', 'library'))
    >>> shown_names(("door of lab 502",))
    ('door that says lab 502', 'door of lab 502', 'lab 502')
    """
    shown: list[str] = []
    for name in names:
        numbered = _ROOM.fullmatch(name)
        behind = _BEHIND_A_DOOR.fullmatch(name)
        if numbered is not None:
            shown.append(f"door that says {numbered[1]}")
        if numbered is None or not numbered[1].isdigit():
            shown.append(name)
        if behind is not None and (place := behind[1] or behind[2]) not in PLAIN:
            shown.append(place)
    return tuple(dict.fromkeys(shown))[:_MAX]


def _named_on_the_way(drafts: list[PartialLeg]) -> set[str]:
    """Return what was said to be at turns, to be passed, to be seen or to lie ahead."""
    return {
        phrase
        for draft in drafts
        for phrase in (
            *draft.ahead,
            *draft.behind,
            *(mention.phrase for mention in draft.mentions),
        )
    }


def _candidates(drafts: Sequence[PartialLeg]) -> list[tuple[Mention, bool]]:
    """Return the things of drafts, and whether a clause says where each is."""
    return [
        (mention, number in draft.subjects)
        for draft in drafts
        for number, mention in enumerate(draft.mentions)
    ]


def _without_flanks(
    candidates: list[tuple[Mention, bool]], sure: Set[str], *, at_end: bool
) -> list[tuple[Mention, bool]]:
    """`A suit on the right, the station at the end`: the suit only stands on the way."""
    final = candidates[-1][0] if candidates else None
    if final is None or not (final.side == "ahead" or (at_end and final.side is None)):
        return candidates
    if is_common(final.phrase) or not _is_a_word(final.phrase):
        return candidates
    return [
        (mention, subject)
        for mention, subject in candidates
        if subject or mention.phrase in sure or mention.side not in {"left", "right"}
    ]


def _score(mention: Mention, *, subject: bool) -> float:
    score = 0.0
    if mention.side == "ahead":
        score += 1.2
    elif mention.side is not None:
        score += 0.2
    if mention.place in {"turn", "target"}:
        score += 0.6
    if subject:
        score += 0.8
    if mention.place in {"before_turn", "after_turn", "passed", "beside", "opposite"}:
        score -= 1.0
    if mention.kind in {"sound", "smell"}:
        score -= 2.0
    if _NUMBER.search(mention.phrase):
        score += 2.0 if _LONG_NUMBER.search(mention.phrase) else 0.4
    return score


def names_in_title(chunks: Sequence[Chunk], text: str) -> list[Chunk]:
    """Return the names of the destination that a description has for a title.

    `Bakery, easy, I never get lost.`: the first sentence says no more than the goal.
    """
    first = list(takewhile(lambda each: each.kind != ".", chunks))
    kinds = "".join(each.kind for each in first)
    label = re.match("f*N,", kinds)
    if label is not None and first[label.end() - 1].text == ":":
        first = first[label.end() :]  # "drop: the library"
    wanted = next((n for n, each in enumerate(first) if each.kind == "N"), None)
    if (
        wanted is not None
        and _WANTED.fullmatch(text[: first[wanted].start])
        and "".join(each.text for each in first[wanted + 1 :][:1]) in {"", ":"}
    ):
        return [first[wanted]]  # "you want the kitchen."
    if re.fullmatch("f*Af*Nf*Uf*N", kinds) and "from" in {c.text for c in first}:
        return first[-1:]  # "from the lifts to the library"
    name = next((each for each in first if each.kind not in "fhrep,"), None)
    named = sum(each.kind == "N" for each in first)
    if name is None or name.kind != "N" or named > _TITLED:
        return []
    if _TELLS_THE_WAY & {each.kind for each in first}:
        return []
    end = name.start + len(name.text)
    if not _PAUSE.match(text, end):
        return []
    numbered = (c for c in first if c.kind == "N" and _LONG_NUMBER.search(c.text))
    return [name, *(each for each in numbered if each is not name)]


def _weights_in_text(chunks: list[Chunk], text: str) -> dict[str, float]:
    """Weigh every name by the words before it and by how often it is said."""
    weights: dict[str, float] = {}
    opening = _named_first(chunks)
    title = names_in_title(chunks, text)
    after_idle_words = next(
        (each for each in chunks if each.kind not in "fhrep,."), None
    )
    for chunk in chunks:
        if chunk.kind != "N":
            continue
        phrase = thing_phrase(chunk.text)
        if not phrase or floor_phrase(chunk.text) or wall_phrase(chunk.text):
            continue
        before = text[max(0, chunk.start - 40) : chunk.start]
        weight = min(weights.get(phrase, -0.4) + 0.4, 4.0)
        end = chunk.start + len(chunk.text)
        if _ASIDE.match(text, end) or _IS_THERE.match(text, end):
            weight -= 1.5
        is_on_it = _ON_IT.search(before) and not _ENTERED.search(before)
        if _NEAR.search(before) or is_on_it:
            weight -= 1.5
        if _TOO_FAR.match(text, end):
            weight += _DENIED
        pointed = _POINTED.match(text, end)
        if pointed and not any(
            end < c.start < pointed.end() for c in chunks if c.kind == "N"
        ):
            weight += 3.5
        share = chunk.start / max(len(text), 1)
        if _DEFINED.search(before):
            weight += 4.0
        elif chunk.start in opening:
            weight += _NAMED_FIRST
        elif chunk in title or (
            chunk.start < 25
            and _ASKED.match(text, end)
            and (_ALONE.fullmatch(before) or chunk is after_idle_words)
        ):
            weight += 3.0
        elif _ANNOUNCED.search(before):
            weight += 3.0 if share < 0.25 or share > 0.8 else 1.0
        elif share > 0.7 and _ENTERED.search(before):
            weight += 1.0
        weights[phrase] = weight
    return weights


def _named_first(chunks: Sequence[Chunk]) -> set[int]:
    """Return where names stand that a text begins with: `The library, yes. Go …`.

    One name alone is what is asked for. Of several, and in a sentence that goes on, the
    first counts when it is said again at the end, and so does a number of three digits.
    """
    kinds = "".join(chunk.kind for chunk in chunks)
    alone = re.match("[feprh,]*N[NfephrG,]*(?:B[fp]*N[Nfp,]*)?[.]", kinds)
    names = (
        [each for each in chunks[: alone.end()] if each.kind == "N"] if alone else []
    )
    if len(names) == 1:
        return {names[0].start}
    first = re.match("[feprh,]*N(?=f*,)", kinds)
    numbered = len(names) <= _TOLD_FIRST
    names = names[:_TOLD_FIRST]
    if first is not None and not names:
        names = [chunks[first.end() - 1]]
    later = [each for each in chunks if each.kind in "Nn" and each not in names][-3:]
    rooms = {each.start for each in names if _LONG_NUMBER.search(each.text)}
    if rooms and numbered:
        return rooms
    again = {word for each in later for word in each.text.split()}
    return {each.start for each in names if again & set(each.text.split())}
