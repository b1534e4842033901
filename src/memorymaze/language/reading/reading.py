"""From a text to a plan: sentences into clauses, clauses into events, events into legs."""

import re
from collections.abc import Sequence
from dataclasses import replace

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading.assembly import assemble
from memorymaze.language.reading.chunks import Chunk, cut, normalise
from memorymaze.language.reading.clause import Clause, ClauseEvent
from memorymaze.language.reading.clause_reader import ClauseReader
from memorymaze.language.reading.corrections import apply_corrections
from memorymaze.language.reading.destinations import find_destinations, names_in_title
from memorymaze.language.reading.lengths import read_totals
from memorymaze.language.reading.listed_openings import with_listed_openings
from memorymaze.language.reading.partial_legs import plan_of
from memorymaze.language.reading.proper_names import proper_names
from memorymaze.language.reading.repetitions import without_overviews
from memorymaze.language.reading.things import thing_phrase

_KNOWS_NOT = re.compile(
    r"\b(?:sorry|afraid|apolog\w+|regret|forgive|(?:no|not the|not a|what) (?:\w+ )?(?:idea|clue|notion)"
    r"|(?:know|knowing|tell you|help|sure|say where|not from|new here|stranger|visitor"
    r"|tourist|first (?:day|time)|never heard|isn't on|beats me|ask (?:\w+ )?(?:else|at|the))"
    r"|idk|dunno|clue|lost)\b"
)
"""What people say who cannot tell the way."""
_OPENERS = "TGIXPKOM2AwQEVYsu"
"""Kinds of chunk that begin a new clause after `and`."""
_SPEAKER = frozenset({"i", "i'm", "im", "i've", "ive", "me", "my", "mine"})
"""Words by which people speak of themselves."""


def parse_route_description(text: str) -> RoutePlan:
    """Return the plan that an English route description gives."""
    words, totals = read_totals(normalise(text))
    chunks = with_listed_openings(apply_corrections(cut(words, proper_names(text))))
    sentences = _sentences(split_clauses(chunks), words)
    if names_in_title(chunks, words):
        said, first = sentences[0]
        sentences[0] = (said, _without_title(first))
    events = without_overviews(sentences)
    drafts = assemble(events)
    if len(drafts) == 1 and drafts[0].is_unsaid and _KNOWS_NOT.search(words):
        return RoutePlan()
    destinations, side, nth = find_destinations(drafts[-1], drafts[:-1], chunks, words)
    return replace(plan_of(drafts, destinations, side, nth), totals=totals)


def _without_title(events: Sequence[ClauseEvent]) -> list[ClauseEvent]:
    """`The way to the library: left, …`: what is no more than the destination's name."""
    ways = [n for n, e in enumerate(events) if e.kind not in {"thing", "clause"}]
    title = ways[0] if ways else len(events)
    origin = [each for each in events[:title] if each.relation == "from"]
    return [*origin, *events[title:]]


def _sentences(
    clauses: list[list[Chunk]], text: str
) -> list[tuple[str, list[ClauseEvent]]]:
    """Read all clauses; return the words and events of each sentence."""
    sentences: list[tuple[str, list[ClauseEvent]]] = []
    sentence: list[list[Chunk]] = []
    before: list[ClauseEvent] = []
    start = 0
    for clause in clauses:
        sentence.append(clause)
        if clause[-1].kind == "." or clause is clauses[-1]:
            words = text[start : clause[-1].start]
            start = clause[-1].start
            events = read_clauses(sentence, before)
            before.extend(events)
            sentences.append((words, events))
            sentence = []
    return sentences


def split_clauses(chunks: Sequence[Chunk]) -> list[list[Chunk]]:
    """Cut at punctuation and joints; the joint is the last chunk of its clause.

    "and" is a joint only where something new to do follows.
    """
    clauses: list[list[Chunk]] = [[]]
    for at, chunk in enumerate(chunks):
        if chunk.kind == "f":
            if chunk.text in _SPEAKER:
                clauses[-1].append(replace(chunk, kind="p"))
            continue
        if chunk.kind in ".,>" or (chunk.kind == "&" and _joins(chunks, at)):
            clauses[-1].append(chunk)
            clauses.append([])
        elif chunk.kind != "&":
            if chunk.kind in "TG" and _starts_anew(clauses[-1], chunk):
                clauses[-1].append(Chunk(",", "", chunk.start))
                clauses.append([])
            clauses[-1].append(chunk)
    return [clause for clause in clauses if clause]


def _joins(chunks: Sequence[Chunk], at: int) -> bool:
    """Tell whether an `and` joins clauses; else it joins things."""
    following = at + 1
    while following < len(chunks) and chunks[following].kind in "fhiral":
        following += 1
    if following == len(chunks):
        return False
    if chunks[at].text == "but":
        return True
    kind = chunks[following].kind
    if kind == "L":
        return at == 0 or chunks[at - 1].kind not in "LS"
    if kind == "N":  # "left and the room is on the right"
        rest = "".join(each.kind for each in chunks[following + 1 : following + 3])
        before = "".join(each.kind for each in chunks[max(at - 6, 0) : at])
        return rest.startswith("B") and re.search("L[fha]*$", before) is not None
    it_is = kind == "Z" and chunks[following].text.startswith("it")
    return (
        it_is
        or kind in _OPENERS
        or (kind == "B" and chunks[following].text.startswith(("there", "here", "you")))
    )


def _promises(clauses: Sequence[list[Chunk]]) -> bool:
    """`…, you will find the library`: no more than where it is."""
    kinds = "".join(chunk.kind for clause in clauses for chunk in clause)
    return re.match("r?[hp]*[VR]", kinds) is not None and "o" not in kinds


def _starts_anew(clause: Sequence[Chunk], chunk: Chunk) -> bool:
    """Tell whether a motion verb begins a new clause in unpunctuated text."""
    kinds = "".join(c.kind for c in clause[-40:] if c.kind != "p")
    if not kinds:
        return False
    if chunk.text in {"do", "take", "turn"} and kinds[-1] in "OJ":
        return False
    if chunk.text in {"takes", "brings", "leads", "goes"} and kinds[-1] in "LS":
        return False
    if chunk.text in {"comes", "runs", "leads"} and kinds[-1] in "NJ":
        return False
    if chunk.kind == "G" and kinds[-1] in "LS2" and not re.search("[TGK]", kinds):
        return False
    ended = re.search("[LSMENJHY2]$", kinds)
    return ended is not None and re.search("[TGPKLS2M]", kinds) is not None


def read_clauses(
    clauses: Sequence[list[Chunk]], before: Sequence[ClauseEvent]
) -> list[ClauseEvent]:
    """Return the events of one sentence, with marks between its clauses."""
    events: list[ClauseEvent] = []
    told = list(before[-60:])
    missing = False
    for number, clause in enumerate(clauses):
        joint = clause[-1] if clause[-1].kind in ".,>&" else None
        body = clause[:-1] if joint is not None else clause
        if body and body[0].kind == "r" and _tells_a_turn(body, clauses[number:]):
            missing = False  # "if you go right you meet the stairs, so go left"
        missing = missing or _speaks_of_missing(body, clauses[number:], told)
        if _is_a_question(clause):
            said: list[ClauseEvent] = []
        elif missing:
            kind = "wrong_way" if _turned_wrong(body, clauses[number:]) else "too_far"
            said = [
                ClauseEvent(kind, phrase=phrase)
                for chunk in body
                if chunk.kind == "N" and (phrase := thing_phrase(chunk.text))
            ]
        else:
            said = ClauseReader(body, told).read()
        if number and clauses[number - 1][-1].text in {"because", "since"}:
            said = [event for event in said if event.kind != "turn"]
        asked = joint is not None and joint.text.startswith("?")
        if asked and said and said[-1].called and Clause(body, told).is_first:
            said = []  # "The library? Turn left."
        said.append(_mark(joint))
        events.extend(said)
        told.extend(said)
    return events


def _is_a_question(clause: Sequence[Chunk]) -> bool:
    """`Is that a robot?`: asks, and says nothing of the way."""
    kinds = "".join(chunk.kind for chunk in clause)
    asked = re.fullmatch("[hp]*B[hp]*N[hp]*[.]", kinds) is not None
    return asked and clause[-1].text.startswith("?")


def _commands_a_turn(body: list[Chunk]) -> bool:
    kinds = "".join(chunk.kind for chunk in body)
    return re.search("[TG].*[LS]|^r[hp]*L", kinds) is not None


def _tells_a_turn(body: list[Chunk], rest: Sequence[list[Chunk]]) -> bool:
    """`So go left`, and `so before the chess, left`."""
    bare = any(re.match("[fhp]*L[.,>&]?$", _kinds(clause)) for clause in rest)
    return bare or _commands_a_turn(body)


def _kinds(clause: Sequence[Chunk]) -> str:
    return "".join(chunk.kind for chunk in clause)


def _mark(joint: Chunk | None) -> ClauseEvent:
    if joint is not None and joint.kind == ".":
        return ClauseEvent("sentence", counted=";" in joint.text)
    return ClauseEvent("then" if joint is not None and joint.kind == ">" else "clause")


def _turned_wrong(body: list[Chunk], rest: Sequence[list[Chunk]]) -> bool:
    """Tell `the wrong way` and `if you go right` from `too far`."""
    later = [chunk for clause in rest for chunk in clause]
    missed = [chunk.text for chunk in later if chunk.kind == "o"]
    if missed:
        return any("wrong" in words for words in missed)
    return any(chunk.kind in "LS" for chunk in body)


def _speaks_of_missing(
    body: list[Chunk], rest: Sequence[list[Chunk]], told: Sequence[ClauseEvent]
) -> bool:
    """Tell whether from here the sentence is about having gone wrong.

    `If you go right, …` is as little to be done as `If you reach the toilets you have
    gone too far`, but `If you go right, you will find the library` is, said first.
    """
    kinds = "".join(chunk.kind for chunk in body)
    is_told = re.match("c(?:u|b|[TG].*[LS])", kinds) is not None
    if is_told and Clause(body, told).is_first and _promises(rest[1:]):
        return False
    later = "".join(chunk.kind for clause in rest[:12] for chunk in clause)
    if "o" not in later and not (re.search("[bu]", later) and "c" in later):
        return re.match("[hp]*c", kinds) is not None and _commands_a_turn(body)
    if re.search("[cob]", kinds):
        return True
    if "c" in later:
        return False  # "2347 is on the left, and if you meet a bench, it is too far"
    return re.search("[L2M]", later) is None
