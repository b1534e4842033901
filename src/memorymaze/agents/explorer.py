"""The explorer: searches the floor for the destination, whatever way was told."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.agents.notes import (
    ArrivalNote,
    DecisionNote,
    DestinationNote,
    GaveUpNote,
)
from memorymaze.agents.plan_readers import ReaderOptions, ReadsFirst
from memorymaze.agents.walking.approaching import walk_up_to
from memorymaze.agents.walking.floor_map import Sighting
from memorymaze.agents.walking.walker import BACK, Walker
from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.basics.options import check_number
from memorymaze.language.models.model import LanguageModel
from memorymaze.language.plans import Arrival
from memorymaze.language.reading import (
    is_common,
    is_floor,
    place_on_sign,
)
from memorymaze.robot.api.control import Robot


@dataclass(frozen=True, slots=True)
class ExplorerOptions(ReaderOptions):
    """What can be set of the explorer."""

    least_score: float = 0.65
    """Score of a detection from which on it is taken for the destination, 0 to 1."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_number("--set least_score", self.least_score, 0, 1)


class ExplorerAgent(ReadsFirst):
    """Takes only the words for the destination from a text, and looks everywhere.

    It walks to the nearest way that it has not tried and stops where it sees the name,
    on a sign or as a thing. What it reaches needs no description of the way.
    """

    Options = ExplorerOptions

    def __init__(
        self, options: ExplorerOptions | None = None, model: LanguageModel | None = None
    ) -> None:
        """Make the agent with its options, and a model where one reads."""
        self.options = options or ExplorerOptions()
        super().__init__(self.options, model)

    @property
    def name(self) -> str:
        """`explorer`, or `explorer[model]` where a model reads."""
        return f"explorer{self.reader.variant}"

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Try one way after another until the destination named is seen, and stop.

        Notes in the journal: `destination`, `decision` for each way tried, and at the
        end `arrival` or `gave_up`.
        """
        names = _destination_names(self.reader.read(instruction, journal).arrival)
        journal.add(DestinationNote(names))
        walker = Walker(robot)
        walker.map.crossings[walker.at].add_exit(math.pi)
        found: list[Sighting] = []

        def is_found(seen: list[Sighting]) -> bool:
            sure = (each for each in seen if each.score >= self.options.least_score)
            there = (each for each in sure if not walker.points_on(each))
            found.extend(islice(there, 1))
            return bool(found)

        ways = untried_ways(walker, rng) if names else iter(())
        for crossing, exit in ways:
            journal.add(DecisionNote(crossing, exit))
            if walker.go_to(crossing):
                walker.follow_exit(exit, names, is_found)
            else:
                walker.map.crossings[crossing].closed.add(exit)
            if found:
                reason = f"{found[0].phrase} seen as {found[0].label}"
                journal.add(ArrivalNote(reason, score=found[0].score))
                walk_up_to(walker, found[0], names)
                break
        else:
            why = "every way is tried" if names else "the text names no destination"
            journal.add(GaveUpNote(why))
        robot.stop()


def _destination_names(arrival: Arrival) -> tuple[str, ...]:
    """Return what to look for: the names of the destination, the best first.

    Of a sign what it names; things that are everywhere only where nothing else is told.

    >>> _destination_names(Arrival(("glass door", "sign that says Terrace")))
    ('Terrace',)
    """
    told = [place_on_sign(each) or each for each in arrival.destinations]
    by_words = {each.casefold(): each for each in reversed(told) if not is_floor(each)}
    names = tuple(reversed(by_words.values()))
    return tuple(each for each in names if not is_common(each)) or names


def untried_ways(walker: Walker, rng: np.random.Generator) -> Iterator[tuple[int, int]]:
    """Yield the nearest way that was not tried, as crossing and exit, while there is one.

    Of the ways at a crossing one is drawn by lot: on a handful of routes any fixed order
    would be a lucky or an unlucky one. Only what lies behind the robot comes last.
    """
    crossings = walker.map.crossings
    while True:
        away = walker.map.distances_from(walker.at)
        ways = [
            (
                away[number],
                abs(wrap_angle(crossings[number].exits[exit] - walker.heading)) >= BACK,
                rng.random(),
                number,
                exit,
            )
            for number, exit in walker.map.ways_out()
            if number in away and (number, exit) not in walker.map.stretches
        ]
        if not ways:
            return
        *_, crossing, exit = min(ways)
        yield crossing, exit
