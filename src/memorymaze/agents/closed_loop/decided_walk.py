"""The closed loop: at each turning point a language model says what to do next."""

import math
from textwrap import shorten

from memorymaze.agents.closed_loop.questions import DecisionQuestions
from memorymaze.agents.closed_loop.replies import WalkDecision, read_answer
from memorymaze.agents.closed_loop.walk_log import DOOR, way_name
from memorymaze.agents.notes import (
    ArrivalNote,
    DecisionNote,
    DoubtNote,
    GaveUpNote,
    RepairNote,
)
from memorymaze.agents.walking.approaching import IN_FRONT, walk_up_to
from memorymaze.agents.walking.floor_map import Sighting, is_sign
from memorymaze.agents.walking.walker import STRIDE, Walker

WITHIN_REACH = 8.0
"""Metres within which a thing can be walked up to."""
LONGEST_REASON = 200
"""Characters of a reason that reports show."""


class DecidedWalk:
    """The walk of one episode, decided by a language model.

    The model is told the text and the log of the walk, and nothing that the robot has
    not met itself.
    """

    def __init__(self, walker: Walker, questions: DecisionQuestions) -> None:
        """Begin where the walker stands; it should read signs."""
        self._walker = walker
        self._questions = questions
        self._journal = questions.journal
        self._log = questions.log
        self._look_for: tuple[str, ...] = ()
        self._doubt = 0.0

    def run(self) -> None:
        """Ask and walk until the model stops, or has no request left.

        Notes in the journal: `decision`, `doubt`, `repair`, `unusable_reply`, and at the
        end `arrival` or `gave_up`.
        """
        self._log.arrive(self._walker.at, self._walker.heading)
        self._walker.look_about((DOOR,))
        self._look_aside()
        while (answer := self._ask()) is not None:
            self._take_note(answer)
            if answer.action in {"walk", "go_back"}:
                self._walk(answer)
            elif answer.action == "look":
                self._look_round()
            elif answer.action == "give_up":
                return self._give_up(answer.note, answer.confidence)
            elif self._is_stopped(answer):
                note, sure = answer.note, answer.confidence
                return self._journal.add(ArrivalNote(note, confidence=sure))
        self._give_up("no request is left", 0.0)

    def _give_up(self, reason: str, confidence: float) -> None:
        self._journal.add(GaveUpNote(reason, confidence))
        self._walker.say("I could not find it.")

    # -- asking

    def _ask(self) -> WalkDecision | None:
        walker = self._walker
        now = (
            f"The robot is at place {walker.at} after {walker.travelled:.0f} m. It looks "
            f"for: {', '.join(self._phrases())}. Answers left: {self._questions.left}."
        )
        return self._questions.ask(self._read, now)

    def _read(self, reply: str) -> WalkDecision:
        """Return the answer in a reply; `ValueError` where it cannot be carried out."""
        answer = read_answer(reply)
        place = self._place_of(answer)
        known = self._log.numbers
        if place not in known:
            told = ", ".join(map(str, known))
            raise ValueError(f"place: expected one of {told}; got {place}")
        crossing = self._walker.map.crossings[place]
        ways = {exit for exit, _ in crossing.open_exits()}
        if answer.exit is not None and answer.exit not in ways:
            names = ", ".join(map(way_name, sorted(ways))) or "none"
            raise ValueError(
                f"way: expected one of {names}, which lead out of place {place}; got "
                f"{answer.way}"
            )
        return answer

    def _place_of(self, answer: WalkDecision) -> int:
        return self._walker.at if answer.place is None else answer.place

    def _take_note(self, answer: WalkDecision) -> None:
        if answer.look_for is not None:
            self._look_for = answer.look_for
        if answer.doubt != self._doubt:
            self._doubt = answer.doubt
            leg = answer.turns_done + 1
            self._journal.add(DoubtNote(answer.doubt, leg, self._walker.at))
        self._log.add_step(
            f"At place {self._walker.at}, {answer.turns_done} turns done, doubt "
            f"{answer.doubt:g}: {answer.note} -> {self._told(answer)}."
        )

    def _told(self, answer: WalkDecision) -> str:
        if answer.exit is not None:
            place = self._place_of(answer)
            back = f"back to place {place}, then " * (place != self._walker.at)
            way = self._log.way_words(place, answer.exit)
            until = f" until {answer.until}" if answer.until else ""
            metres = f" for {answer.metres:g} m" if answer.metres else ""
            return f"{back}way {way}{until}{metres}"
        if answer.action == "go_back":
            return f"back to place {answer.place}"
        return answer.action.replace("_", " ") + f" at {answer.at}" * bool(answer.at)

    # -- walking

    def _walk(self, answer: WalkDecision) -> None:
        """Go back to a place if need be, and then along a way if one is named."""
        walker = self._walker
        place = self._place_of(answer)
        exit = answer.exit
        if place != walker.at or (place, exit) in walker.map.stretches:
            leg = answer.turns_done + 1
            reason = shorten(answer.note, LONGEST_REASON, placeholder=" …")
            self._journal.add(RepairNote(leg, place, reason))
            walker.say("I think we went wrong. We go back.")
        if exit is not None:
            self._journal.add(
                DecisionNote(
                    place,
                    exit,
                    probability=answer.confidence,
                    legs_done=answer.turns_done,
                    because=[answer.note],
                )
            )
        begin = walker.travelled
        if place != walker.at and not walker.go_to(place):
            self._log.arrive(walker.at, walker.heading, again=True)
            self._log.add_outcome(
                f"The way back was not found; came to place {walker.at}"
            )
            return
        came = True
        if exit is not None:
            begin = walker.travelled
            came = self._take_way(exit, answer.until, answer.metres)
        self._look_round()
        walked = walker.travelled - begin
        self._log.add_outcome(
            f"Came to place {walker.at} after {walked:.0f} m"
            + ("" if came else f"; no {answer.until} was seen")
        )

    def _take_way(self, exit: int, until: str | None, metres: float | None) -> bool:
        """Walk to the next place, or until a thing is beside the robot, or so far.

        False where the thing did not come.
        """
        walker = self._walker
        is_known = (walker.at, exit) in walker.map.stretches
        begin = walker.travelled
        target: Sighting | None = None
        halted = False

        def halts(seen: list[Sighting]) -> bool:
            nonlocal target, halted
            # A hanging sign names what lies beyond it.
            named = [
                each
                for each in seen
                if each.phrase == until and "hanging" not in each.label
            ]
            again = [each for each in named if target and target.is_again(each)]
            target = next(iter(again if target else named), target)
            walked = walker.travelled - begin
            far = metres is not None and walked >= metres - STRIDE / 2
            there = target is not None and self._is_reached(target)
            halted = (far or there) and walked > 0 and not walker.is_in_turning_point
            return halted

        phrases = self._phrases() + ((until,) if until else ())
        stretch = walker.follow_exit(exit, phrases, halts)
        if halted:
            walker.halt()
        elif stretch is None:
            self._log.add_outcome("There is no way through")
            return True
        else:
            # It came by there, so there is no need to turn round for it.
            back = walker.map.crossings[walker.at].add_exit(stretch.arrival + math.pi)
            walker.map.note_view(walker.at, back, self._phrases(), ())
        self._log.arrive(walker.at, walker.heading, again=is_known)
        return until is None or target is not None

    def _is_reached(self, thing: Sighting) -> bool:
        """Tell whether a thing is right before the robot, or beside it."""
        walker = self._walker
        is_near = math.dist(thing.place, walker.place) <= IN_FRONT
        return is_near or walker.metres_until_abreast(thing) <= STRIDE / 2

    # -- looking

    def _phrases(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys((DOOR, *self._look_for)))

    def _look_round(self) -> None:
        """Look along all ways; where there are none to the sides, at what is there."""
        self._look_aside()
        if self._walker.at >= 0:
            self._walker.survey(self._phrases())

    def _look_aside(self) -> None:
        crossing = self._walker.map.crossings[self._walker.at]
        if crossing.number <= 0 or len(crossing.exits) < 2:
            for degrees in (90, -180, 90):
                self._walker.turn_by(degrees)
                self._walker.look(self._phrases())

    # -- stopping

    def _is_stopped(self, answer: WalkDecision) -> bool:
        """Walk up to what is named, if anything is; False where it is not to be seen."""
        if answer.at is None:
            return True
        walker, wanted = self._walker, answer.at.casefold()
        self._look_for = tuple(dict.fromkeys((*self._look_for, answer.at)))
        self._look_round()
        near = [
            each
            for each in (*walker.map.sightings, *walker.map.texts)
            if wanted in {each.phrase.casefold(), each.label.casefold()}
            and math.dist(each.place, walker.place) <= WITHIN_REACH
        ]
        if not near:
            self._log.add_outcome(
                f"Not stopped: no {answer.at} is to be seen from here"
            )
            return False
        thing = min(near, key=lambda each: self._rank(each, wanted))
        number, exit = thing.stretch
        if number != walker.at or not walker.face(exit):
            self._face(thing)
        walk_up_to(walker, thing, (answer.at,))
        return True

    def _rank(self, thing: Sighting, wanted: str) -> tuple[bool, float, float]:
        """Rank what may be meant: the thing itself, not a sign; what fits; what is near."""
        written = thing in self._walker.map.texts or is_sign(thing.label)
        away = math.dist(thing.place, self._walker.place)
        return written and not is_sign(wanted), -thing.score, away

    def _face(self, thing: Sighting) -> None:
        x, y = self._walker.place
        bearing = math.atan2(thing.place[1] - y, thing.place[0] - x)
        self._walker.turn_to(bearing)
