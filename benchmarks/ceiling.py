"""What reading allows: every plan followed in the mind, on the true map of its site.

For each shipped text: does the likeliest place to end lie within 3 m of the goal, and does
the heaviest alignment that ends there take the turns of the route?
`python -m benchmarks.ceiling` (docs/benches.md). With `--list` also the texts without an
error that mean something else, and what: by that one finds wrong plans without reading any.
"""

import argparse
import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from shapely import Point

from benchmarks.plan_walks import estimates, share
from benchmarks.reading import recorded_plans
from benchmarks.true_maps import (
    Followed,
    TrueMaps,
    ends_at,
    follow,
    in_frame,
    phrases_of,
)
from memorymaze.agents.agent import Journal
from memorymaze.agents.guide.alignments import Segment
from memorymaze.agents.guide.arriving import BEYOND_SIGN
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.starts import starts_ahead
from memorymaze.agents.plan_readers import GrammarReader
from memorymaze.evaluation.sampling import sample
from memorymaze.instructions import Episode, load_corpus
from memorymaze.instructions.records import DEVELOPED, HELD_OUT, is_of_split
from memorymaze.metrics.success import SUCCESS_DISTANCE
from memorymaze.routes import RoutePlan
from memorymaze.sites import Route, Site
from memorymaze.tables import Column, Table
from memorymaze.writing.route_facts import RouteFacts
from memorymaze.writing.turning_point_graph import TurningPointGraph

HALVES = {HELD_OUT: "other half", DEVELOPED: "development half"}


class TurnsOfRoute:
    """The crossings that who walks a route passes, and where they have to turn."""

    def __init__(self, route: Route, graph: TurningPointGraph) -> None:
        """Find them; corners without a choice, bends and the goal's door may be left out."""
        facts = RouteFacts(graph, route)
        goal = Point(route.line.coords[-1])
        self.passed = {point for _, point in graph.passed[route.id]}
        self.needed = {
            turn.at
            for turn in route.turns
            if not turn.direction.startswith("slight")
            and (heading := facts.headings.get(turn.at)) is not None
            and graph.only_way(turn.at, heading) is None
            and graph.points[turn.at].polygon.centroid.distance(goal) > BEYOND_SIGN
        }

    def are_taken(self, segment: Segment, numbers: Mapping[str, int]) -> bool:
        """Tell whether an alignment takes the turns of the route, and no others."""
        took = {at for _, at in segment.turns}
        took |= {each.at for each in segment.slips if each.kind == "turn left out"}
        needed = {numbers[point] for point in self.needed}
        passed = {0, *(numbers[point] for point in self.passed)}
        return needed <= took <= passed


@dataclass(frozen=True, slots=True)
class Meaning:
    """What the plan of a text means on the true map."""

    episode: Episode
    is_goal: bool
    """Whether it leads to the goal."""
    off: float
    """Metres from the likeliest place to end to the goal; infinite where there is none."""
    share_at_goal: float
    takes_the_turns: bool
    story: tuple[str, ...]
    """What the heaviest alignment to the likeliest place takes for the turns."""


class Readings:
    """Follows plans on the true maps of their sites."""

    def __init__(self, sites: Mapping[str, Site]) -> None:
        """Take the sites; their maps are made when they are first asked for."""
        self._sites = sites
        self._maps: dict[str, TrueMaps] = {}
        self._graphs: dict[str, TurningPointGraph] = {}

    def followed(
        self, episode: Episode, plan: RoutePlan, model: Likelihoods
    ) -> Followed:
        """Follow what was read of a text."""
        maps = self.maps(episode.instruction.site)
        start = episode.start
        floor = maps.floor_map(start, phrases_of(plan))
        starts = starts_ahead(model, floor, maps.crossing_at(start.x, start.y))
        return follow(plan, floor, starts, model, maps.pointing_signs)

    def meaning(self, episode: Episode, plan: RoutePlan, model: Likelihoods) -> Meaning:
        """Return where a plan leads, and by which turns."""
        told = episode.instruction
        followed = self.followed(episode, plan, model)
        best = followed.likeliest
        goal = in_frame(episode.start, episode.goal)
        if best is None:
            return Meaning(episode, False, math.inf, 0.0, False, ("it ends nowhere",))
        route = self._sites[told.site].route(told.reference_route)
        turns = TurnsOfRoute(route, self._graph(told.site))
        maps = self.maps(told.site)
        names = {number: point for point, number in maps.numbers.items()}
        ends = [
            f"turn {leg + 1} at {names.get(at, 'the start')}"
            for leg, at in best.segment.turns
        ]
        slips = [
            f"{each.kind} ({each.leg + 1}) at {names.get(each.at, 'a dead end')}"
            for each in best.segment.slips
        ]
        return Meaning(
            episode,
            ends_at(best, goal, SUCCESS_DISTANCE),
            math.dist(best.place, goal),
            followed.share_at(goal, SUCCESS_DISTANCE),
            turns.are_taken(best.segment, maps.numbers),
            (*ends, *slips, best.reason),
        )

    def maps(self, site: str) -> TrueMaps:
        """Return the maps of a site."""
        if site not in self._maps:
            self._maps[site] = TrueMaps(self._sites[site])
        return self._maps[site]

    def _graph(self, site: str) -> TurningPointGraph:
        if site not in self._graphs:
            self._graphs[site] = TurningPointGraph(self._sites[site])
        return self._graphs[site]


def rows(meanings: Sequence[Meaning]) -> Iterator[dict[str, object]]:
    """Yield what is told of texts by half, errors and study, the other half first."""
    for half, name in HALVES.items():
        for has_error in (False, True):
            for study in ("online", "onsite"):
                these = [
                    each
                    for each in meanings
                    if is_of_split(each.episode.instruction, half)
                    and bool(each.episode.instruction.failures) == has_error
                    and each.episode.instruction.study == study
                ]
                values = {
                    "goal": [float(each.is_goal) for each in these],
                    "turns": [float(each.takes_the_turns) for each in these],
                    "route": [
                        float(each.is_goal and each.takes_the_turns) for each in these
                    ],
                    "belief": [each.share_at_goal for each in these],
                }
                units = [each.episode.instruction.participant for each in these]
                yield {
                    "half": name,
                    "texts": "with an error" if has_error else "correct",
                    "study": study,
                    "n": len(these),
                    **estimates(values, units),
                }


def ceiling_table(meanings: Sequence[Meaning], reader: str) -> Table:
    """Return the shares of texts that lead to the goal, and that take the route."""
    return Table(
        f"Plans followed in the mind on the true maps ({reader})",
        (
            Column("half", "Half", role="group"),
            Column("texts", "Texts", role="label"),
            Column("study", "Study", role="label"),
            Column("n", "n"),
            share("goal", "Goal", "higher"),
            share("turns", "Turns", "higher"),
            share("route", "Both", "higher"),
            share("belief", "Belief at the goal", "higher"),
        ),
        tuple(rows(meanings)),
        notes=(
            f"Goal: who ends at the likeliest place comes within {SUCCESS_DISTANCE:g} m of "
            f"it (the place is up to {BEYOND_SIGN:g} m away where one goes on through a "
            "door or under a sign, 0.7 m more before a thing). "
            "Turns: its heaviest alignment takes those of the route and no others; corners "
            "without a choice and bends may be left out. Belief: share of it at "
            "such places. Intervals: 95 %, participants drawn again.",
        ),
        name="ceiling",
    )


def readings_otherwise(meanings: Sequence[Meaning]) -> Iterator[str]:
    """Yield a line for each text without an error that does not mean its route."""
    for each in sorted(meanings, key=lambda each: each.share_at_goal):
        told = each.episode.instruction
        if told.failures or (each.is_goal and each.takes_the_turns):
            continue
        yield (
            f"{told.id}: ends {each.off:.0f} m off, belief at the goal "
            f"{each.share_at_goal:.2f}: {'; '.join(each.story)}"
        )


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.ceiling")
    parser.add_argument(
        "--reader",
        choices=("plans", "grammar"),
        default="plans",
        help="recorded plans of a language model, or those of the grammar",
    )
    parser.add_argument(
        "--list", action="store_true", help="also what plans mean that miss their route"
    )
    parser.add_argument(
        "--sample", type=int, metavar="N", help="only so many texts, alike many a route"
    )
    options = parser.parse_args()
    corpus, readings = load_corpus(), Readings(load_corpus().sites)
    plans, grammar = recorded_plans("plans"), GrammarReader()
    meanings: list[Meaning] = []
    for episode in sample(corpus.episodes, options.sample):
        told = episode.instruction
        if options.reader == "grammar":
            plan = grammar.read(told.text, Journal())
        else:
            plan = plans[told.id]
        meanings.append(readings.meaning(episode, plan, Likelihoods()))
    print(ceiling_table(meanings, options.reader))
    if options.list:
        print("\n".join(readings_otherwise(meanings)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
