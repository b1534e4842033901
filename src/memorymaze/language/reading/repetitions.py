"""What is told twice: overviews, recaps, and turns said again.

An overview tells in short what other sentences tell in full, a recap sums up the last
turns (`so right and left`), and a turn can be said again: `At the desk right. Right at
the desk, yes.`
"""

import re
from collections.abc import Sequence

from memorymaze.language.plans import Way
from memorymaze.language.reading.clause import ClauseEvent
from memorymaze.language.reading.event_order import is_placed, told_since_turn
from memorymaze.language.reading.partial_legs import PartialLeg

_OVERVIEW = re.compile(
    r"\b(?:overall|in short|in brief|basically|in general|generally|big picture|in total"
    r"|altogether|the whole (?:thing|way|walk|route)|the general idea|to sum up|summary"
    r"|the route (?:is|goes)|overview|in a nutshell|the (?:short|quick) version"
    r"|(?:two|three|four|five|six|seven|eight) (?:turns|decisions)"
    r"|think of it|the idea|zig ?zag|the shape|essentially|shortly)\b"
)
_IN_ORDER = re.compile(
    r"\bin (?:the )?(?:(?:right|correct|proper|walking|actual) )?order(?: of walking| you walk it)?"
    r"(?:,? (?:therefore|then|now|so))?,? ?:"
)
_LISTED = 3
"""Bare turns in a row that are a list."""


def without_overviews(
    sentences: list[tuple[str, list[ClauseEvent]]],
) -> list[ClauseEvent]:
    """Return the events of all sentences but overviews.

    An overview has two turns or more that are told again, in order, by the sentences
    after it, or before it when it comes last.
    """
    turns: list[list[Way | None]] = [
        [e.way for e in events if e.kind == "turn"] for _, events in sentences
    ]
    kept: list[ClauseEvent] = []
    for at, (words, events) in enumerate(sentences):
        if _IN_ORDER.search(words) and sum(map(len, turns[at:])) >= _LISTED:
            kept.clear()  # what was told before was told from its end
        if _lists_all(events, turns[at], [*turns[:at], *turns[at + 1 :]]):
            last = max(n for n, each in enumerate(events) if each.kind == "turn")
            kept.extend(events[last + 1 :])
            continue
        others = [way for ways in turns[at + 1 :] for way in ways] if at <= 2 else []
        if at <= 1 and _OVERVIEW.search(words) and len(others) >= 2:
            said = [e for e in events if e.kind == "turn"]
            if not said or (len(said) == 1 and not said[0].commanded):
                continue
            if (
                len(said) >= 4
                and len(others) < len(said)
                and _within(others, turns[at])
            ):
                ending = [e for e in sentences[-1][1] if e.kind != "turn"]
                return [*kept, *events, *ending]
        if at <= 2 and len(turns[at]) >= 2 and _OVERVIEW.search(words):
            if _within(turns[at], others):
                continue
        elif at and re.match(
            r"\W*(?:so,? (?:again|that's|in short|overall)|(?:once )?(?:again|more)[,:])",
            words,
        ):
            before = [way for ways in turns[:at] for way in ways]
            if len(turns[at]) >= 2 and _within(turns[at], before):
                continue
        kept.extend(events)
    return _without_recaps(_without_announcements(kept))


def _lists_all(
    events: Sequence[ClauseEvent],
    listed: Sequence[Way | None],
    others: Sequence[Sequence[Way | None]],
) -> bool:
    """`So left, right, right, left.`: all the turns of the other sentences, and no place.

    The side of the destination may come last, and one or two turns may be left out.
    """
    bare = {"turn", "clause", "sentence", "then", "thing", "recap", "side", "arrive"}
    if len(listed) < _LISTED or any(e.kind not in bare or e.back for e in events):
        return False
    if any(e.ordinal is not None or e.length is not None for e in events):
        return False
    told = [way for ways in others for way in ways]
    if len(told) < _LISTED or len(events) > 3 * len(listed) + 3:
        return False
    return any(
        len(short) >= len(long) - 2 and _within(short, long)
        for ways in (list(listed), list(listed[:-1]))
        for short, long in ((ways, told), (told, ways))
    )


def _without_announcements(events: list[ClauseEvent]) -> list[ClauseEvent]:
    """Drop a pair that the same sentence tells again: `a left-right: left at …`."""
    kept: list[ClauseEvent] = []
    for at in range(len(events)):
        pair = [e for e in events[at : at + 2] if e.kind == "turn"]
        if len(pair) == 2 and pair[1].joined:
            run = _turns_ahead(events, at + 2, whole=True)
            between = {e.kind for e in events[at + 2 : run[0]]} if run else set()
            told = [events[i].way for i in run[:2]]
            same = told == [e.way for e in pair]
            if same and between and not between & {"thing", "end"}:
                kept.append(ClauseEvent("clause"))
                events[at + 1] = ClauseEvent("clause")
                continue
        kept.append(events[at])
    return kept


def _without_recaps(events: list[ClauseEvent]) -> list[ClauseEvent]:
    """Drop turns that only say the last ones again: `so right and left`."""
    kept: list[ClauseEvent] = []
    said: list[ClauseEvent] = []
    fresh, same_sentence = True, False
    dropped: set[int] = set()
    for at, event in enumerate(events):
        if event.kind == "recap" or (event.kind == "turn" and at not in dropped):
            run = _turns_ahead(events, at, whole=event.kind == "recap")
            ways = [events[i].way for i in run]
            if (
                (fresh and (same_sentence or event.kind == "recap"))
                and not (at and events[at - 1].kind == "turn")
                and 2 <= len(ways) <= 3
                and ways == [e.way for e in said[-len(ways) :]]
            ):
                dropped.update(run)
        if at in dropped:
            continue
        if event.kind == "turn":
            said.append(event)
            fresh = same_sentence = True
        elif event.kind == "sentence":
            same_sentence = False
        elif event.kind in {"length", "end", "pass_ways", "way", "junction"}:
            fresh = False
        if event.kind != "recap":
            kept.append(event)
    return kept


def _turns_ahead(events: list[ClauseEvent], start: int, *, whole: bool) -> list[int]:
    """Indices of the turns to the end of the sentence, or of a joined pair."""
    run: list[int] = []
    for at in range(start, len(events)):
        event = events[at]
        if event.kind == "sentence":
            break
        if event.kind == "turn" and event.way is not None:
            run.append(at)
            if not whole and len(run) == 2:
                return run if event.joined else []
        elif not whole:
            return []
    return run if whole else []


def _within(short: Sequence[object], long: Sequence[object]) -> bool:
    """Tell whether the short sequence is the long one with gaps."""
    rest = iter(long)
    return all(any(way == other for other in rest) for way in short)


class Restating:
    """Knows whether the sentence at hand only says the last turn again."""

    def __init__(self, events: Sequence[ClauseEvent]) -> None:
        """Take all events of a description."""
        self._events = events
        self._sentence = False
        """True once a turn of this sentence repeated the last one."""
        self._announced = False
        """True after `again,`: this sentence repeats, whatever was said since."""

    def new_sentence(self) -> None:
        """Take note that a sentence ends."""
        self._sentence = self._announced = False

    def announce(self) -> None:
        """Take note of `again,` at the beginning of a sentence."""
        self._announced = True

    def repeats(
        self,
        at: int,
        way: Way | None,
        ordinal: int | None,
        done: list[PartialLeg],
        draft: PartialLeg,
    ) -> bool:
        """Tell whether a turn only says the last turn again.

        It does when it goes the same way, nothing else was said in between, and
        nothing (`then`, `again`, the next item of a list, a new landmark) says that it
        is a new one.
        """
        event = self._events[at]
        last = done[-1].turn if done else None
        if last is None or last.way != way or event.again or event.at_once:
            return False
        if done == done[:1] and done[0].leaves and is_placed(self._events, at):
            return False  # "to your left, and left at the clock"
        if self._announced:
            return True
        if self._is_elsewhere(at, ordinal, done[-1]):
            return False
        if self._sentence and not draft.lengths and not self._goes_on(at):
            return True
        if not draft.is_new:
            same = ordinal is not None and ordinal == last.ordinal and event.emphatic
            more = draft.mentions or draft.passings or draft.at_end or event.commanded
            return (same and not more) or (
                ordinal in {None, last.ordinal} and _is_at(draft, done[-1])
            )
        if self._says_it_twice(at):
            return True
        if ordinal is not None and last.ordinal is None:
            return False
        if not _is_bare(done[-1]) and self._names_something_new(at, done):
            return False
        if event.forced or event.apposed:
            return not (event.forced and self._goes_on(at))
        return self._follows_directly(
            at, same=ordinal is not None and ordinal == last.ordinal
        )

    def _is_elsewhere(self, at: int, ordinal: int | None, last: PartialLeg) -> bool:
        """`Left at the end, left at the crossing`: told to be at another kind of place."""
        event, turn = self._events[at], last.turn
        said = self._events[at - 1].kind == "sentence" or (
            told_since_turn(self._events, at) is not None
        )  # "right at the end. right at the crossing", "right, the one at the crossing"
        if turn is None or not (event.commanded or said):
            return False
        following = self._events[at + 1 : at + 2]
        if event.nearest or any(each.back and each.nearest for each in following):
            return True  # "take the next left. go left at the next corner"
        placed = any(m.place in {"turn", "beside", "opposite"} for m in last.mentions)
        told = {
            "way": turn.ordinal is not None,
            "end": turn.at_end,
            "junction": turn.junction is not None,
            "thing": placed,
        }
        if not any(told.values()):
            return False
        if ordinal is not None:
            return turn.ordinal != ordinal and not event.emphatic
        for later in self._events[at + 1 :]:
            if not later.back:
                return False
            if later.kind in told:
                return not told[later.kind]
        return False

    def _says_it_twice(self, at: int) -> bool:
        """`Go right, the first right.`: two turns side by side, and no others."""
        event, joint, earlier = (self._events[max(at - n, 0)] for n in range(3))
        if (earlier.kind, joint.kind) != ("turn", "clause") or event.commanded:
            return False
        if event.ordinal is not None and not earlier.commanded:
            return False  # "left, second left"
        told = [each.kind for each in self._events]
        start = at - told[:at][::-1].index("sentence") if "sentence" in told[:at] else 0
        end = told.index("sentence", at) if "sentence" in told[at:] else None
        return told[start:end].count("turn") == 2

    def _goes_on(self, at: int) -> bool:
        """Tell whether `then` stands between a turn and the one before it."""
        for number in range(at - 1, -1, -1):
            if self._events[number].kind in {"then", "turn"}:
                return self._events[number].kind == "then"
        return False

    def _follows_directly(self, at: int, *, same: bool) -> bool:
        event = self._events[at]
        for number in range(at - 1, -1, -1):
            earlier = self._events[number]
            if earlier.kind == "sentence":
                self._sentence = not earlier.counted
                return self._sentence
            if earlier.kind == "then":
                return False
            if earlier.kind == "take":
                return True  # "the second one you take, left"
            if earlier.kind == "turn":
                self._sentence = same or event.commanded or earlier.commanded
                return self._sentence
        return False

    def _names_something_new(self, at: int, done: list[PartialLeg]) -> bool:
        """Tell whether a place is said with the turn that the last legs do not name."""
        known = {
            word
            for draft in done[-2:]
            for mention in draft.mentions
            for word in mention.phrase.split()
        }
        for number in range(at + 1, len(self._events)):
            later = self._events[number]
            if later.kind != "thing":
                return False
            if later.back and not known & set(later.phrase.split()):
                return True
        return False


def _is_bare(draft: PartialLeg) -> bool:
    """Tell whether of a leg only its turn was told."""
    return not (
        draft.lengths
        or draft.mentions
        or draft.passings
        or draft.at_end
        or draft.origin
    )


def _is_at(draft: PartialLeg, last: PartialLeg) -> bool:
    """Tell whether a leg names nothing but things of the turn before it."""
    if draft.lengths or draft.passings or draft.at_end or not draft.mentions:
        return False
    words = {word for each in last.mentions for word in each.phrase.split()}
    return all(set(each.phrase.split()) <= words for each in draft.mentions)
