"""Every row of the vocabulary does what its examples show."""

import re

import pytest

from memorymaze.language.reading.chunks import chunks_of, claimed_at
from memorymaze.language.reading.vocabulary import PATTERNS, PLAIN_WORDS, Pattern


def _claimed(text: str, pattern: Pattern) -> list[str]:
    """Return the words of a text that a pattern claims, all earlier rows considered."""
    claims = [(claimed_at(text, each.start), each.text) for each in chunks_of(text)]
    return [words for claim, words in claims if claim == (pattern, words)]


@pytest.mark.parametrize("pattern", PATTERNS, ids=lambda each: each.name)
def test_a_pattern_claims_what_its_examples_show_and_nothing_else(
    pattern: Pattern,
) -> None:
    assert pattern.examples
    assert pattern.counter_examples
    for example in pattern.examples:
        text = example.replace("[", "").replace("]", "")
        assert _claimed(text, pattern) == re.findall(r"\[(.*?)\]", example)
    for text in pattern.counter_examples:
        assert _claimed(text, pattern) == [], text


@pytest.mark.parametrize("row", PLAIN_WORDS, ids=lambda each: each.name)
def test_plainer_words_are_read_for_a_turn_of_phrase(row: Pattern) -> None:
    assert row.examples
    for said, read in row.examples:
        assert row.regex.sub(row.work, said) == read
    for text in row.counter_examples:
        assert row.regex.sub(row.work, text) == text


def test_names_of_rows_are_told_apart() -> None:
    names = [row.name for row in (*PATTERNS, *PLAIN_WORDS)]
    assert len(set(names)) == len(names)
