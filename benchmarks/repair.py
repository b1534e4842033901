"""Whether agents notice that what they were told is wrong, and arrive nevertheless.

What a language model read in the shipped texts without an error is walked as it stands
(the twin), and with one error of a known kind at a known place (the mutants), so that no
reading of language is measured: `python -m benchmarks.repair [--sample N]`
(docs/lab/benches.md, which also says how an agent tells that it doubts).
"""

import math
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from shapely import Point

from benchmarks.plan_walks import (
    RESAMPLES,
    PlanWalk,
    agents_of,
    buildings,
    by_floors,
    estimates,
    labels,
    parser_of,
    plan_instruction,
    share,
    walk_plans,
)
from benchmarks.reading import recorded_plans
from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.tables import Column, Table
from memorymaze.language.plans import Arrival, Leg, Mention, RoutePlan, Turn
from memorymaze.runs.episodes.sampling import sample
from memorymaze.runs.metrics.success import success_within_way
from memorymaze.texts.corpus import Instruction, load_corpus
from memorymaze.texts.writing.mistakes import possible_mistakes
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.steps import Mistake, Step
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph, side_of_turn
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Route, Site

PLACES_AT_THE_TURN = ("turn", "beside", "before_turn", "after_turn", "opposite")
KINDS: Mapping[str, str] = {
    "wrong_direction": "wrong side of a turn",
    "wrong_turning_point": "wrong turning point",
    "extra_turn": "extra turn",
    "missing_turn": "missing turn",
    "incorrect_direction": "wrong start",
    "wrong_destination": "wrong destination",
    "inaccurate_environment": "thing that is not there",
}
"""`wrong_direction_at_turn` is the first of them, as the onsite study calls it."""
WAYS = (1.0, 1.5, 2.0, 3.0)
"""Times the way told."""
NO_ERROR, ALL_ERRORS = "no error (twins)", "all errors"
SURE = 0.5
"""Score of a doubt from which on it counts as said."""

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Twin:
    """A right plan on a site, and which of its legs tell which turns of the route."""

    name: str
    site: Site
    route: Route
    plan: RoutePlan
    legs: Mapping[str, int]
    """By the keys of the steps of `RouteFacts.plan`."""


@dataclass(frozen=True, slots=True)
class Mutant:
    """A plan with one error, and where that is."""

    name: str
    twin: Twin
    kind: str
    plan: RoutePlan
    place: Place


def recorded_twins(
    count: int | None, graphs: Mapping[str, TurningPointGraph]
) -> Iterator[Twin]:
    """Yield the recorded plans of shipped texts without errors that tell their turns."""
    plans = recorded_plans("plans")
    corpus = load_corpus()
    right = [each for each in corpus.episodes if not each.instruction.failures]
    for episode in sample(right, count):
        told = episode.instruction
        site = corpus.sites[told.site]
        route = site.find_route(told.reference_route)
        plan = plans[told.id]
        legs = legs_of_turns(plan, RouteFacts(graphs[site.name], route))
        if legs is not None:
            yield Twin(told.id, site, route, plan, legs)


def made_twins(graphs: Mapping[str, TurningPointGraph]) -> Iterator[Twin]:
    """Yield right descriptions of the reference routes of made buildings."""
    for name, graph in graphs.items():
        for route in graph.site.routes:
            if route.role == "reference" and name not in BUILTIN_SITE_NAMES:
                facts = RouteFacts(graph, route)
                plan = facts.plan.said
                legs = legs_of_turns(plan, facts)
                if legs is not None:
                    yield Twin(f"{name}-{route.id}", graph.site, route, plan, legs)


def legs_of_turns(plan: RoutePlan, facts: RouteFacts) -> dict[str, int] | None:
    """Return the legs that tell the turns of a route; None where that is not clear.

    Corners without a choice may be left out, or be told without their side.
    """
    turns = facts.route.turns
    ways = [_side(leg.turn.way) for leg in plan.legs]
    sides = [_side(side_of_turn(turn)) for turn in turns]
    free = [
        number
        for number, turn in enumerate(turns)
        if (heading := facts.headings.get(turn.at)) is not None
        and facts.graph.only_way(turn.at, heading) is not None
    ]
    found = [
        told
        for told in combinations(range(len(sides)), len(ways))
        if all(number in told or number in free for number in range(len(sides)))
        and all(
            way == sides[number] or (way == "either" and number in free)
            for way, number in zip(ways, told, strict=True)
        )
    ]
    if len(found) != 1:
        return None
    return {f"turn{number}": leg for leg, number in enumerate(found[0])}


def _side(way: str) -> str:
    return way.removeprefix("slight_")


def mutants_of(twin: Twin, graph: TurningPointGraph, seed: int) -> Iterator[Mutant]:
    """Yield a twin with one error of each kind, where the way has room for it.

    Whoever follows the turns that are told then does not arrive.
    """
    facts = RouteFacts(graph, twin.route)
    for kind in KINDS:
        rng = np.random.default_rng([seed, *twin.name.encode(), *kind.encode()])
        try:
            proposals = list(possible_mistakes(facts, facts.plan, kind, rng))
        except SitePlanError:
            return
        for mistake in proposals:
            plan = mutated(twin, mistake)
            if plan is not None and plan != twin.plan:
                place = _place_of(mistake, twin, graph)
                yield Mutant(f"{twin.name}+{kind}", twin, kind, plan, place)
                break


def mutated(twin: Twin, mistake: Mistake) -> RoutePlan | None:
    """Put the error of a right description into a plan that somebody else told.

    None where that plan does not tell what the error is in.
    """
    if mistake.key == "arrival":
        return _with_ending(twin, mistake)
    legs, steps = list(twin.plan.legs), mistake.plan.turns
    told = {step.key: twin.legs[step.key] for step in steps if step.key in twin.legs}
    if mistake.part == "gone" and mistake.key in twin.legs:
        del legs[twin.legs[mistake.key]]
    elif mistake.part in {"side", "cue"} and mistake.key in told:
        [step] = [each for each in steps if each.key == mistake.key]
        change = _with_side if mistake.part == "side" else _with_cue
        legs[told[step.key]] = change(legs[told[step.key]], step)
    elif mistake.part == "step" and mistake.key == "start":
        legs.insert(0, Leg(Turn("around"), on_the_spot=True))
    elif mistake.part == "step":
        place = [each.key for each in steps].index(mistake.key)
        later = [told[each.key] for each in steps[place:] if each.key in told]
        legs.insert(min(later, default=len(legs)), steps[place].leg)
    else:
        return None
    return replace(twin.plan, legs=tuple(legs))


def _with_side(leg: Leg, step: Step) -> Leg:
    return replace(leg, turn=replace(leg.turn, way=step.side, forced=False))


def _with_cue(leg: Leg, step: Step) -> Leg:
    """Return a leg that tells another place to turn, and nothing of the right one."""
    said = step.leg
    kept = tuple(each for each in leg.mentions if each.place not in PLACES_AT_THE_TURN)
    there = tuple(each for each in said.mentions if each.place == "turn")
    turn = Turn(leg.turn.way, ordinal=said.turn.ordinal, doubt=leg.turn.doubt)
    return replace(leg, turn=turn, mentions=(*kept, *there), too_far=())


def _with_ending(twin: Twin, mistake: Mistake) -> RoutePlan:
    """Return a plan that ends at what is wrongly taken for the destination."""
    ending = mistake.plan.ending
    kept = {step.key for step in mistake.plan.turns}
    cut = [leg for key, leg in twin.legs.items() if key not in kept]
    legs = twin.plan.legs[: min(cut)] if cut else twin.plan.legs
    mentions = (
        (Mention(ending.by.words, ending.by.kind, "beside"),) if ending.by else ()
    )
    told = twin.plan.arrival
    arrival = Arrival(
        told.destinations,
        side=ending.side,
        mentions=mentions,
        doubt=told.doubt,
        unclear=told.unclear,
    )
    return replace(twin.plan, legs=legs, arrival=arrival)


def _place_of(mistake: Mistake, twin: Twin, graph: TurningPointGraph) -> Place:
    """Return where a plan goes wrong: a turning point, the start, or the wrong end."""
    if mistake.key == "arrival":
        return mistake.plan.ending.place
    point = graph.points.get(mistake.where.removeprefix("after "))
    centre = (
        Point(twin.route.line.coords[0]) if point is None else point.polygon.centroid
    )
    return centre.x, centre.y


class Doubt(NamedTuple):
    """How much an agent doubted on a walk, and where it first said so."""

    score: float
    place: Place | None
    """None where it never did."""


def doubts_of(walks: Mapping[str, PlanWalk]) -> dict[str, Doubt]:
    """Return the doubts of an agent on its walks.

    An agent says them by notes of the kind `doubt`, with a `score` from 0 to 1; those of
    at least 0.5 count as said.
    """
    told = {
        name: [
            (float(note.details["score"]), note.place)
            for note in walk.notes
            if note.about == "doubt" and "score" in note.details
        ]
        for name, walk in walks.items()
    }
    return {
        name: Doubt(
            max((score for score, _ in scores), default=0.0),
            next((place for score, place in scores if score >= SURE), None),
        )
        for name, scores in told.items()
    }


def area_under_curve(wrong: ArrayLike, right: ArrayLike) -> float:
    """Return how often a wrong case has the higher score than a right one; ties half.

    >>> area_under_curve([3, 2], [1, 2])
    0.875
    """
    above = np.subtract.outer(np.asarray(wrong, float), np.asarray(right, float))
    return float(((above > 0) + 0.5 * (above == 0)).mean())


def auc_fields(
    doubts: Mapping[str, Doubt], mutants: Sequence[Mutant], twins: Sequence[str]
) -> dict[str, float | None]:
    """Return the area under the curve with its interval: texts are drawn again."""
    wrong = {m.name: (doubts[m.name].score, twins.index(m.twin.name)) for m in mutants}
    right = np.array([doubts[name].score for name in twins])
    scores, texts = map(np.array, zip(*wrong.values(), strict=True))
    rng = np.random.default_rng(0)
    drawn: list[float] = []
    for _ in range(RESAMPLES):
        times = np.bincount(
            rng.integers(len(twins), size=len(twins)), minlength=len(twins)
        )
        again = np.repeat(scores, times[texts.astype(int)])
        if len(again):
            drawn.append(area_under_curve(again, np.repeat(right, times)))
    low, high = np.quantile(drawn, [0.025, 0.975])
    return {
        "auc": area_under_curve(scores, right),
        "auc_low": float(low),
        "auc_high": float(high),
    }


def repair_rows(
    walks: Mapping[str, PlanWalk], mutants: Sequence[Mutant]
) -> Iterator[dict[str, object]]:
    """Yield what is told of an agent: of the twins, of each kind of error, and of all."""
    twins = sorted({each.twin.name for each in mutants})
    doubts = doubts_of(walks)
    tells = any(doubt.score for doubt in doubts.values())
    values = _values(walks, twins)
    if tells:
        values["doubted"] = _doubted(doubts, twins)
        pairs = zip(values["doubted"], values["sr"], strict=True)
        values["spoiled"] = [said * (1.0 - arrived) for said, arrived in pairs]
    yield {"kind": NO_ERROR, "n": len(twins), **estimates(values, twins)}
    for kind, heading in [*KINDS.items(), (None, ALL_ERRORS)]:
        these = [each for each in mutants if kind in {None, each.kind}]
        if not these:
            continue
        row: dict[str, object] = {"kind": heading, "n": len(these)}
        texts = [each.twin.name for each in these]
        names = [each.name for each in these]
        values = _values(walks, names)
        if tells:
            values["doubted"] = _doubted(doubts, names)
            row |= auc_fields(doubts, these, twins)
            row["off"] = _median_off(doubts, these)
        able = [each for each in these if walks[each.twin.name].result.success]
        repaired = [float(walks[each.name].result.success) for each in able]
        row["repaired"] = float(np.mean(repaired)) if able else None
        yield row | estimates(values, texts)


def _doubted(doubts: Mapping[str, Doubt], names: Sequence[str]) -> list[float]:
    return [float(doubts[name].place is not None) for name in names]


def _values(
    walks: Mapping[str, PlanWalk], names: Sequence[str]
) -> dict[str, list[float]]:
    results = [walks[name].result for name in names]
    within = {
        f"within_{times:g}": [
            success_within_way(
                each.path_length, each.way_m or 0.0, times, is_success=each.success
            )
            for each in results
        ]
        for times in WAYS
    }
    return {
        "sr": [float(each.success) for each in results],
        **within,
    }


def _median_off(doubts: Mapping[str, Doubt], mutants: Sequence[Mutant]) -> float | None:
    """Return the metres from an error to where it was first doubted."""
    places = [(doubts[each.name].place, each.place) for each in mutants]
    off = [math.dist(first, error) for first, error in places if first is not None]
    return float(np.median(off)) if off else None


def repair_table(rows: Sequence[Mapping[str, object]]) -> Table:
    return Table(
        "Plans with one error, beside the same plans without",
        (
            Column("kind", "Error", role="group"),
            *labels(rows),
            Column("n", "n"),
            share("auc", "AUC", "higher"),
            Column("doubted", "Doubted", digits=2),
            Column("off", "Off (m)", digits=0),
            share("sr", "SR", "higher"),
            *(Column(f"within_{t:g}", f"{t:g} x", digits=2) for t in WAYS),
            Column("repaired", "Repaired", digits=2),
            Column("spoiled", "Spoiled", digits=2),
        ),
        tuple(rows),
        notes=(
            "AUC: how well the agent's doubt tells plans with the error from those "
            "without. Doubted: share in which it said so. Off: metres from the error "
            "to where it first did, median. 1 x to 3 x: success within so many times the way "
            "told. Repaired: success of those whose twin arrives. Spoiled: twins that "
            "were doubted and did not arrive. Intervals: 95 %, texts drawn again.",
        ),
        name="repair",
    )


def main() -> int:
    parser = parser_of("repair", "only so many texts, alike many of every route")
    options = parser.parse_args()
    sites = buildings(options)
    graphs = {name: TurningPointGraph(site) for name, site in sites.items()}
    twins = [*recorded_twins(options.sample, graphs), *made_twins(graphs)]
    mutants = [
        mutant
        for twin in twins
        for mutant in mutants_of(twin, graphs[twin.site.name], options.seed)
    ]
    told = list(_told(twins, mutants))
    kinds = Counter(each.kind for each in mutants)
    print(
        f"{len(twins)} plans, {len(mutants)} with an error: {dict(kinds)}",
        file=sys.stderr,
    )
    rows: list[dict[str, object]] = []
    for agent in agents_of(options):
        walks = walk_plans(agent, told, sites, options)
        for floors, part in by_floors(walks).items():
            there = [each for each in mutants if each.name in part]
            told_of = {"floors": floors, "agent": agent.name}
            rows += [told_of | row for row in repair_rows(part, there)]
    order = [NO_ERROR, *KINDS.values(), ALL_ERRORS]
    rows.sort(key=lambda row: order.index(str(row["kind"])))
    print(repair_table(rows))
    return 0


def _told(twins: Sequence[Twin], mutants: Sequence[Mutant]) -> Iterator[Instruction]:
    for each in twins:
        yield plan_instruction(each.name, each.site, each.route, each.plan)
    for each in mutants:
        yield plan_instruction(each.name, each.twin.site, each.twin.route, each.plan)


if __name__ == "__main__":
    sys.exit(main())
