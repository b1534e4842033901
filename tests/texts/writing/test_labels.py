"""A label says just what is wrong; a text without one says nothing false of its route.

Both are held against the site plan, not against the plans that the texts are told from.
"""

import math
import re
from collections.abc import Iterator
from itertools import groupby, pairwise

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from memorymaze.texts.corpus import Instruction, Span
from memorymaze.texts.corpus.error_kinds import ERROR_KINDS
from memorymaze.texts.writing import (
    Cell,
    cells_of,
    parse_rates,
    sample_outlines,
    write_texts,
)
from memorymaze.texts.writing.things import things_of
from memorymaze.texts.writing.told_sides import commands
from memorymaze.world.sites import Site

QUIET = settings(
    max_examples=8,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
SEEDS = st.integers(0, 2**31)
NUMBERING = re.compile(r"^(?:\W*(?:step )?\d+\W+)+", re.IGNORECASE | re.MULTILINE)
METRES = re.compile(r"(\d+) metres?\b")
BACK = re.compile(r"around|back|behind|other way|opposite")
SIDE_OF_A_THING = re.compile(
    r"(?:,| is| are| will be|, and that is)* on (?:the|your) (left|right)\b"
)
NOT_THE_WAY = re.compile(r"too far|missed|overshot|past your turn|gone past|without")
IN_REACH = 12.0
"""Metres from the way within which a thing that is told may stand."""


@pytest.fixture(scope="module")
def cells(builtin_sites: dict[str, Site]) -> list[Cell]:
    """All cells of Table I."""
    return [cell for site in builtin_sites.values() for cell in cells_of(site)]


def _pairs(
    cells: list[Cell], kind: str, seed: int
) -> Iterator[tuple[Site, Instruction, Instruction]]:
    """Yield wrong and right texts of one cell, every turn in words of its own."""
    (study, *_) = next(each.studies for each in ERROR_KINDS if each.name == kind)
    cells = [cell for cell in cells if cell.study == study]
    cell = cells[seed % len(cells)]
    rates = parse_rates(f"{kind}=1,restart=0,filler=0,merged_turns=0")
    for outline in sample_outlines(cell, rates, 2, seed):
        if outline.mistakes:
            wrong, right = write_texts(outline, paired=True)
            yield cell.reference.graph.site, wrong, right


def _labels(text: Instruction, kind: str) -> list[Span]:
    """Return the labels of an error; a side can be said twice over."""
    labels = [each for each in text.spans if each.kind == kind]
    assert labels
    return labels


def _words(text: str) -> list[str]:
    return re.findall(r"[\w']+", NUMBERING.sub("", text).lower())


def _labelled(text: Instruction, kind: str) -> str:
    """Return the labelled words, each once."""
    words = [text.text[each.start : each.end] for each in _labels(text, kind)]
    return " ".join(dict.fromkeys(words)).lower()


def _others(text: Instruction, kind: str) -> list[str]:
    """Return the words outside the labels."""
    rest = text.text
    for each in reversed(_labels(text, kind)):
        rest = f"{rest[: each.start]}\n{rest[each.end :]}"
    return _words(rest)


def _sides_at(site: Site, text: Instruction) -> set[str]:
    """Return where the route turns at the place that its error names."""
    turns = site.find_route(text.reference_route).turns
    where = text.failures[0].where
    return {each.direction.rpartition("_")[2] for each in turns if each.at == where}


@pytest.mark.parametrize("kind", ["wrong_direction", "wrong_direction_at_turn"])
@QUIET
@given(seed=SEEDS)
def test_a_wrong_side_is_the_other_side_of_that_turn_and_nothing_else(
    cells: list[Cell], kind: str, seed: int
) -> None:
    for site, wrong, right in _pairs(cells, kind, seed):
        assert _labelled(right, kind) in _sides_at(site, wrong)
        assert {_labelled(wrong, kind), _labelled(right, kind)} == {"left", "right"}
        assert _others(wrong, kind) == _others(right, kind)


@QUIET
@given(seed=SEEDS)
def test_a_missing_turn_is_all_that_is_missing(cells: list[Cell], seed: int) -> None:
    kind = "missing_turn"
    for site, wrong, right in _pairs(cells, kind, seed):
        assert _labelled(wrong, kind) == ""
        said = {"left", "right"} & set(_words(_labelled(right, kind)))
        assert _sides_at(site, wrong) & said
        assert _words(wrong.text) == _others(right, kind)


@QUIET
@given(seed=SEEDS)
def test_an_extra_turn_is_all_that_is_added_and_the_route_does_not_turn_there(
    cells: list[Cell], seed: int
) -> None:
    kind = "extra_turn"
    for site, wrong, right in _pairs(cells, kind, seed):
        assert _sides_at(site, wrong) == set()
        assert {"left", "right"} & set(_words(_labelled(wrong, kind)))
        assert _others(wrong, kind) == _words(right.text)


@QUIET
@given(seed=SEEDS)
def test_a_thing_that_is_said_to_be_at_a_turn_by_mistake_is_nowhere(
    cells: list[Cell], seed: int
) -> None:
    kind = "inaccurate_environment"
    for site, wrong, right in _pairs(cells, kind, seed):
        detail = wrong.failures[0].detail
        found = re.search(r"(?:hang on|tells of) an? (.+?)(?:;| and a turn)", detail)
        assert found is not None, detail
        assert found[1] in _labelled(wrong, kind)
        assert found[1] not in right.text.lower()
        head = found[1].split()[-1]
        assert not any(head in each.category for each in site.landmarks)


@QUIET
@given(seed=SEEDS)
def test_a_wrong_destination_is_a_thing_of_the_site_away_from_the_goal(
    cells: list[Cell], seed: int
) -> None:
    kind = "wrong_destination"
    for site, wrong, right in _pairs(cells, kind, seed):
        (thing,) = [
            each for each in things_of(site) if each.id == wrong.failures[0].where
        ]
        route = site.find_route(wrong.reference_route)
        assert thing.words.lower() in _labelled(wrong, kind)
        assert thing.id != route.goal_landmark
        # It stands away from the goal, or is come to before the last turn.
        away = math.dist(thing.position, route.line.coords[-1][:2])
        cut = len(_others(wrong, kind)) < len(_others(right, kind))
        assert away > 3.0 or cut


@QUIET
@given(seed=SEEDS)
def test_a_wrong_start_sends_back_or_to_the_other_side(
    cells: list[Cell], seed: int
) -> None:
    kind = "incorrect_direction"
    for site, wrong, right in _pairs(cells, kind, seed):
        if wrong.failures[0].where == "start":
            assert BACK.search(_labelled(wrong, kind))
            assert _others(wrong, kind) == _words(right.text)
        else:
            assert _labelled(right, kind) in _sides_at(site, wrong)


@QUIET
@given(seed=SEEDS)
def test_a_wrong_turning_point_keeps_the_side(cells: list[Cell], seed: int) -> None:
    kind = "wrong_turning_point"
    for _, wrong, right in _pairs(cells, kind, seed):
        assert _words(_labelled(wrong, kind)) != _words(_labelled(right, kind))
        assert _sides_in(wrong.text) == _sides_in(right.text)


def _sides_in(text: str) -> list[str]:
    """Return the sides said, each once where it is said twice over."""
    sides = [word for word in _words(text) if word in {"left", "right"}]
    return [side for side, _ in groupby(sides)]


# -- texts without errors


def _right_texts(cells: list[Cell], seed: int) -> Iterator[tuple[Site, Instruction]]:
    cell = cells[seed % len(cells)]
    rates = parse_rates("failure=0,restart=0,distance=0")
    for outline in sample_outlines(cell, rates, 3, seed):
        (text,) = write_texts(outline, paired=False)
        assert text.failures == ()
        yield cell.reference.graph.site, text


@QUIET
@given(seed=SEEDS)
def test_no_turn_is_told_that_the_route_does_not_make(
    cells: list[Cell], seed: int
) -> None:
    for site, text in _right_texts(cells, seed):
        turns = site.find_route(text.reference_route).turns
        rest = iter(each.direction.rpartition("_")[2] for each in turns)
        for sentence in re.split(r"[.!?\n]", text.text):
            # "The first time you can go left, you go left" is one turn.
            for side, _ in groupby(each.side for each in commands(sentence)):
                assert side in rest, text.text


@QUIET
@given(seed=SEEDS)
def test_every_thing_that_is_told_stands_by_the_way_on_the_side_that_is_said(
    cells: list[Cell], seed: int
) -> None:
    for site, text in _right_texts(cells, seed):
        line = site.find_route(text.reference_route).line
        for sentence in re.split(r"[.!?\n]", text.text):
            if NOT_THE_WAY.search(sentence):
                continue
            for spots, said in _named(site, sentence):
                near = [spot for spot in spots if line.distance(spot) < IN_REACH]
                assert near, sentence
                sides = {_side_of_way(line, spot) for spot in near}
                assert said is None or said in sides, (sentence, text.text)


def _named(site: Site, sentence: str) -> Iterator[tuple[list[Point], str | None]]:
    """Yield where the things named in a sentence stand, and on which side it says."""
    middles = {each.id: each.position for each in site.landmarks}
    middles |= {each.id: each.line.centroid for each in site.doors}
    spots: dict[str, list[Point]] = {}
    for thing in things_of(site):
        spots.setdefault(thing.words, []).append(middles[thing.id])
    for words in sorted(spots, key=len, reverse=True):
        found = re.search(rf"\b{re.escape(words)}\b(.*)", sentence)
        if found is not None:
            side = SIDE_OF_A_THING.match(found[1])
            yield spots[words], side[1] if side else None
            sentence = sentence.replace(words, "")


def _side_of_way(line: LineString, spot: Point) -> str:
    """Return on which side of a line a place lies, by the line's nearest piece."""
    at = line.project(spot)
    (x, y), (ahead_x, ahead_y) = (
        line.interpolate(min(max(metres, 0.0), line.length)).coords[0][:2]
        for metres in (at - 0.1, at + 0.1)
    )
    cross = (ahead_x - x) * (spot.y - y) - (ahead_y - y) * (spot.x - x)
    return "left" if cross > 0 else "right"


@QUIET
@given(seed=SEEDS)
def test_lengths_from_a_good_memory_are_those_of_the_stretches(
    cells: list[Cell], seed: int
) -> None:
    for site, text in _right_texts(cells, seed):
        route = site.find_route(text.reference_route)
        points = {each.id: each.polygon for each in site.turning_points}
        corners = [
            route.line.project(route.line.intersection(points[turn.at]).centroid)
            for turn in route.turns
        ]
        edges = [0.0, *corners, route.line.length]
        for said in map(float, METRES.findall(text.text)):
            off = min(abs(said - (end - start)) for start, end in pairwise(edges))
            assert off <= max(2.0, 0.15 * said), (said, text.text)
