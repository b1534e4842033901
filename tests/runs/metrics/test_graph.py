import math

import pytest

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.graph import WeightedGraph

TRIANGLE = WeightedGraph(
    "abcd", [("a", "b", 1.0), ("b", "c", 1.0), ("a", "c", 9.0), ("c", "b", 4.0)]
)


def test_distances_are_those_of_the_shortest_way_not_of_the_edge() -> None:
    assert TRIANGLE.between("a", "abc").tolist() == [[0, 1, 2]]
    assert TRIANGLE.along("acb").tolist() == [2, 1]


def test_of_several_edges_the_shortest_counts_in_any_order() -> None:
    for lengths in ([1.0, 4.0], [4.0, 1.0]):
        twice = WeightedGraph("ab", [("a", "b", metres) for metres in lengths])
        assert twice.between("a", "b").tolist() == [[1.0]]


def test_an_edge_of_no_length_joins_its_nodes() -> None:
    assert WeightedGraph("ab", [("a", "b", 0.0)]).between("a", "b").tolist() == [[0]]


def test_an_edge_to_itself_changes_nothing() -> None:
    assert WeightedGraph("a", [("a", "a", 5.0)]).along("aa").tolist() == [0]


def test_nodes_without_a_way_between_are_infinitely_far() -> None:
    assert TRIANGLE.between("a", "d").tolist() == [[math.inf]]


def test_a_graph_without_edges_has_its_nodes() -> None:
    assert WeightedGraph("a", []).between("a", "a").tolist() == [[0]]


def test_a_single_node_has_no_steps() -> None:
    assert TRIANGLE.along("a").tolist() == []


def test_an_unknown_node_is_named_with_its_place() -> None:
    with pytest.raises(UndefinedMetricError, match="unknown node 'z' at place 1"):
        TRIANGLE.along("az")


@pytest.mark.parametrize(
    ("edge", "message"),
    [
        (("a", "z", 1.0), r"edge 1 \('a' to 'z'\): unknown node 'z'"),
        (("a", "b", -1.0), r"edge 1 .* got -1\.0"),
        (("a", "b", math.nan), "edge 1 .* got nan"),
        (("a", "b", math.inf), "edge 1 .* got inf"),
    ],
)
def test_a_bad_edge_is_named(edge: tuple[str, str, float], message: str) -> None:
    with pytest.raises(UndefinedMetricError, match=message):
        WeightedGraph("ab", [("a", "b", 1.0), edge])
