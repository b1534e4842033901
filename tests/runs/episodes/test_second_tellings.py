"""Both tellings of a way by one person, handed to the agent as one text."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.agents.agent import tellings_of
from memorymaze.basics.errors import SettingsError
from memorymaze.runs.episodes.estimates import said_beforehand
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.settings import RunSettings, Shard, differences
from memorymaze.runs.episodes.shards import part_folder
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import read_instructions, read_run
from memorymaze.texts.corpus import Corpus, load_corpus
from memorymaze.texts.corpus.corpus import episodes
from memorymaze.texts.corpus.records import Failure, Instruction, Span

Plan = Callable[..., RunPlan]
BOTH = RunSettings(second_telling=True)


def corpus_of(corpus: Corpus, *changed: Instruction) -> Corpus:
    """The corpus with some instructions in the place of those of their ids, or added."""
    told = {each.id: each for each in (*corpus.instructions, *changed)}
    return replace(corpus, episodes=tuple(episodes(told.values(), corpus.sites)))


def told(corpus: Corpus, name: str) -> Instruction:
    return next(each for each in corpus.instructions if each.id == name)


def test_the_agent_is_handed_both_tellings_of_a_person_in_their_order(
    tiny_plan: Plan, tiny_corpus: Corpus
) -> None:
    plan = tiny_plan("stop", second_telling=True)
    assert [each.id for each in plan.episodes] == [f"p{n}-2" for n in range(1, 7)]
    assert tellings_of(plan.episodes[0].instruction.text) == (
        told(tiny_corpus, "p1-1").text,
        told(tiny_corpus, "p1-2").text,
    )


def test_people_who_told_the_way_once_are_left_out_and_counted(
    tiny_corpus: Corpus,
) -> None:
    alone = replace(told(tiny_corpus, "p2-1"), id="p7-1", participant="p7")
    plan = plan_run("stop", corpus_of(tiny_corpus, alone), BOTH)
    assert (len(plan.episodes), plan.settings.told_once) == (6, 1)
    assert any("left out: 1 text" in line for line in said_beforehand(plan))


def test_a_corpus_without_second_tellings_is_refused(tiny_corpus: Corpus) -> None:
    firsts = [each for each in tiny_corpus.instructions if each.iteration == 1]
    once = replace(tiny_corpus, episodes=tuple(episodes(firsts, tiny_corpus.sites)))
    with pytest.raises(SettingsError, match="told a way twice"):
        plan_run("stop", once, BOTH)


def test_two_texts_of_one_iteration_by_one_person_are_refused(
    tiny_corpus: Corpus,
) -> None:
    again = replace(told(tiny_corpus, "p1-2"), id="p1-3", text="Or so.")
    with pytest.raises(SettingsError, match="p1-1, p1-2, p1-3"):
        plan_run("stop", corpus_of(tiny_corpus, again), BOTH)


def test_a_text_mended_by_a_generator_is_no_telling_beside_its_original(
    tiny_corpus: Corpus,
) -> None:
    wrong = replace(told(tiny_corpus, "p6-2"), pair="p6-2")
    mended = replace(wrong, id="p6-2-right", text="Mended.", failures=())
    plan = plan_run("stop", corpus_of(tiny_corpus, wrong, mended), BOTH)
    assert plan.episodes[-1].tellings[1].id == "p6-2"
    assert plan.settings.told_once == 1


def test_the_way_of_the_second_telling_is_what_counts(tiny_corpus: Corpus) -> None:
    site = tiny_corpus.sites["loop"]
    other = next(
        route
        for route in site.routes
        if route.route == "R1" and route.id != "route_r1_reference"
    )
    second = replace(told(tiny_corpus, "p5-2"), reference_route=other.id)
    plan = plan_run("stop", corpus_of(tiny_corpus, second), BOTH)
    episode = next(each for each in plan.episodes if each.id == "p5-2")
    assert episode.instruction.reference_route == other.id
    assert episode.start == other.start


def test_errors_and_labelled_words_of_both_tellings_are_kept(
    tiny_corpus: Corpus, tmp_path: Path
) -> None:
    first, second = (told(tiny_corpus, f"p6-{number}") for number in (1, 2))
    word = second.text.split()[0]
    first = replace(first, failures=(Failure("missing_turn", "t1", ""),) * 2)
    second = replace(second, spans=(Span("filler", 0, len(word)),))
    plan = plan_run("stop", corpus_of(tiny_corpus, first, second), BOTH)
    joined = plan.episodes[-1].instruction
    [span] = joined.spans
    assert joined.text[span.start : span.end] == word
    run_plan(plan, tmp_path / "run", workers=1)
    result = read_run(tmp_path / "run")[1][-1]
    assert result.error_kinds == ("missing_turn", "missing_turn", "wrong_direction")
    assert result.errors_of_tellings == (2, 1)


def test_a_pair_with_a_development_text_is_a_development_text(
    tiny_corpus: Corpus,
) -> None:
    first = replace(told(tiny_corpus, "p3-1"), split="dev")
    second = replace(told(tiny_corpus, "p3-2"), split="test")
    corpus = corpus_of(tiny_corpus, first, second)
    chosen = plan_run("stop", corpus, replace(BOTH, split="dev")).episodes
    assert "p3-2" in {each.id for each in chosen}


def test_the_pair_has_an_id_of_its_own_and_the_episode_that_of_the_second(
    tiny_plan: Plan, tmp_path: Path
) -> None:
    run_plan(tiny_plan("stop", second_telling=True), tmp_path / "run", workers=1)
    _, results = read_run(tmp_path / "run")
    assert (results[0].episode_id, results[0].instruction_id) == ("p1-2", "p1-1+p1-2")
    kept = read_instructions(tmp_path / "run")
    assert {each.id for each in kept} == {each.instruction_id for each in results}


def test_the_setting_is_kept_and_compared(tiny_plan: Plan, tmp_path: Path) -> None:
    plan = tiny_plan("stop", second_telling=True)
    run_plan(plan, tmp_path / "run", workers=1)
    kept = read_run(tmp_path / "run")[0].settings
    assert kept.second_telling
    found = differences(tiny_plan("stop").settings, kept)
    assert "second_telling: False there, True here" in map(str, found)


def test_shards_and_limits_take_whole_pairs(tiny_plan: Plan, tmp_path: Path) -> None:
    assert len(tiny_plan("stop", second_telling=True, limit=4).episodes) == 4
    for shard in (Shard(1, 2), Shard(2, 2)):
        part = tiny_plan("stop", second_telling=True, shard=shard)
        run_plan(part, part_folder(tmp_path, shard), workers=1)
    assert [each.episode_id for each in read_run(tmp_path)[1]] == [
        f"p{n}-2" for n in range(1, 7)
    ]


def test_most_shipped_texts_are_told_twice() -> None:
    plan = plan_run("stop", load_corpus(), BOTH)
    assert (len(plan.episodes), plan.settings.told_once) == (282, 0)
