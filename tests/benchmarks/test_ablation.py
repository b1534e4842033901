"""The guide and the guide without its parts, in one table, the unread half first."""

from argparse import Namespace
from dataclasses import replace
from pathlib import Path

import pytest
from benchmarks.ablation import AGENTS, tables, walked

from memorymaze.evaluation.plan import plan_run
from memorymaze.instructions import Corpus


@pytest.fixture
def corpus(tiny_corpus: Corpus) -> Corpus:
    """Return four texts of whose participants some count as read while developing."""
    return replace(tiny_corpus, episodes=tiny_corpus.episodes[:4], was_half_read=True)


def test_the_comparison_named_beforehand_and_the_unread_half_come_first(
    corpus: Corpus, tmp_path: Path
) -> None:
    options = Namespace(limit=None, seed=0, workers=1, out=tmp_path)
    runs = walked(["guide", "rules", "guide_without_repair"], corpus, options)
    whole = [table.title for table in tables(runs, corpus)]
    assert any("not read" in title for title in whole)
    places = ["Primary" in t or "not read" in t for t in whole]
    assert places == sorted(places, reverse=True)
    rows = list(tables(runs, corpus))[-1].rows
    assert {row["method"] for row in rows} == {"rules", "guide_without_repair"}


def test_texts_of_which_none_were_read_are_one_table(
    corpus: Corpus, tmp_path: Path
) -> None:
    unread = replace(corpus, episodes=corpus.episodes[:1], was_half_read=False)
    options = Namespace(limit=None, seed=0, workers=1, out=tmp_path)
    [table] = tables(walked(["guide", "rules"], unread, options), unread)
    assert table.title.endswith("all texts")


@pytest.mark.parametrize("name", AGENTS)
def test_every_agent_of_the_table_can_be_run(name: str) -> None:
    agent = AGENTS[name]
    assert plan_run(agent).settings.agent.name == agent.name
