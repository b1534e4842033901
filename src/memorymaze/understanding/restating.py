"""Turns told twice: `At the desk right. Right at the desk, yes.`."""

from collections.abc import Sequence

from memorymaze.routes.plan import Way
from memorymaze.understanding.drafts import Draft
from memorymaze.understanding.events import Event


class Restating:
    """Knows whether the sentence at hand only says the last turn again."""

    def __init__(self, events: Sequence[Event]) -> None:
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
        done: list[Draft],
        draft: Draft,
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
        if self._announced:
            return True
        if not draft.is_new:
            same = ordinal is not None and ordinal == last.ordinal and event.emphatic
            more = draft.mentions or draft.passings or draft.at_end or event.commanded
            return same and not more
        if ordinal is not None and last.ordinal is None:
            return False
        if self._names_something_new(at, done):
            return False
        if event.forced or event.apposed or self._sentence:
            return True
        return self._follows_directly(
            at, same=ordinal is not None and ordinal == last.ordinal
        )

    def _follows_directly(self, at: int, *, same: bool) -> bool:
        event = self._events[at]
        for number in range(at - 1, -1, -1):
            earlier = self._events[number]
            if earlier.kind == "sentence":
                self._sentence = not earlier.counted
                return self._sentence
            if earlier.kind == "then":
                return False
            if earlier.kind == "turn":
                return same or event.commanded or earlier.commanded
        return False

    def _names_something_new(self, at: int, done: list[Draft]) -> bool:
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
