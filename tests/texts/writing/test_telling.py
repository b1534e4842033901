"""Texts are labelled to the word, and pairs differ in their errors alone."""

import re
from itertools import islice

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from memorymaze.language.plans import Leg, Turn
from memorymaze.texts.corpus.error_kinds import SURFACE_KINDS
from memorymaze.texts.corpus.files import lines
from memorymaze.texts.corpus.record_format import instruction_record, parse_line
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.writing import (
    Outline,
    cells_of,
    parse_rates,
    sample_outlines,
    write_texts,
)
from memorymaze.texts.writing.clauses import turn_clause
from memorymaze.texts.writing.voices import make_voice
from memorymaze.world.sites import Site

QUIET = settings(
    max_examples=10,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
SENTENCE = re.compile(r"[^.!?\n]+")


def _outlines(
    site: Site, seed: int, rates: str = "failure=1", count: int = 2
) -> list[Outline]:
    wanted = parse_rates(rates)
    return [
        outline
        for cell in cells_of(site)
        for outline in sample_outlines(cell, wanted, count, seed)
    ]


def _sentences(instruction: Instruction) -> list[str]:
    """Return the words of the sentences without an error."""
    errors = {failure.kind for failure in instruction.failures} or {
        span.kind for span in instruction.spans if span.kind not in SURFACE_KINDS
    }
    spans = [s for s in instruction.spans if s.kind in errors and s.start < s.end]
    return [
        " ".join(re.findall(r"[a-z']+", found[0].lower()))
        for found in SENTENCE.finditer(instruction.text)
        if not any(
            span.start < found.end() and found.start() < span.end for span in spans
        )
    ]


@QUIET
@given(seed=st.integers(0, 2**31), name=st.sampled_from(["university", "museum_7f"]))
def test_a_pair_is_the_same_outside_the_sentences_with_errors(
    builtin_sites: dict[str, Site], seed: int, name: str
) -> None:
    cells = cells_of(builtin_sites[name])
    cell = cells[seed % len(cells)]
    (outline,) = sample_outlines(cell, parse_rates("failure=1"), 1, seed)
    wrong, right = write_texts(outline, paired=True)
    assert wrong.pair == right.pair == outline.id
    assert wrong.failures
    assert not right.failures
    assert wrong.text != right.text
    kind = wrong.failures[0].kind
    # A turn too many may stand between two that are else told in one sentence.
    parts = kind == "extra_turn" and "merged_turns" in {s.kind for s in right.spans}
    if kind != "wrong_destination" and not parts:
        others = [each for each in _sentences(wrong) if each not in _sentences(right)]
        assert not others, (wrong.text, right.text)


@QUIET
@given(seed=st.integers(0, 2**31))
def test_labels_begin_and_end_at_words_and_name_what_is_there(
    tiny_sites: dict[str, Site], seed: int
) -> None:
    names = sorted(tiny_sites)
    site = tiny_sites[names[seed % len(names)]]
    for outline in islice(_outlines(site, seed), 4):
        for made in write_texts(outline, paired=True):
            for span in made.spans:
                before = made.text[max(0, span.start - 1) : span.start]
                after = made.text[span.end : span.end + 1]
                words = made.text[span.start : span.end]
                assert not (before.isalnum() and words[:1].isalnum()), made
                assert not (after.isalnum() and words[-1:].isalnum()), made


def test_the_same_seed_writes_the_same_and_another_seed_others(
    t_site: Site,
) -> None:
    def texts(seed: int) -> list[str]:
        return [
            made.text
            for outline in _outlines(t_site, seed)
            for made in write_texts(outline, paired=True)
        ]

    assert texts(5) == texts(5)
    assert texts(5) != texts(6)


def test_no_control_characters_or_slots_are_left(tiny_sites: dict[str, Site]) -> None:
    for site in tiny_sites.values():
        for outline in _outlines(site, 2):
            for made in write_texts(outline, paired=False):
                assert not re.search(r"[\x00-\x09\x0b-\x1f{}\[\]]|  ", made.text)
                assert made.source == "synthetic"


def test_fillers_come_only_where_they_are_wanted(
    builtin_sites: dict[str, Site],
) -> None:
    site = builtin_sites["museum_5f"]
    for rates, some in (("failure=0,filler=0", False), ("failure=0,filler=1", True)):
        kinds = {
            span.kind
            for outline in _outlines(site, 0, rates)
            for made in write_texts(outline, paired=False)
            for span in made.spans
        }
        assert ("filler" in kinds) == some


def test_a_written_record_is_read_back_with_its_labels(t_site: Site) -> None:
    for outline in _outlines(t_site, 0):
        for made in write_texts(outline, paired=True):
            line = lines([instruction_record(made)]).decode()
            read, unknown, problems = parse_line(line, "file:1")
            assert (read, unknown, problems) == (made, [], [])


@pytest.mark.parametrize(
    ("spans", "said"),
    [
        ('[{"kind": "filler", "start": 3, "end": 9999}]', "the length of the text"),
        (
            '[{"kind": "filler", "start": -1, "end": 2}]',
            "spans[0].start': expected greater than or equal to 0",
        ),
        ('[{"start": 0, "end": 2}]', "spans[0].kind': expected this member"),
    ],
)
def test_labels_outside_the_text_are_refused(
    t_site: Site, spans: str, said: str
) -> None:
    (made,) = write_texts(_outlines(t_site, 0)[0], paired=False)
    record = instruction_record(made)
    record["spans"] = []
    line = lines([record]).decode().replace('"spans": []', f'"spans": {spans}')
    read, _, problems = parse_line(line, "file:1")
    assert read is None
    assert said in str(problems[0])


@pytest.mark.parametrize("way", ["left", "slight_left"])
def test_which_opening_is_meant_is_told_of_a_slight_turn_as_of_any(way: str) -> None:
    draws = np.random.default_rng(1)
    voice = make_voice("online", 1, draws)
    for number in range(4):
        for size in ("terse", "plain", "wordy"):
            leg = Leg(Turn(way, ordinal=2))  # type: ignore[arg-type]
            told = turn_clause(leg, size, voice, draws, {}, number, {})
            assert "second" in told
            assert "left" in told
