"""From chunks to events: what each clause says.

The rules work on one clause at a time and look at the kinds of its chunks; words that
no rule needs are passed over.
"""

import re
from collections.abc import Iterator
from dataclasses import replace

from memorymaze.language.route_description.chunks import Chunk
from memorymaze.language.route_description.events import Event, Relation
from memorymaze.language.route_description.plan import Junction, Side
from memorymaze.language.route_description.things import is_lane, thing_phrase
from memorymaze.language.route_description.words import ORDINALS

__all__ = ["read_clauses", "split_clauses"]

_DOOR = re.compile(r"^(?:hand )?(?:door|wall|window|room)s?\b")
_LOOSE = {"with", "among", "in", "inside", "between"}
_AHEAD = re.compile(r"(?:straight |dead |right )?(?:ahead|front)\b")
_ROUND = re.compile(r"round|around|bend|curve|curl|wind")
_STARTS = re.compile(r"(?:start|begin|open|continue|lead)")
_OPENING = re.compile(r"opening|turn|gap|exit|fork|branch")
_TOWARDS = re.compile(r"(?:to|towards?)\b")
_SIGN = re.compile(r"\b(?:sign|board|arrow|screen|signs|arrows|shows?|points?|pointing)\b")
_NEGATIVE = set("IX")


def split_clauses(chunks: list[Chunk]) -> list[list[Chunk]]:
    """Cut at punctuation and joints; the joint is the last chunk of its clause.

    "and" is a joint only where something new to do follows.
    """
    clauses: list[list[Chunk]] = [[]]
    for at, chunk in enumerate(chunks):
        if chunk.kind == "f":
            continue
        following = next((c for c in chunks[at + 1 :] if c.kind not in "fhira"), None)
        if chunk.kind in ".,>" or (
            chunk.kind == "&" and following is not None and _opens(chunks, at, following)
        ):
            clauses[-1].append(chunk)
            clauses.append([])
        elif chunk.kind != "&":
            if chunk.kind in "TG" and _starts_anew(clauses[-1], chunk):
                clauses[-1].append(Chunk(",", "", chunk.start))
                clauses.append([])
            clauses[-1].append(chunk)
    return [clause for clause in clauses if clause]


def _opens(chunks: list[Chunk], at: int, following: Chunk) -> bool:
    if following.kind in "TGIXPK":
        return True
    if following.kind in "OM":
        return True
    if following.kind == "L":
        return not (chunks[at - 1].kind in "LS" and at > 0)
    return following.kind in "2AQEVYS" and following.kind != "S"


def _starts_anew(clause: list[Chunk], chunk: Chunk) -> bool:
    """Tell whether a motion verb begins a new clause in unpunctuated text."""
    kinds = "".join(c.kind for c in clause)
    if not kinds:
        return False
    if chunk.text in {"do", "take", "turn"} and kinds[-1] in "OJ":
        return False
    if chunk.kind == "G" and kinds[-1] in "LS2" and not re.search("[TGK]", kinds):
        return False
    return bool(re.search(r"[LSMENJHY2]$", kinds)) and bool(
        re.search("[TGPKLS2M]", kinds)
    )


def read_clauses(clauses: list[list[Chunk]], before: list[Event]) -> list[Event]:
    """Return the events of clauses, with `clause` and `sentence` marks between.

    Args:
        clauses: What `split_clauses` gave.
        before: Events of the sentences before.
    """
    events: list[Event] = []
    hypothetical = False
    for number, clause in enumerate(clauses):
        joint = clause[-1] if clause[-1].kind in ".,>&" else None
        body = clause[:-1] if joint is not None else clause
        rest = _sentence(clauses, number)
        if not hypothetical and _speaks_of_missing(body, rest):
            hypothetical = True
        if hypothetical:
            events.extend(
                Event("too_far", phrase=phrase)
                for chunk in body
                if chunk.kind == "N" and (phrase := thing_phrase(chunk.text))
            )
        else:
            events.extend(ClauseReader(body, [*before, *events]).read())
        if joint is not None and joint.kind == ".":
            events.append(Event("sentence", counted=";" in joint.text))
            hypothetical = False
        else:
            events.append(Event("then" if joint and joint.kind == ">" else "clause"))
    return events


def _sentence(clauses: list[list[Chunk]], start: int) -> list[Chunk]:
    """The chunks from a clause to the end of its sentence."""
    chunks: list[Chunk] = []
    for clause in clauses[start:]:
        chunks.extend(clause)
        if clause[-1].kind == ".":
            break
    return chunks


def _speaks_of_missing(body: list[Chunk], rest: list[Chunk]) -> bool:
    """Tell whether from here the sentence is about having gone wrong."""
    if not any(chunk.kind == "o" for chunk in rest):
        kinds = "".join(chunk.kind for chunk in body)
        return bool(re.match("[h]*c", kinds)) and bool(re.search("[TG].*[LS]", kinds))
    if any(chunk.kind in "co" for chunk in body):
        return True
    turns = [chunk for chunk in rest if chunk.kind in "L2M"]
    return not turns


class ClauseReader:
    """Reads one clause from left to right."""

    def __init__(self, clause: list[Chunk], before: list[Event]) -> None:
        """Take a clause without its joint, and the events read so far."""
        self._chunks = [chunk for chunk in clause if chunk.kind not in "hiDar"]
        self._kinds = "".join(chunk.kind for chunk in self._chunks)
        self._doubt = 0.5 if any(chunk.kind == "h" for chunk in clause) else 0.0
        self._at_once = any(chunk.kind == "i" for chunk in clause)
        self._forced = any(chunk.kind == "D" for chunk in clause)
        self._again = any(chunk.kind == "a" for chunk in clause)
        self._recap = any(
            chunk.kind == "r" or re.search(r"\b(?:both|like|i said)\b", chunk.text)
            for chunk in clause
        )
        self._before = before
        self._turned = False
        self._read: list[Event] = []

    def read(self) -> list[Event]:
        """Return the events of the clause."""
        if self._recap:
            self._read.append(Event("recap"))
        if self._again and not self._kinds:
            self._read.append(Event("restate"))
        if self._at_once:
            self._read.append(Event("at_once"))
        if self._is_about_ways():
            return self._read
        negative = next(
            (i for i, kind in enumerate(self._kinds) if kind in _NEGATIVE), None
        )
        end = len(self._chunks)
        if negative is not None and self._kinds[negative] == "I":
            self._read_negative(0, end)
        elif negative is not None:
            self._read_positive(0, negative)
            if not re.search("B.*XJ", self._kinds):
                self._read_negative(negative + 1, end)
        else:
            self._read_positive(0, end)
        if self._forced and not self._turned:
            self._add(Event("forced"))
        return self._read

    def _is_about_ways(self) -> bool:
        """`Right takes you to the labs`: a direction that is the subject."""
        return bool(re.match("[LS][GKT]", self._kinds)) and bool(
            re.match(r"(?:goes|lead|bring|takes)", self._chunks[1].text)
        )

    def _both_sides(self, at: int) -> bool:
        """`Rooms left and right` is no turn; `at the windows left-right` is."""
        if "-" in self._chunks[at].text:
            return False
        before = self._kinds[:at]
        return before.endswith("N") and re.search("[AQPUt]N+$", before) is None

    # -- what is not to be done

    def _read_negative(self, start: int, end: int) -> None:
        """Things left alone are on the way; ways left alone are passed."""
        found = False
        at = start
        while at < end:
            chunk = self._chunks[at]
            kind = chunk.kind
            if kind == "N":
                phrase = thing_phrase(chunk.text)
                if phrase:
                    found = True
                    self._add(Event("thing", phrase=phrase, relation="past", ignored=True))
            elif kind == "L" and not re.search("[TGOJ]", self._kinds[start:end]):
                found = True
            elif kind in "OJLS" and (kind != "S" or self._way_near(at)):
                count, side, at = self._counted_ways(at, end)
                found = True
                self._add(Event("pass_ways", count=count, side=side))
            elif kind == "m":
                found = True
                self._add(Event("pass_ways"))
            elif kind == "E":
                self._add(Event("end", relation="until"))
            elif kind == "M":
                self._add(Event("length", length=chunk.length))
            at += 1
        if not found:
            self._add(Event("refuse"))

    def _way_near(self, at: int) -> bool:
        return any(kind in "TGJO" for kind in self._kinds[max(at - 2, 0) : at + 2])

    def _counted_ways(self, at: int, end: int) -> tuple[int | None, Side | None, int]:
        """Read `the first opening on the right` from index `at`."""
        count: int | None = None
        side: Side | None = None
        last = at
        while at < end and self._kinds[at] in "OJLSn":
            chunk = self._chunks[at]
            if chunk.kind == "O" and chunk.number is not None:
                count = 1
            elif chunk.kind == "n" and chunk.number is not None:
                count = int(chunk.number)
            elif chunk.kind == "J" and count is None:
                count = None if chunk.text.endswith("s") else 1
            elif chunk.way is not None:
                side = _side_of(chunk)
            last = at
            at += 1
        return count, side, last

    # -- what is to be done

    def _read_positive(self, start: int, end: int) -> None:
        at = start
        while at < end:
            at = self._read_at(at, end)

    def _read_at(self, at: int, end: int) -> int:
        """Read what stands at an index; return the index after it."""
        chunk = self._chunks[at]
        kind = chunk.kind
        if kind in "OJ" or (kind == "n" and self._kinds[at + 1 : at + 2] == "J"):
            return self._read_way(at, end)
        if kind == "d" and self._kinds[at - 1 : at] == "N" and "front" in chunk.text:
            self._turn(Event("turn", way=chunk.way))
        elif kind in "2d" and self._both_sides(at):
            pass
        elif kind in "2d":
            self._turn(Event("turn", way=chunk.way))
            self._turn(Event("turn", way=chunk.second_way, at_once=True, joined=True, forced=kind == "d"))
        elif kind in "LS":
            if kind == "L" and self._kinds[at - 1 : at] == "P":
                side = _side_of(chunk)
                self._add(Event("pass_ways", count=1, side=side))
            elif kind == "L" and self._exists(at):
                self._add(Event("way", side=_side_of(chunk), likely=True))
            elif kind == "S" and _TOWARDS.match(chunk.text) and (
                self._starts_there(at) or (self._kinds == "S" and not self._is_turn(at))
            ):
                self._add(Event("way", side=_side_of(chunk), likely=True))
            elif self._is_turn(at) and self._of_a_sign(at):
                self._add(Event("way", side=_side_of(chunk), likely=True))
            elif self._is_turn(at):
                self._turn(Event("turn", way=chunk.way, forced=self._bends(at)))
            elif chunk.way is not None or kind == "S":
                self._add(Event("side", side=_side_of(chunk), likely=self._subject(at)))
        elif kind == "N":
            if self._kinds[at + 1 :] in {"S", "L"} and is_lane(chunk.text):
                return self._read_lane(at)
            self._read_thing(at)
        elif kind == "M":
            back = self._turned and self._kinds[at - 1] in "AQ"
            self._add(Event("length", length=chunk.length, back=back))
        elif kind == "E":
            at_it = re.match(r"(?:at|in|when|where|once|the|far|very|its|by)\b", chunk.text)
            back = self._turned and at_it is not None
            self._add(Event("end", relation="at" if at_it else "until", back=back))
        elif kind == "Y":
            self._add(Event("take"))
        elif kind == "R":
            self._add(Event("arrive"))
        elif kind == "H" and self._kinds[at - 1 : at] == "N" and _AHEAD.match(chunk.text):
            self._add(Event("side", side="ahead"))
        elif kind == "H":
            self._add(Event("straight"))
        elif kind == "K" and _ROUND.search(chunk.text):
            if not re.search("[LS]", self._kinds[at + 1 :]):
                self._turn(Event("turn", forced=True))
        return at + 1

    def _turn(self, event: Event) -> None:
        first = not self._turned and not any(
            e.kind in {"length", "thing", "end"} for e in self._read
        )
        emphatic = first and self._kinds[:1] in {"L", "O", "Z", "S"}
        self._read.append(
            replace(
                event,
                doubt=self._doubt,
                forced=event.forced or self._forced,
                at_once=event.at_once or self._at_once,
                emphatic=emphatic,
                again=self._again,
                commanded=re.search("[TGK]", self._kinds) is not None,
                apposed=first and self._kinds[:1] == "Z",
            )
        )
        self._turned = True

    def _add(self, event: Event) -> None:
        self._read.append(event)

    def _bends(self, at: int) -> bool:
        return "K" in self._kinds[:at]

    def _is_turn(self, at: int) -> bool:
        """Tell `turn left` from `the bench on the left`."""
        chunk = self._chunks[at]
        before = self._kinds[:at].rstrip("H")
        after = self._kinds[at + 1 :]
        if chunk.way in {None, "forward"}:
            return False
        last = before[-1:]
        if chunk.kind == "S" and _is_aside(chunk) and last == "G":
            if chunk.text.endswith(("side", "sides")) or "N" in before:
                return False
            verb = self._chunks[len(before) - 1].text
            return re.match(r"(?:keep|leav|stay)", verb) is None and not after[:1] == "B"
        if last == "K" and _is_aside(chunk) and "side" in chunk.text:
            return False
        if last in {"T", "K"} or (last == "G" and not after.startswith("N")):
            return not (after.startswith("B") and last == "G")
        if self._of_a_sign(at) and _TOWARDS.match(chunk.text):
            return True
        if "T" in before and not re.search("[NJBV]", before[before.rindex("T") :]):
            return True
        if chunk.kind == "S":
            return self._is_turn_to_side(chunk, before, after)
        if re.match("BN?", after) and not before:
            return False
        if last == "" and re.match("N", after) and _DOOR.search(self._chunks[at + 1].text):
            return False
        if last == "N":
            bound = re.search("([AQPUtV])N+$", before)
            if bound is None:
                return False
            return not self._chunks[bound.start()].text.startswith(("with", "among"))
        if last == "B":
            return "N" not in before or "J" in before
        if last == "A":
            return False
        if last in {"L", "S"}:
            return not self._read or self._read[-1].kind == "turn"
        return True

    def _is_turn_to_side(self, chunk: Chunk, before: str, after: str) -> bool:
        if ("G" in before and not _is_aside(chunk)) or "K" in before:
            return re.search("[NJ]", before) is None and not after.startswith("BN")
        bound = re.search("([AU])N+$", before)
        if _TOWARDS.match(chunk.text) and bound is not None:
            loose = self._chunks[bound.start()].text.startswith(("with", "among"))
            return re.search("[BV]", before) is None and not loose
        if re.search("TN$", before) and not re.match("[BN]", after):
            return True
        if before or re.match("[BN]", after):
            return before.endswith("Z") and not _is_aside(chunk)
        towards = _TOWARDS.match(chunk.text) is not None
        clock = "clock" in chunk.text and re.match(r"(?:on|at|in) ", chunk.text) is None
        if not (towards or clock):
            return False
        last = next((e for e in reversed(self._before) if e.kind != "clause"), None)
        if last is not None and last.kind == "turn" and last.way == chunk.way:
            return False
        return last is None or last.kind != "thing" or clock or self._pending_place()

    def _exists(self, at: int) -> bool:
        """`There is a left`, `comes a right`."""
        if self._kinds[at - 1 : at] != "B":
            return False
        return self._chunks[at - 1].text.startswith(("come", "there", "here"))

    def _starts_there(self, at: int) -> bool:
        """`Carpet starts to the left`."""
        before = self._chunks[at - 1] if at else None
        return before is not None and _STARTS.match(before.text) is not None

    def _of_a_sign(self, at: int) -> bool:
        """`The board says Offices, right`: where a sign points, not yet a turn."""
        verbs = [chunk.text for chunk in self._chunks[:at] if chunk.kind in "TG"]
        if any(not verb.startswith("follow") for verb in verbs):
            return False
        words = " ".join(chunk.text for chunk in self._chunks[:at])
        return _SIGN.search(words) is not None

    def _pending_place(self) -> bool:
        """True when this sentence has named a place to turn at."""
        for event in reversed(self._before):
            if event.kind in {"sentence", "turn"}:
                return False
            if event.kind == "end" or event.relation in {"at", "until", "after"}:
                return True
        return False

    def _subject(self, at: int) -> bool:
        """True for `on the left is …`: the thing comes after its side."""
        return re.match("[BVZ]?n?O?N", self._kinds[at + 1 :]) is not None and not (
            "N" in self._kinds[:at]
        )

    def _read_lane(self, at: int) -> int:
        """`Meteorite Lane on the left`: the name of a way, and where it opens."""
        self._read_thing(at)
        likely = re.search("[BVPA]", self._kinds) is None
        side = _side_of(self._chunks[at + 1])
        self._add(Event("way", side=side, likely=likely))
        return at + 2

    def _read_thing(self, at: int) -> None:
        phrase = thing_phrase(self._chunks[at].text)
        if not phrase:
            return
        relation = self._relation(at)
        back = self._turned and relation in {"at", "before", "after"}
        before = self._chunks[at - 1] if at else None
        nth = int(before.number or 1) if before is not None and before.kind == "O" else None
        self._add(
            Event("thing", phrase=phrase, relation=relation, back=back, ordinal=nth)
        )

    def _relation(self, at: int) -> Relation:
        """What binds a thing to its clause: the nearest binding word before it."""
        for chunk in reversed(self._chunks[:at]):
            if chunk.kind == "N":
                continue
            if chunk.kind == "A":
                return _bond(chunk.text)
            if chunk.kind == "Q":
                return "before" if "before" in chunk.text else "after"
            if chunk.kind == "U":
                return "until"
            if chunk.kind == "t":
                return "into"
            if chunk.kind == "P":
                return "past"
            if chunk.kind == "V":
                reached = re.search(r"reach|come|comes|get to|arrive|hit|face|facing|meet", chunk.text)
                return "until" if reached else "see"
            if chunk.kind == "G":
                if re.search(r"leav|\b(?:of|from|out|off|exit)\b", chunk.text):
                    return "from"
                return "into" if self._turned else "see"
            if chunk.kind in "BZJOSLM2ER":
                return "see" if chunk.kind in "BZJOS" else "into" if self._turned else "see"
        return "see"

    # -- openings and junctions

    def _read_way(self, at: int, end: int) -> int:
        """Read `the second opening on the left`, `at the crossing`, `first left`."""
        start = at
        ordinal: int | None = None
        count: int | None = None
        noun: str | None = None
        side: Side | None = None
        stated = nearest = False
        while at < end:
            chunk = self._chunks[at]
            if chunk.kind == "O" and ordinal is None and noun is None:
                ordinal = int(chunk.number or 1)
                noun = None if chunk.text.split()[-1] in ORDINALS else chunk.text
                nearest = chunk.text.endswith(("next", "nearest"))
            elif chunk.kind == "n" and noun is None and count is None:
                count = int(chunk.number or 1)
            elif chunk.kind == "J" or (
                chunk.kind == "T" and noun is None and chunk.text.startswith("turn")
            ):
                noun = f"{noun} {chunk.text}" if noun else chunk.text
            elif chunk.kind in "LS" and side is None and chunk.way not in {None, "forward"}:
                if chunk.kind == "L" and noun is not None:
                    if ordinal is None and not re.search("[TG]", self._kinds[:start]):
                        break
                    stated = True
                side = _side_of(chunk)
            elif chunk.kind == "S" and side is None:
                pass
            elif chunk.kind == "B" and side is None and self._kinds[at + 1 : at + 2] == "L":
                stated = True
            else:
                break
            at += 1
        before = self._kinds[:start]
        after = self._kinds[at:]
        if noun is None and side is None and after.startswith("N"):
            return at
        junction = _junction_of(noun or "")
        if "P" in before and not re.search("P.*T", before):
            single = 1 if noun is None or not noun.endswith("s") else None
            self._add(Event("pass_ways", count=count or single, side=_flat(side)))
        elif side is None and ordinal is None:
            self._read_bare_way(noun or "", junction, before, after, count)
        elif side is not None and (stated or self._takes(before, noun, ordinal, after, start)):
            self._turn(
                Event(
                    "turn",
                    way=side,
                    ordinal=ordinal,
                    nearest=nearest,
                    forced=self._bends(start),
                )
            )
        elif side is None and ("T" in before or "t" in before) and "V" not in before:
            self._add(Event("way", ordinal=ordinal, nearest=nearest, likely=True, taken=True))
            self._turned = True
        elif side is None and re.search("[AU]$", before):
            self._add(Event("way", ordinal=ordinal, nearest=nearest, likely=True, back=self._turned))
        else:
            exists = re.match("B", after) is not None
            bare = "L" in self._kinds[start:at]
            likely = not before and ordinal is not None and (bare or not exists)
            self._add(Event("way", side=side, ordinal=ordinal, nearest=nearest, likely=likely))
        return at

    def _takes(
        self, before: str, noun: str | None, ordinal: int | None, after: str, start: int
    ) -> bool:
        if re.search("[TtGK]", before) and not re.search("[VB]", before):
            return True
        if noun is None or self._chunks[start].kind == "L":
            return not re.match("B", after) or ordinal is None
        return re.search("[AU]$", before) is not None and ordinal is not None

    def _read_bare_way(
        self,
        noun: str,
        junction: Junction | None,
        before: str,
        after: str,
        count: int | None,
    ) -> None:
        if junction is not None:
            back = self._turned and before[-1:] in {"A", "Q", "J"}
            self._add(Event("junction", junction=junction, back=back))
        elif count is not None and count >= 3 and re.search("[AV]", before + after):
            self._add(Event("junction", junction="crossing"))
        elif count is not None:
            self._add(Event("pass_ways", count=count))
        elif before.endswith("T") and not self._turned and _OPENING.search(noun):
            if not after.startswith("L"):
                self._turn(Event("turn"))
        elif re.search("[tG]$", before):
            self._add(Event("straight"))


def _is_aside(chunk: Chunk) -> bool:
    return re.match(r"(?:on|at|in|from|along|of|with)\b", chunk.text) is not None


def _flat(side: Side | None) -> Side | None:
    return side


def _side_of(chunk: Chunk) -> Side | None:
    if chunk.way is None:
        return "behind" if "clock" in chunk.text else None
    if chunk.way == "forward":
        return "ahead"
    return "left" if "left" in chunk.way else "right"


def _junction_of(noun: str) -> Junction | None:
    if re.search(r"\bt\b|t-?junction|\bfork|y-?junction", noun):
        return "t"
    if re.search(r"cross|four-way", noun):
        return "crossing"
    if re.search(r"corner|bend", noun):
        return "corner"
    if re.search(r"junction|intersection", noun):
        return None
    return None


def _bond(word: str) -> Relation:
    return "from" if word.startswith(("from", "out", "away", "off")) else "see" if word in _LOOSE else "at"


def clause_texts(clauses: list[list[Chunk]]) -> Iterator[str]:
    """Yield each clause as it was said."""
    for clause in clauses:
        yield " ".join(chunk.text for chunk in clause)
