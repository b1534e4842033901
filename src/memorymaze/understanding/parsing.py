"""Parsing a whole route description."""

from memorymaze.routes.plan import RoutePlan
from memorymaze.understanding.assembly import assemble
from memorymaze.understanding.chunks import Chunk, cut, normalise
from memorymaze.understanding.corrections import apply_corrections
from memorymaze.understanding.destinations import find_destinations
from memorymaze.understanding.drafts import arrival_of, leg_of
from memorymaze.understanding.events import Event
from memorymaze.understanding.reading import read_clauses, split_clauses
from memorymaze.understanding.summaries import without_overviews


def parse_route_description(text: str) -> RoutePlan:
    """Return the plan that an English route description gives."""
    words = normalise(text)
    chunks = apply_corrections(cut(words))
    events = without_overviews(_sentences(split_clauses(chunks), words))
    drafts = assemble(events)
    legs = tuple(leg_of(draft) for draft in drafts[:-1])
    destinations, side, nth = find_destinations(drafts[-1], drafts[:-1], chunks, words)
    return RoutePlan(legs, arrival_of(drafts[-1], destinations, side, nth))


def _sentences(clauses: list[list[Chunk]], text: str) -> list[tuple[str, list[Event]]]:
    """Read all clauses; return the words and events of each sentence."""
    sentences: list[tuple[str, list[Event]]] = []
    sentence: list[list[Chunk]] = []
    before: list[Event] = []
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
