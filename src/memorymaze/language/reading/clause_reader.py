"""From one clause to its events, from left to right."""

import re
from collections.abc import Sequence
from dataclasses import replace

from memorymaze.language.plans import Way
from memorymaze.language.reading.chunks import Chunk
from memorymaze.language.reading.clause import (
    AT_THE_TURN,
    Clause,
    ClauseEvent,
    Relation,
    side_of,
    towards_a_side,
)
from memorymaze.language.reading.directions import (
    comes_before_its_thing,
    is_on_both_sides,
    is_turn,
    names_a_way,
    only_faces,
    place_is_named,
    read_left_alone,
    read_opening,
    speaks_of_ways,
)
from memorymaze.language.reading.things import (
    floor_phrase,
    is_lane,
    thing_phrase,
    wall_phrase,
)
from memorymaze.language.reading.vocabulary import PLAIN_FLOORS

_AT_IT = re.compile(r"(?:at|in|when|where|once|the|far|very|its|by)\b")
_AHEAD = re.compile(r"(?:straight |dead |right )?(?:ahead|(?:in )?front)\b")
_ROUND = re.compile(
    r"round|around|bend|bent|curve|curl|wind|corner|kink|jog\b|dog-?leg|turns?$"
)
_WHEN = re.compile(r"when|where|once|as\b")
_ROUND_IT = re.compile(r"(?:round|around|follow|go|walk|come|keep)")
_BACK = re.compile(r"(?:(?:turn|go|walk|head) )?back\b(?! up)|turn round|.*the o")
_SMALL = re.compile(
    r"small|lean|slight|little|gentl|soft|light|bit\b|drift|tilt|touch|tad\b|somewhat|kink|wiggl|jink"
)
_SLANTED: dict[Way | None, Way] = {"left": "slight_left", "right": "slight_right"}
_REACHED = re.compile(r"reach|come|comes|get to|arrive|hit|face|facing|meet")
_LEAVING = re.compile(r"leav|\b(?:of|from|out|off|exit)\b")
_TOWARDS = re.compile(r"towards?\b")
_OPPOSITE = re.compile(r"opposite|across")
_BETWEEN, _TWO = re.compile(r"(?:in )?between$"), re.compile(r"two|2|both")
_SIGN = re.compile(r"\b(?:sign|arrow|signboard)s?\b")
_LOOSE = {"with", "among", "in", "inside", "between"}


class ClauseReader:
    """Reads one clause."""

    def __init__(self, chunks: Sequence[Chunk], before: Sequence[ClauseEvent]) -> None:
        """Take a clause without its joint, and the events of all clauses before."""
        self._clause = Clause(chunks, before)
        self._turned = self._taken = False
        self._facing = False
        """Whether what is named next is what one turns to."""
        self._read: list[ClauseEvent] = []

    def read(self) -> list[ClauseEvent]:
        """Return the events of the clause."""
        clause = self._clause
        if clause.is_recap:
            self._add(ClauseEvent("recap"))
        if clause.has("a") and not clause.kinds:
            self._add(ClauseEvent("restate"))
        if clause.at_once_first:
            self._add(ClauseEvent("at_once"))
        if clause.is_of_the_speaker or speaks_of_ways(clause):
            return self._read
        if clause.kinds == "XJ" and re.fullmatch("no .*s", clause.words):
            return self._read  # "no corners"
        ignores = clause.kinds.find("I")
        denies = clause.kinds.find("X")
        end = len(clause.kinds)
        if ignores >= 0 and (denies < 0 or ignores < denies):
            self._read_negative(0)
        elif denies > 0 and re.fullmatch("[nOJLS]+X", clause.kinds):
            self._read_negative(0)  # "the first left no, the second yes"
        elif clause.kinds == "P":
            self._add(ClauseEvent("refuse", taken=True))  # "Side corridor left: past."
        elif re.fullmatch("[nOJ]+[LSm]*B?P|[OJLS]+BP", clause.kinds):
            self._read_negative(0)  # "two openings on the left passed"
        elif denies >= 0:
            self._read_positive(denies)
            if not re.search("B.*XJ", clause.kinds):
                self._read_negative(denies + 1)
        else:
            self._read_positive(end)
        if clause.has("D") and not self._turned:
            self._add(ClauseEvent("forced"))
        return self._read

    def _add(self, event: ClauseEvent) -> None:
        self._read.append(event)

    # -- what is not to be done

    def _read_negative(self, start: int) -> None:
        """Things left alone are on the way; ways left alone are passed."""
        clause = self._clause
        found = False
        at = start
        while at < len(clause.kinds):
            chunk = clause.chunks[at]
            kind = chunk.kind
            if kind == "N" and (phrase := thing_phrase(chunk.text)):
                found = True
                bound = clause.chunks[at - 1] if at else chunk
                until = bound.kind == "U" and bound.text != "to"  # "ignore all until …"
                self._add(
                    ClauseEvent("thing", phrase=phrase, relation="until")
                    if until
                    else ClauseEvent(
                        "thing", phrase=phrase, relation="past", ignored=True
                    )
                )
            elif kind == "L" and not re.search("[TGOJ]", clause.kinds[start:]):
                found = True  # "not left": says only what the turn is not
            elif kind == "J" and re.search("H.*A$", clause.kinds[start:at]):
                found = True  # "not straight on at the crossing"
            elif kind == "J" and found and _LEAVING.search(clause.chunks[at - 1].text):
                pass  # "the first left off the hall should be left alone"
            elif kind in "OJL" or self._is_of_ways(at):
                event, at = read_left_alone(clause, at)
                found = True
                self._add(event)
            elif kind == "m":
                found = True
                self._add(ClauseEvent("pass_ways"))
            elif kind == "E":
                self._add(ClauseEvent("end", relation="until"))
            elif kind == "M":
                self._add(ClauseEvent("length", length=chunk.length))
            at += 1
        if clause.kinds[start:] == "H":
            if _names_an_opening(clause.before):
                self._add(ClauseEvent("take"))  # "the first on the right. not straight"
        elif not found and clause.kinds[start:] != "T":  # "no turns"
            firm = re.search("I|XY", clause.kinds) is not None
            self._add(ClauseEvent("refuse", taken=firm))

    def _is_of_ways(self, at: int) -> bool:
        """`Two openings`, or `on the left` next to a word for a way."""
        kinds = self._clause.kinds
        if kinds[at] != "S":
            return kinds[at : at + 2] == "nJ"
        near = self._clause.kinds[max(at - 2, 0) : at + 2]
        return re.search("[TGJO]", near) is not None

    # -- what is to be done

    def _read_positive(self, end: int) -> None:
        at = 0
        while at < end:
            at = self._read_at(at)

    def _read_at(self, at: int) -> int:
        """Read what stands at an index; return the index after it."""
        clause = self._clause
        chunk = clause.chunks[at]
        kind = chunk.kind
        before = clause.kinds[:at]
        if kind == "s":
            self._add(ClauseEvent("wall", side=side_of(chunk) or "behind"))
            return at + 1
        if kind == "u":
            self._take(ClauseEvent("turn", way="around", here=True))
            return at + 1
        if kind == "b" and _BACK.match(chunk.text) and clause.is_first:
            self._take(ClauseEvent("turn", way="around", here=True))
            return at + 1
        if only_faces(clause, at):
            self._facing = True
            return at + 1
        if self._facing and kind in "GTLSUE":
            self._facing = kind == "U" and clause.kinds[at + 1 : at + 2] == "N"
        if kind in "OJ" or (kind == "n" and clause.kinds[at + 1 : at + 2] == "J"):
            events, at = read_opening(clause, at, turned=self._turned)
            for event in events:
                self._take(event)
            return at
        if kind in "2d":
            self._read_pair(at)
        elif kind in "LS":
            self._read_direction(at)
        elif kind == "N":
            if clause.kinds[at + 1 :] in {"S", "L"} and is_lane(chunk.text):
                return self._read_lane(at)
            self._read_thing(at)
        elif kind == "M" and re.fullmatch("[ZB]*N[BV]?[SL][AQ]M", clause.kinds):
            self._add(ClauseEvent("along", length=chunk.length))
        elif kind == "M":
            back = self._turned and clause.kind_before(at) in {"A", "Q"}
            self._add(ClauseEvent("length", length=chunk.length, back=back))
        elif kind == "E":
            bound = re.search("A[VG]*$", before) is not None
            at_it = bound or _AT_IT.match(chunk.text) is not None
            back = self._turned and at_it
            it_is = before == "V" or re.search("[ZBR]", before) is not None
            of_goal = it_is and "T" not in before
            relation: Relation = "at" if at_it else "until"
            self._add(ClauseEvent("end", relation=relation, back=back, of_goal=of_goal))
        elif kind == "Y":
            self._add(ClauseEvent("take"))
            self._taken = True
        elif kind == "R":
            if chunk.text.endswith(" it"):
                self._add(ClauseEvent("take"))  # "another one on the right, that is it"
            self._add(ClauseEvent("arrive"))
        elif kind == "H" and _AHEAD.match(chunk.text) and re.search("NB?A?H*$", before):
            of_the_next = clause.kinds[at + 1 :].startswith("BN")
            self._add(ClauseEvent("side", side="ahead", likely=of_the_next))
        elif kind == "H" and _AHEAD.match(chunk.text) and _is_of_the_goal(clause):
            self._add(ClauseEvent("side", side="ahead", of_goal=True))
        elif kind == "H" and re.fullmatch("A?HB?N[^N]*", clause.kinds):
            self._add(ClauseEvent("side", side="ahead", likely=True))
        elif kind == "H":
            self._add(ClauseEvent("straight"))
        elif (
            kind == "K"
            and _ROUND.search(chunk.text)
            and not (chunk.text.endswith("turns") and clause.kinds[at + 1 :])
            and not re.search("[LS]", clause.kinds[at + 1 :])
            and not (self._turned and before[-1:] in {"L", "J"})
        ):
            about = self._clause.has("D") and not _ROUND_IT.match(chunk.text)
            self._take(ClauseEvent("turn", forced=True, subject=about))
        return at + 1

    def _take(self, event: ClauseEvent) -> None:
        """Add an event of `read_opening`; turns learn how they were said."""
        if event.kind != "turn":
            self._turned = self._turned or event.taken
            self._add(event)
            return
        clause = self._clause
        first = not self._turned and not any(
            e.kind in {"length", "thing", "end"} for e in self._read
        )
        self._add(
            replace(
                event,
                doubt=clause.doubt,
                forced=event.forced or clause.has("D"),
                at_once=event.at_once
                or clause.at_once_first
                or (self._turned and clause.has("i")),
                emphatic=first and clause.kinds[:1] in {"L", "O", "Z", "S"},
                again=clause.has("a"),
                here=event.here or (not self._turned and clause.has("l")),
                commanded=clause.has_verb,
                apposed=first and clause.kinds[:1] == "Z",
            )
        )
        self._turned = True

    def _read_pair(self, at: int) -> None:
        """`Right-left` and `front right`: two turns in one word."""
        clause = self._clause
        chunk = clause.chunks[at]
        diagonal = chunk.kind == "d"
        if diagonal and clause.kind_before(at) == "N" and "front" in chunk.text:
            self._take(
                ClauseEvent("turn", way=chunk.turn)
            )  # "at the window front left"
        elif not is_on_both_sides(clause, at):
            self._take(ClauseEvent("turn", way=chunk.turn))
            self._take(
                ClauseEvent(
                    "turn",
                    way=chunk.second_turn,
                    at_once=True,
                    joined=True,
                    forced=diagonal,
                )
            )

    def _read_direction(self, at: int) -> None:
        clause = self._clause
        chunk = clause.chunks[at]
        after_turn = not self._read or self._read[-1].kind == "turn"
        off = clause.has("l") or (chunk.kind == "S" and towards_a_side(chunk))
        moved = re.search("[TK]", clause.kinds[:at])
        leaving = off and not self._turned and moved is None
        turn = is_turn(clause, at, after_turn=after_turn)
        if chunk.kind == "L" and clause.kind_before(at) == "P":
            self._add(ClauseEvent("pass_ways", count=1, side=side_of(chunk)))
        elif names_a_way(clause, at, turn=turn):
            self._add(
                ClauseEvent("way", side=side_of(chunk), likely=True, leaving=leaving)
            )
        elif turn:
            bend = " ".join(c.text for c in clause.chunks[:at] if c.kind == "K")
            way = chunk.turn
            if _SMALL.search(bend):
                way = _SLANTED.get(way) or way
            alone = re.fullmatch("[ZVR]*S", clause.kinds) and not place_is_named(clause)
            self._take(
                ClauseEvent(
                    "turn",
                    way=way,
                    forced=bool(bend),
                    aside=bool(alone),
                    leaving=leaving,
                )
            )
        elif chunk.way is not None or chunk.kind == "S":
            first = comes_before_its_thing(clause, at)
            goal = _is_of_the_goal(clause)
            self._add(
                ClauseEvent(
                    "side",
                    side=side_of(chunk),
                    likely=first,
                    of_goal=goal,
                    here=clause.has("l"),
                    leaving=leaving,
                )
            )

    # -- things

    def _read_lane(self, at: int) -> int:
        """`Meteorite Lane on the left`: the name of a way, and where it opens."""
        self._read_thing(at)
        likely = re.search("[BVPA]", self._clause.kinds) is None
        side = side_of(self._clause.chunks[at + 1])
        self._add(ClauseEvent("way", side=side, likely=likely))
        return at + 2

    def _read_thing(self, at: int) -> None:
        clause = self._clause
        words = clause.chunks[at].text
        look = floor_phrase(words) or wall_phrase(words)
        phrase = look or thing_phrase(words)
        if not phrase:
            return
        is_look = look is not None and look not in PLAIN_FLOORS
        relation = self._relation(at, is_look=is_look)
        if self._facing:
            self._add(ClauseEvent("ahead", phrase=phrase, turns=True))
            return
        if is_look and self._is_way(at, relation):
            takes = clause.chunks[at - 1].kind == "T" if at else False
            self._add(ClauseEvent("ahead", phrase=phrase, turns=takes, walks=True))
            return
        if clause.kind_before(at) == "A" and _TOWARDS.match(clause.chunks[at - 1].text):
            self._add(ClauseEvent("ahead", phrase=phrase, walks=True))
        counted = clause.kind_before(at) == "O"
        nth = int(clause.chunks[at - 1].number or 1) if counted else None
        followed = self._follows_a_sign(at)
        last = clause.last_event()
        if followed and not self._turned and last is not None and last.kind == "turn":
            relation = "into"
        taken = self._turned or ((followed or self._taken) and relation == "into")
        back = taken and (relation in AT_THE_TURN or relation in {"into", "between"})
        self._add(
            ClauseEvent(
                "thing",
                phrase=phrase,
                relation=relation,
                subject=clause.kinds[at + 1 : at + 2] == "B",
                called=re.fullmatch("N(?:AN)?", clause.kinds) is not None,
                back=back,
                ordinal=nth,
                walks=not (self._turned or followed) and "G" in clause.kinds[:at],
            )
        )

    def _follows_a_sign(self, at: int) -> bool:
        """`Turn right, follow the sign.`: the sign is seen after the turn."""
        verbs = [each.text for each in self._clause.chunks[:at] if each.kind == "G"]
        sign = _SIGN.search(self._clause.chunks[at].text) is not None
        return sign and bool(verbs) and verbs[-1].startswith("follow")

    def _is_way(self, at: int, relation: Relation) -> bool:
        """Tell `follow the blue path` from `until the blue path`."""
        bound = self._clause.kinds[:at].rstrip("H")
        if bound.endswith("JA") and self._clause.chunks[at - 1].text in _LOOSE:
            bound = bound[:-2]  # "along the hall with the blue floor"
        before = bound[-1:]
        if before == "T":
            return True
        if before == "G":
            verb = self._clause.chunks[len(bound) - 1].text
            return not (_LEAVING.search(verb) or verb.startswith("start"))
        return before == "t" or (relation == "into" and self._turned)

    def _relation(self, at: int, *, is_look: bool = False) -> Relation:
        """What binds a thing to its clause: the nearest binding word before it."""
        chunks = self._clause.chunks
        if self._is_between_two(at):
            return "between"
        junction = False
        first = at - 1 - (self._clause.kind_before(at) == "O")
        for index in range(first, -1, -1):
            chunk = chunks[index]
            if junction and chunk.kind in "JS":
                continue
            if chunk.text in _LOOSE and re.search("JS?$", self._clause.kinds[:index]):
                junction = True  # "at the crossing with the clock": it is bound so
                continue
            if chunk.kind == "V" and (
                self._clause.kind_before(index) == "U"
                or _WHEN.match(chunks[index - 1].text if index else "")
            ):
                if self._turned and self._clause.kind_before(index) == "A":
                    return "at"  # "left when you come to the desk"
                return "until"  # "until you see a blue carpet", "when you see the desk"
            relation = self._bond(chunk)
            aside = self._clause.kinds[at + 1 : at + 2] == "S"
            if relation == "from" and aside and chunk.text.startswith("leav"):
                return "past"  # "leave the kitchen on your left"
            if relation is not None:
                return relation
        if self._clause.kinds.startswith("JA"):
            return "at"  # "this crossing with the clock": where one is by now
        return "see"

    def _is_between_two(self, at: int) -> bool:
        """`Between the two plants`, `between two that have plants`."""
        for index in range(at - 1, -1, -1):
            if self._clause.kinds[index] not in "nJBA":
                return False
            if _BETWEEN.match(self._clause.chunks[index].text):
                two = self._clause.chunks[index + 1]
                return two.kind == "n" and _TWO.fullmatch(two.text) is not None
        return False

    def _bond(self, chunk: Chunk) -> Relation | None:
        onward: Relation = "into" if self._turned else "see"
        match chunk.kind:
            case "A":
                if chunk.text.startswith("away"):
                    return "away"
                if chunk.text.startswith(("from", "out", "off")):
                    return "from"
                if self._taken and chunk.text == "with":
                    return "into"  # "this is the one with the lamps"
                loose = chunk.text in _LOOSE or _TOWARDS.match(chunk.text)
                return "see" if loose else "at"
            case "w":
                return "opposite" if _OPPOSITE.search(chunk.text) else "beside"
            case "Q":
                return "before" if "before" in chunk.text else "after"
            case "U":
                return "until"
            case "t":
                return "into"
            case "P":
                return "past"
            case "V":
                return "until" if _REACHED.search(chunk.text) else "seen"
            case "G":
                return "from" if _LEAVING.search(chunk.text) else onward
            case "B" | "Z" | "J" | "O" | "S":
                return "see"
            case "L" | "M" | "2" | "E" | "R":
                return onward
            case _:
                return None


def _names_an_opening(told: Sequence[ClauseEvent]) -> bool:
    """Tell whether an opening was named last."""
    joints = {"clause", "sentence", "then"}
    last = next((each for each in reversed(told) if each.kind not in joints), None)
    return last is not None and last.kind == "way"


def _is_of_the_goal(clause: Clause) -> bool:
    """`It is, you will see it, on your left`: of what is spoken of all the time."""
    said = re.match("[ZR]|V+[HSL]|H+$|SV$", clause.kinds)
    return said is not None and "N" not in clause.kinds
