import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import pytest

from memorymaze.basics.errors import InstructionFileError, SettingsError
from memorymaze.texts.corpus import (
    BUILTIN_CORPUS,
    Instruction,
    episodes,
    load_corpus,
    load_instructions,
)
from memorymaze.texts.corpus.spreadsheets import write_spreadsheet
from memorymaze.world.sites import Site

Line = Callable[..., dict[str, Any]]
Write = Callable[..., Path]


def test_every_shipped_instruction_becomes_an_episode_on_the_way_it_describes(
    builtin_sites: dict[str, Site],
) -> None:
    made = episodes(load_instructions(), builtin_sites)
    assert len({episode.id for episode in made}) == 564
    for episode in made:
        site = builtin_sites[episode.instruction.site]
        route = site.find_route(episode.instruction.reference_route)
        assert episode.start == route.start
        assert episode.goal == route.line.coords[-1]
        assert episode.reference_path == tuple(route.line.coords)


def test_an_alternative_way_is_the_reference_of_its_episode(
    line: Line, instruction_file: Write, tiny_sites: dict[str, Site]
) -> None:
    alternative = next(r for r in tiny_sites["loop"].routes if r.role == "alternative")
    path = instruction_file(line(), line(id="b", reference_route=alternative.id))
    first, second = episodes(load_instructions([path]), tiny_sites)
    assert second.reference_path == tuple(alternative.line.coords)
    assert first.reference_path != second.reference_path
    assert first.goal == pytest.approx(second.goal)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        pytest.param({"site": "lop"}, "did you mean 'loop'", id="site"),
        pytest.param({"route": "R9"}, "'route': expected one of R1", id="route"),
        pytest.param({"reference_route": "r"}, "'reference_route'", id="reference"),
        pytest.param(
            {"site": "t_junction", "route": "R2"},
            "expected a way of R2",
            id="way of another route",
        ),
    ],
)
def test_a_place_that_does_not_exist_is_named_with_file_and_line(
    line: Line,
    instruction_file: Write,
    tiny_sites: dict[str, Site],
    changes: dict[str, Any],
    said: str,
) -> None:
    path = instruction_file(line(), line(id="b", **changes))
    with pytest.raises(InstructionFileError) as caught:
        episodes(load_instructions([path]), tiny_sites)
    assert f"{path}:2: field" in str(caught.value)
    assert said in str(caught.value)


def test_the_shipped_corpus_leaves_all_limits_to_the_run() -> None:
    corpus = load_corpus()
    assert (corpus.name, len(corpus.episodes)) == ("memorymaze", 564)
    assert corpus.files == (BUILTIN_CORPUS,)
    assert (corpus.success_distance, corpus.time_budget) == (None, None)
    assert repr(corpus) == (
        "Corpus('memorymaze': 564 instructions, 564 episodes on university, museum_5f, "
        "museum_7f)"
    )


def test_a_file_is_loaded_with_a_folder_of_plans_or_with_sites(
    line: Line,
    instruction_file: Write,
    tiny_sites_folder: Path,
    tiny_sites: dict[str, Site],
) -> None:
    path = instruction_file(line())
    by_folder = load_corpus(path, sites=tiny_sites_folder)
    by_sites = load_corpus([path], sites=[tiny_sites["loop"]])
    assert by_folder.instructions == by_sites.instructions
    assert list(by_sites.sites) == ["loop"]
    with pytest.raises(InstructionFileError, match="'site': expected one of museum"):
        load_corpus(path)


def test_a_folder_with_plans_and_instructions_is_a_corpus(
    line: Line, instruction_file: Write, tiny_sites: dict[str, Site], tmp_path: Path
) -> None:
    shutil.copy(tiny_sites["loop"].source, tmp_path)
    instruction_file(line(), name="first.jsonl")
    instruction_file(line(id="b"), name="second.jsonl")
    corpus = load_corpus(tmp_path)
    assert [episode.id for episode in corpus.episodes] == ["a-1", "b"]
    assert [path.name for path in corpus.files] == ["first.jsonl", "second.jsonl"]
    with pytest.raises(SettingsError, match="leave out the sites"):
        load_corpus(tmp_path, sites=tmp_path)


def test_tables_in_a_folder_are_instruction_files(
    line: Line, instruction_file: Write, tiny_sites: dict[str, Site], tmp_path: Path
) -> None:
    shutil.copy(tiny_sites["loop"].source, tmp_path)
    instruction_file(line(), name="first.jsonl")
    told = load_instructions([tmp_path / "first.jsonl"])
    kinds: list[Literal["csv", "parquet"]] = ["csv", "parquet"]
    for kind in kinds:
        others = [replace(each, id=kind) for each in told]
        write_spreadsheet(tmp_path / f"more.{kind}", others, kind)
    corpus = load_corpus(tmp_path)
    assert [episode.id for episode in corpus.episodes] == ["a-1", "csv", "parquet"]


def test_a_folder_without_instructions_or_plans_says_what_was_expected(
    line: Line, instruction_file: Write, tmp_path: Path
) -> None:
    with pytest.raises(
        InstructionFileError, match=r"SAIL corpus.* got none of the fil"
    ):
        load_corpus(tmp_path)
    instruction_file(line(), name="first.jsonl")
    with pytest.raises(InstructionFileError, match=r"none of the plans; .*are listed"):
        load_corpus(tmp_path)


def test_what_an_instruction_leaves_out_is_filled_in_by_its_site(
    tiny_sites: dict[str, Site],
) -> None:
    told = [
        Instruction(site="loop", route="R1", text=" Turn left. "),
        Instruction(site="t_junction", route="R2", text="Turn right."),
    ]
    first, second = episodes(told, tiny_sites)
    assert (first.id, second.id) == ("instruction-1", "instruction-2")
    assert first.instruction.text == "Turn left."
    assert first.instruction.participant == "instruction-1"
    assert first.instruction.reference_route == "route_r1_reference"
    assert second.goal == tiny_sites["t_junction"].find_route("R2").line.coords[-1]


def test_the_halves_read_and_not_read_while_developing_are_splits() -> None:
    corpus = load_corpus()
    halves = {name: corpus.of_split(name) for name in ("developed", "held_out")}
    assert {name: len(half) for name, half in halves.items()} == {
        "developed": 278,
        "held_out": 286,
    }
    people = [
        {each.instruction.participant for each in half} for half in halves.values()
    ]
    assert people[0].isdisjoint(people[1])
    assert len(corpus.of_split("dev")) == 10
    assert corpus.of_split(None) == corpus.episodes


def test_a_corpus_of_ones_own_has_no_halves(
    line: Line, instruction_file: Write, tiny_sites: dict[str, Site]
) -> None:
    corpus = load_corpus(instruction_file(line()), sites=[tiny_sites["loop"]])
    assert len(corpus.of_split("test")) == 1
    for split in ("held_out", "held-out", "dev"):
        with pytest.raises(SettingsError, match=f"one of test, got '{split}'"):
            corpus.of_split(split)
    with pytest.raises(SettingsError, match="did you mean 'held_out'"):
        load_corpus().of_split("held-out")
