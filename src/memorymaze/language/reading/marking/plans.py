"""From marks to a plan: what is said of each leg is put together."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from memorymaze.language.plans import (
    Arrival,
    Leg,
    Length,
    Mention,
    Passing,
    RoutePlan,
    Start,
    Totals,
    Turn,
)
from memorymaze.language.reading.destinations import shown_names
from memorymaze.language.reading.lengths import combine_lengths
from memorymaze.language.reading.marking.marks import OF_NO_LEG, SAYS_NOTHING, Mark
from memorymaze.language.reading.marking.meanings import (
    length_in,
    ordinal_in,
    passings_in,
    phrase_in,
    totals_in,
    unit_in,
)
from memorymaze.language.reading.things import (
    is_common,
    is_floor,
    kind_of,
    place_on_sign,
)

HEDGED = 0.4
"""Doubt of `I think`."""
NEAR = 24
"""Characters around a bend in which it is told how slight it is."""
A_STOP, ANOTHER_LEG = 40, 40
"""Characters that a stop, and another leg, count for between two marks."""
AFTER = 15
"""Characters that more are between a side and a thing told after it: most are told before."""
_STOP = re.compile(r"[,.;:!?\n]")
_LISTED = re.compile(r",?\s+(?:and |then |and then )?(?:an? |the |some |your )?")
_SENTENCE_END = re.compile(r"[.!?\n]")
_TOWARDS = re.compile(r"\btowards?\b", re.IGNORECASE)
_FROM = re.compile(
    r"\s+(?:(?:\w+\s+)?(?:after|beyond|from|behind)|(?P<past>past))\s+"
    r"(?:(?:the|an?|your|that|those)\s+)?",
    re.IGNORECASE,
)
_SLIGHT = re.compile(r"\b(?:slight|gentl|bit\b|little|soft)", re.IGNORECASE)
_WALKS = re.compile(
    r"\b(?:walk|straight|along|down|until|till|continue|keep|ahead|forward|follow|pass"
    r"|reach|after|past|end|through|across|hallway|corridor|opening|next|soon|then)",
    re.IGNORECASE,
)
"""What says that one walks before a turn."""
_PLACES = {"before": "before_turn", "after": "after_turn"}
_ELSEWHERE = frozenset({"passed", "before"})
"""Places of things that are not where one arrives."""

_Owner = tuple[Mark, dict[str, Any]]
"""A mark, and where a side, a number or a doubt said beside it belongs."""


@dataclass
class _Part:
    """What is said of one leg, or of the last stretch."""

    turn: dict[str, Any] = field(default_factory=dict[str, Any])
    unclear: float = 0.0
    lengths: list[Length] = field(default_factory=list[Length])
    length: dict[str, Any] = field(default_factory=dict[str, Any])
    """Said of its length."""
    mentions: list[dict[str, Any]] = field(default_factory=list[dict[str, Any]])
    passings: list[tuple[Passing, dict[str, Any]]] = field(
        default_factory=list[tuple[Passing, dict[str, Any]]]
    )
    too_far: list[str] = field(default_factory=list[str])
    wrong_way: list[str] = field(default_factory=list[str])

    @property
    def fields(self) -> dict[str, Any]:
        """What a leg and an arrival have in common."""
        length = combine_lengths(self.lengths)
        return {
            "length": replace(length, **self.length) if length is not None else None,
            "mentions": tuple(Mention(**each) for each in self.mentions),
            "passings": tuple(replace(each, **more) for each, more in self.passings),
            "too_far": tuple(self.too_far),
            "wrong_way": tuple(self.wrong_way),
            "unclear": self.unclear,
        }

    @property
    def is_new(self) -> bool:
        """Whether nothing was said of its way yet."""
        return not (self.mentions or self.lengths or self.passings)

    @property
    def is_bare(self) -> bool:
        """Whether nothing says where along the way its turn is."""
        where = ("ordinal", "at_end", "junction", "forced")
        placed = any(
            each["place"] not in {"target", "after_turn"} for each in self.mentions
        )
        told = any(self.turn.get(each) for each in where)
        return not (self.lengths or self.passings or placed or told)


def plan_of_marks(text: str, marks: Sequence[Mark]) -> RoutePlan:
    """Return the plan that the marks of a text make, in the order of the walk."""
    return _MarkedLegs(text, marks).plan()


class _MarkedLegs:
    """Puts together what is said of each leg."""

    def __init__(self, text: str, marks: Sequence[Mark]) -> None:
        self._text = text
        self._all = marks
        self._marks = [each for each in marks if each.label not in SAYS_NOTHING]
        ends = sorted({each.leg for each in self._marks if each.is_turn})
        self._parts = [_Part() for _ in range(len(ends) + 1)]
        self._number = {leg: number for number, leg in enumerate(ends)}
        self._said: list[_Owner] = []
        self._things: list[_Owner] = []
        self._arrival: dict[str, Any] = {}
        self._names: list[str] = []
        self._start: dict[str, str] = {}
        self._totals = Totals()
        self._unit = "metres"

    def plan(self) -> RoutePlan:
        for mark in self._marks:
            if mark.label == "length":
                self._unit = unit_in(self._words(mark)) or self._unit
        for mark in self._marks:
            self._place(mark)
        self._things += self._said_again()
        for mark in self._marks:
            self._relate(mark)
        for part in self._parts:
            if any(
                m["kind"] == "floor" and m["place"] == "turn" for m in part.mentions
            ):
                # Where floors meet, as in a corner: no word of how many ways there are.
                part.turn.pop("junction", None)
        last = self._parts[-1]
        arrival: dict[str, Any] = {
            "nth": last.turn.get("ordinal"),
            "at_end": last.turn.get("at_end", False),
            **last.fields,
            **self._arrival,
        }
        return RoutePlan(
            Start(**self._start),
            tuple(
                Leg(Turn(**part.turn), self._is_on_the_spot(number), **part.fields)
                for number, part in enumerate(self._parts[:-1])
            ),
            Arrival(self._destinations(), **arrival),
            self._totals,
        )

    def _said_again(self) -> Iterator[_Owner]:
        """Yield names said again, whose side or number is said only there."""
        for mark in self._all:
            if mark.label != "again":
                continue
            if phrase_in(self._words(mark), is_goal=True) in self._names:
                yield mark, self._arrival

    def _words(self, mark: Mark) -> str:
        return self._text[mark.start : mark.end]

    def _is_on_the_spot(self, number: int) -> bool:
        """Tell whether nothing is walked before a turn: `Out of the lifts turn left`."""
        part = self._parts[number]
        if part.turn["way"] == "around":
            return True
        if number or not part.is_bare:
            return False
        turn = next(m for m in self._marks if m.is_turn and self._number[m.leg] == 0)
        sentence = _SENTENCE_END.split(self._text[: turn.start])[-1]
        return _WALKS.search(sentence) is None

    def _destinations(self) -> tuple[str, ...]:
        """Return what shows the destination, what tells it from other things first."""
        names = sorted(self._names, key=is_common)
        if not names:
            return ()
        if all(map(is_common, names)):
            signs = [
                place_on_sign(mention["phrase"])
                for part in self._parts[-3:]
                for mention in part.mentions
                if mention["kind"] == "sign" and mention["place"] == "turn"
            ]
            names += [signs[-1]] if signs and signs[-1] else []
        else:
            names += self._in_full(names[0])
        return shown_names(names)

    def _in_full(self, name: str) -> Iterable[str]:
        """Yield fuller names said elsewhere: the space station for `the station`."""
        for mark in self._all:
            kind, _, place = mark.label.partition(":")
            if kind == "again" or (kind == "thing" and place not in _ELSEWHERE):
                phrase = phrase_in(self._words(mark))
                if phrase.endswith(f" {name}"):
                    yield phrase

    def _part(self, mark: Mark) -> _Part:
        """Return what a mark speaks of: its leg, or the next that ends with a turn."""
        if mark.label == "dest":
            return self._parts[-1]
        later = [number for leg, number in self._number.items() if leg >= mark.leg]
        return self._parts[min(later, default=len(self._parts) - 1)]

    def _place(self, mark: Mark) -> None:
        words, part = self._words(mark), self._part(mark)
        kind, _, value = mark.label.partition(":")
        match kind:
            case "turn" | "bend":
                if kind == "bend" and value != "either" and self._is_slight(mark):
                    value = f"slight_{value}"
                part.turn |= {"way": value, "forced": kind == "bend"}
                part.unclear = round(1 - mark.probability, 3)
                self._said.append((mark, part.turn))
            case "ordinal":
                self._count(mark, ordinal_in(words), part)
            case "end":
                part.turn["at_end"] = True
            case "junction":
                part.turn["junction"] = value
            case "immediate":
                part.turn["immediate"] = True
            case "length":
                length = length_in(words, self._unit)
                after = self._counted_from(mark, length)
                part.lengths.append(replace(length, after=after))
                self._said.append((mark, part.length))
            case "pass":
                more: dict[str, Any] = {}
                part.passings += [(each, more) for each in passings_in(words)]
                self._said.append((mark, more))
            case "total":
                said = totals_in(words)
                self._totals = Totals(
                    said.turns or self._totals.turns,
                    said.metres or self._totals.metres,
                )
            case _:
                self._name(mark, kind, value, part)

    def _counted_from(self, mark: Mark, length: Length) -> str | None:
        """Return the thing that a length is told from: `ten metres after the lift`."""
        later = (each for each in self._marks if each.start >= mark.end)
        thing = next(later, None)
        if thing is None or not thing.label.startswith("thing:"):
            return None
        told = _FROM.fullmatch(self._text, mark.end, thing.start)
        # Twenty metres past the shops one walks along them, one junction past them behind.
        if told is None or (told["past"] is not None and length.unit != "places"):
            return None
        return phrase_in(self._words(thing)) or None

    def _is_slight(self, mark: Mark) -> bool:
        before = _STOP.split(self._text[max(mark.start - NEAR, 0) : mark.start])[-1]
        after = _STOP.split(self._text[mark.end : mark.end + NEAR])[0]
        return _SLIGHT.search(before + after) is not None

    def _count(self, mark: Mark, number: int | None, part: _Part) -> None:
        if number is None:
            return
        before = [m for m in self._marks if m.label == "ordinal" and m.end < mark.start]
        between = self._text[before[-1].end : mark.start] if before else ""
        if "ordinal" in part.turn and between.strip() == "or":
            part.turn["or_ordinal"] = number
        else:
            part.turn["ordinal"] = number
        self._said.append((mark, part.turn))

    def _name(self, mark: Mark, kind: str, value: str, part: _Part) -> None:
        """Take what is said of a thing."""
        phrase = phrase_in(self._words(mark), is_goal=kind == "dest")
        match kind:
            case "thing" | "ignore":
                mention: dict[str, Any] = {}
                if phrase:
                    place = _PLACES.get(value, value or "along")
                    mention |= {"phrase": phrase, "place": place}
                    mention["kind"] = "floor" if is_floor(phrase) else kind_of(phrase)
                    mention["ignored"] = kind == "ignore"
                    if not self._is_ahead(mark, mention, part):
                        part.mentions.append(mention)
                self._things.append((mark, mention))
            case "dest" if phrase and is_floor(phrase):
                # Nobody stops at a floor: it shows where.
                mention = {"phrase": phrase, "place": "turn", "kind": "floor"}
                part.mentions.append(mention)
                self._things.append((mark, mention))
            case "dest":
                if phrase and phrase not in self._names:
                    self._names.append(phrase)
                self._things.append((mark, self._arrival))
            case "too_far" if phrase:
                part.too_far.append(phrase)
            case "wrong_way" if phrase:
                part.wrong_way.append(phrase)
            case "count_after" if phrase:
                part.turn["counted_after"] = phrase
            case "start" if phrase:
                self._start["from_" if value == "from" else value] = phrase
            case _:
                pass

    def _is_ahead(self, mark: Mark, mention: dict[str, Any], part: _Part) -> bool:
        """Take what is walked towards, or on, from the beginning of a stretch.

        It is what one faces at the start, or what the turn before leads to.
        """
        if mention["place"] != "along" or mention["ignored"] or not part.is_new:
            return False
        before = self._text[max(mark.start - NEAR, 0) : mark.start]
        on_it = mention["kind"] == "floor"
        if not (on_it or _TOWARDS.search(_SENTENCE_END.split(before)[-1])):
            return False
        number = next(n for n, each in enumerate(self._parts) if each is part)
        if number == 0:
            self._start.setdefault("facing", mention["phrase"])
            return on_it
        if not on_it:
            return False
        mention |= {"place": "target", "side": "ahead"}
        earlier = self._parts[number - 1].mentions
        if not any(each["phrase"] == mention["phrase"] for each in earlier[-2:]):
            earlier.append(mention)
        return True

    def _relate(self, mark: Mark) -> None:
        """Give sides, numbers and doubts to what stands nearest."""
        kind, _, value = mark.label.partition(":")
        if kind == "doubt":
            doubted = self._nearest(mark, [*self._said, *self._things])
            if doubted is not None:
                doubted[1]["doubt"] = HEDGED
        elif kind in {"side", "nth"}:
            said = value if kind == "side" else ordinal_in(self._words(mark))
            free = [
                each
                for each in self._things
                if kind not in each[1] and not self._begins_anew(mark, each[0])
            ]
            if self._is_last(mark):
                # `And it's on your left.`
                here = [each for each in free if self._is_on_leg(each[0], mark)]
                free = here or [(mark, self._arrival)]
            thing = self._nearest(mark, free)
            if thing is None or said is None:
                return
            thing[1].setdefault(kind, said)
            if kind == "side" and thing[1] is not self._arrival:
                for each in self._listed_with(thing[0], mark):
                    each.setdefault(kind, said)

    def _listed_with(self, thing: Mark, side: Mark) -> Iterator[dict[str, Any]]:
        """Yield what is told in one list with the thing nearest to a side."""
        before = thing.start < side.start
        order = sorted(self._things, key=lambda each: each[0].start, reverse=before)
        at = [mark for mark, _ in order].index(thing)
        for each, owner in order[at + 1 :]:
            one, two = (each, thing) if before else (thing, each)
            between = self._text[one.end : two.start]
            if one.leg != two.leg or not _LISTED.fullmatch(between):
                return
            yield owner
            thing = each

    def _begins_anew(self, mark: Mark, thing: Mark) -> bool:
        """Tell whether a thing is of a sentence after the one of a mark."""
        between = self._text[mark.end : thing.start]
        return _SENTENCE_END.search(between) is not None

    def _is_last(self, mark: Mark) -> bool:
        """Tell whether a mark speaks of the last stretch, where the destination is."""
        return self._part(mark) is self._parts[-1]

    def _is_on_leg(self, one: Mark, other: Mark) -> bool:
        """Tell whether a mark speaks of the leg that another is on."""
        is_goal = one.label in OF_NO_LEG
        return self._is_last(other) if is_goal else one.leg == other.leg

    def _nearest(self, mark: Mark, said: Sequence[_Owner]) -> _Owner | None:
        """Return what stands nearest; of two as near the one before."""
        return min(said, key=lambda each: self._apart(each[0], mark), default=None)

    def _apart(self, one: Mark, other: Mark) -> tuple[int, bool]:
        """Return the characters between two marks, where stops and legs count for more."""
        start, end = sorted((one, other), key=lambda each: each.start)
        between = self._text[start.end : end.start]
        stops = len(_STOP.findall(between)) + len(_SENTENCE_END.findall(between))
        far = len(between) + A_STOP * stops
        if other.label != "doubt":
            far += ANOTHER_LEG * (not self._is_on_leg(one, other))
            far += AFTER * (one.start > other.start)
        return far, one.start > other.start
