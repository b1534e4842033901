from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus import load_corpus
from memorymaze.texts.corpus.sail import Paragraph, load_sail

Line = Callable[..., dict[str, Any]]
Write = Callable[..., Path]

MAP_XML = """<map name="Small"><nodes>
<node x="1" y="1" item=""/><node x="2" y="1" item=""/><node x="2" y="2" item="easel"/>
</nodes><edges>
<edge node1="1,1" node2="2,1" floor="brick" wall="fish"/>
<edge node1="2,1" node2="2,2" floor="grass" wall="tower"/>
</edges></map>"""
PARAGRAPH_XML = """<examples>
<example file="Cleaned-ANN_Small0_1_2_Dirs_1.txt" map="Small">
<instruction>Go to the easel.  Stop there.</instruction>
<path>[(1, 1, -1), (1, 1, 90), (2, 1, 90), (2, 1, 180), (2, 2, 180)]</path></example>
<example file="Cleaned-BOB_Small0_1_2_Dirs_1.txt" map="Small">
<instruction>Fly.</instruction><path>[(1, 1, 90), (2, 2, 90)]</path></example>
</examples>"""


def test_a_folder_gives_its_mazes_and_its_paragraphs(small_folder: Path) -> None:
    corpus = load_sail(small_folder)
    maze = corpus.mazes["Small"]
    assert maze.shortest_way((1, 1), (2, 3)) == [(1, 1), (2, 1), (2, 2), (2, 3)]
    assert {node.thing for node in maze.nodes} == {None, "sofa", "easel"}
    there, back = corpus.paragraphs
    assert (there.writer, there.start, there.goal) == ("ANN", (1, 1), (2, 3))
    assert (there.followers, there.arrived, there.usable) == (4, 3, True)
    assert not back.usable


def test_the_original_xml_layout_is_read_too(tmp_path: Path) -> None:
    (tmp_path / "maps").mkdir()
    (tmp_path / "data").mkdir()
    (tmp_path / "maps" / "map-small.xml").write_text(MAP_XML)
    (tmp_path / "data" / "Paragraph.xml").write_text(PARAGRAPH_XML)
    corpus = load_sail(tmp_path)
    assert corpus.mazes["Small"].halls[1].floor == "grass"
    legal, flying = corpus.paragraphs
    assert legal == Paragraph(
        id="ANN-Small-1-2-1",
        maze="Small",
        writer="ANN",
        start_position=1,
        goal_position=2,
        start=(1, 1),
        goal=(2, 2),
        text="go to the easel . stop there",
        usable=True,
        followers=None,
        arrived=None,
    )
    assert not flying.usable


def test_a_folder_without_the_corpus_says_what_was_expected(tmp_path: Path) -> None:
    with pytest.raises(InstructionFileError, match=r"expected maps\.json and"):
        load_sail(tmp_path)
    with pytest.raises(InstructionFileError, match="no such folder"):
        load_sail(tmp_path / "nowhere")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        pytest.param({"map": "Big"}, "expected one of the maps Small", id="map"),
        pytest.param({"goal": [3, 1]}, "position 2", id="goal elsewhere"),
        pytest.param({"human_found": 5}, "at most as many followers", id="followers"),
        pytest.param({"text": ""}, "instructions.jsonl:1: text", id="no text"),
        pytest.param({"usable": "yes"}, "usable", id="a word for a truth value"),
    ],
)
def test_a_wrong_line_is_named(
    small_maps: dict[str, Any],
    small_line: Line,
    write_folder: Write,
    changes: dict[str, Any],
    message: str,
) -> None:
    folder = write_folder(small_maps, small_line(**changes))
    with pytest.raises(InstructionFileError, match=message):
        load_sail(folder)


def test_the_same_id_twice_is_refused(
    small_maps: dict[str, Any], small_line: Line, write_folder: Write
) -> None:
    folder = write_folder(small_maps, small_line(), small_line())
    with pytest.raises(InstructionFileError, match="expected an id once"):
        load_sail(folder)


@pytest.mark.parametrize(
    ("a", "b", "message"),
    [
        pytest.param([1, 1], [2, 2], "neighbouring nodes", id="diagonal"),
        pytest.param([1, 1], [0, 1], r"no node \[0, 1\]", id="into nothing"),
        pytest.param([2, 1], [1, 1], "there twice", id="both ways"),
    ],
)
def test_a_hall_that_cannot_be_is_named(
    small_maps: dict[str, Any],
    small_line: Line,
    write_folder: Write,
    a: list[int],
    b: list[int],
    message: str,
) -> None:
    edges = small_maps["maps"]["Small"]["edges"]
    edges.append({"a": a, "b": b, "floor": "blue", "wall": "fish"})
    with pytest.raises(InstructionFileError, match=message):
        load_sail(write_folder(small_maps, small_line()))


def test_a_maze_in_two_pieces_is_refused(
    small_maps: dict[str, Any], small_line: Line, write_folder: Write
) -> None:
    del small_maps["maps"]["Small"]["edges"][2]
    with pytest.raises(InstructionFileError, match="no way from node"):
        load_sail(write_folder(small_maps, small_line()))


def test_a_folder_of_sail_is_a_corpus_with_its_own_sites_and_limits(
    small_folder: Path,
) -> None:
    corpus = load_corpus(small_folder)
    assert (corpus.name, list(corpus.sites)) == ("SAIL", ["sail_small"])
    assert (len(corpus.instructions), len(corpus.episodes)) == (2, 8)
    limits = (corpus.success_distance, corpus.time_budget, corpus.detection_range)
    assert limits == (2.0, 400.0, 40.0)
    assert not corpus.start_heading_is_told
