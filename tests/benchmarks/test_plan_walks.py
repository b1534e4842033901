import argparse
from collections.abc import Callable
from pathlib import Path

from benchmarks.plan_walks import PlanWalk, buildings, by_floors, estimates, given_plans
from benchmarks.repair import KINDS, made_twins, mutants_of

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph


def test_made_buildings_stand_beside_the_shipped_ones_and_can_be_told_wrongly(
    tmp_path: Path,
) -> None:
    sites = buildings(argparse.Namespace(made=1, out=tmp_path))
    assert len(sites) == 4
    [made] = (tmp_path / "made").glob("*.geojson")
    graphs = {name: TurningPointGraph(site) for name, site in sites.items()}
    twins = list(made_twins(graphs))
    assert {twin.site.name for twin in twins} == {made.stem}
    mutants = list(mutants_of(twins[0], graphs[made.stem], seed=0))
    assert {mutant.kind for mutant in mutants} <= set(KINDS)
    assert len(mutants) >= 5


def test_agents_without_a_reader_are_left_as_they_are() -> None:
    assert given_plans(AgentSettings("oracle")).options == ()
    assert given_plans(AgentSettings("guide")).options == (("reader", "plan"),)


def test_a_reader_that_is_asked_for_stays() -> None:
    asked = AgentSettings("guide", options=(("reader", "grammar"),))
    assert given_plans(asked) == asked


def test_walks_on_made_floors_are_told_apart(
    result: Callable[..., EpisodeResult],
) -> None:
    walks = {
        name: PlanWalk(result(name, site=name), ())
        for name in ("museum_5f", "mall_0001")
    }
    assert {floors: list(part) for floors, part in by_floors(walks).items()} == {
        "shipped": ["museum_5f"],
        "made": ["mall_0001"],
    }


def test_what_shares_a_unit_is_drawn_together() -> None:
    row = estimates({"sr": [1.0, 1.0, 0.0, 0.0]}, ["a", "a", "b", "b"])
    assert (row["sr"], row["sr_low"], row["sr_high"]) == (0.5, 0.0, 1.0)
