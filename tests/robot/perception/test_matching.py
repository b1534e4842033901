"""What is found by which words; the pairs are in the two `.tsv` files beside this."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.robot.perception import MATCH_THRESHOLD, ObjectDescription, match_score
from memorymaze.robot.perception.appearance import parse_appearance

FOLDER = Path(__file__).parent


def read_pairs(name: str) -> list[tuple[bool, str, ObjectDescription]]:
    pairs: list[tuple[bool, str, ObjectDescription]] = []
    for line in (FOLDER / name).read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            expected, request, thing = line.split("\t")
            category, *known = thing.split("; ")
            facts = dict(each.split("=", 1) for each in known)
            pairs.append((
                expected == "yes",
                request,
                ObjectDescription(category, **facts),
            ))
    return pairs


TUNED = read_pairs("pairs_tuned.tsv")
HELD_OUT = read_pairs("pairs_held_out.tsv")
THINGS = [thing for _, _, thing in TUNED + HELD_OUT]
PLAIN_COLORS = {"red", "black", "white", "silver", "brown"}


@pytest.mark.parametrize(
    ("expected", "request_", "thing"),
    [
        pytest.param(*pair, id=f"{pair[1]} | {pair[2].category}{number}")
        for number, pair in enumerate(TUNED)
    ],
)
def test_pair_is_told_right(
    expected: bool, request_: str, thing: ObjectDescription
) -> None:
    assert (match_score(request_, thing) >= MATCH_THRESHOLD) is expected


def test_most_pairs_that_it_was_not_tuned_on_are_told_right() -> None:
    found = [match_score(r, thing) >= MATCH_THRESHOLD for _, r, thing in HELD_OUT]
    wanted = [expected for expected, _, _ in HELD_OUT]
    hits = sum(f and w for f, w in zip(found, wanted, strict=True))
    assert hits / sum(found) >= 0.98
    assert hits / sum(wanted) >= 0.92


@given(st.sampled_from(TUNED + HELD_OUT))
def test_politeness_and_articles_change_nothing(
    pair: tuple[bool, str, ObjectDescription],
) -> None:
    _, request, thing = pair
    bare = request.removeprefix("a ").removeprefix("the ")
    for polite in ("the {}", "a {}", "Please look for the {}", "is there a {}?"):
        assert match_score(polite.format(bare), thing) == match_score(bare, thing)


@given(st.sampled_from(THINGS))
def test_everything_is_found_by_its_own_category(thing: ObjectDescription) -> None:
    assert match_score(thing.category, thing) == 1.0


@given(st.sampled_from(THINGS))
def test_everything_with_words_on_it_is_found_by_them(thing: ObjectDescription) -> None:
    if thing.text is not None:
        request = f'{thing.category} that says "{thing.text}"'
        assert match_score(request, thing) >= MATCH_THRESHOLD


@given(
    st.sampled_from([
        (request, thing)
        for expected, request, thing in TUNED + HELD_OUT
        if expected and thing.color in PLAIN_COLORS
        if "," not in request and not parse_appearance(request).colors
    ])
)
def test_thing_is_not_found_by_another_colour(
    pair: tuple[str, ObjectDescription],
) -> None:
    request, thing = pair
    assert match_score(f"turquoise {request}", thing) < MATCH_THRESHOLD


@given(st.text(max_size=60), st.sampled_from(THINGS))
def test_any_text_gets_a_score_between_0_and_1(
    request: str, thing: ObjectDescription
) -> None:
    assert 0.0 <= match_score(request, thing) <= 1.0


@given(st.text(min_size=1, max_size=30), st.text(max_size=30), st.text(max_size=30))
def test_any_description_gets_a_score_between_0_and_1(
    category: str, name: str, text: str
) -> None:
    thing = ObjectDescription(category, color=name, name=name, text=text)
    for request in ("door", "red door of the library", text, name, category):
        assert 0.0 <= match_score(request, thing) <= 1.0


@pytest.mark.parametrize("name", ["boardroom", "board room", "Board Room"])
def test_a_name_is_found_in_full_whether_written_in_one_word_or_in_two(
    name: str,
) -> None:
    door = ObjectDescription("door", name="Board Room")
    others = [ObjectDescription("door", name="Meeting Room 2120")]
    others += [ObjectDescription("sign", text="Board Room \u2192")]
    assert match_score(name, door) == 1.0
    assert all(match_score(name, each) < 1.0 for each in others)


def test_score_falls_with_the_distance_of_the_kind() -> None:
    sofa = ObjectDescription("sofa")
    scores = [match_score(words, sofa) for words in ("couch", "seat", "furniture")]
    assert scores == sorted(scores, reverse=True)
    assert len(set(scores)) == 3


@pytest.mark.parametrize(
    ("request_", "state", "found"),
    [
        pytest.param("open door", "open", True, id="open"),
        pytest.param("open door", "closed", False, id="not open"),
        pytest.param("a door that is closed", "closed", True, id="closed"),
    ],
)
def test_state_of_doors_is_told(request_: str, state: str, found: bool) -> None:
    door = ObjectDescription("door", state="open" if state == "open" else "closed")
    assert (match_score(request_, door) >= MATCH_THRESHOLD) is found


@pytest.mark.parametrize(
    ("request_", "score"),
    [
        ("people", 1.0),
        ("someone", 1.0),
        ("pedestrians", 1.0),
        ("a person on the left", 1.0),
        ("passerby", 1.0),
        ("man", 0.75),
        ("women", 0.75),
        ("a man in a blue jacket", 0.75),
        ("security guard", 0.75),
        ("visitor", 0.75),
        ("statue", 0.0),
        ("robot", 0.0),
        ("printer", 0.0),
        ("model", 0.0),
        ("guide dog", 0.0),
        ("men's restroom", 0.0),
    ],
)
def test_a_person_is_found_by_words_for_people(request_: str, score: float):
    assert match_score(request_, ObjectDescription("person")) == score


def test_people_are_not_found_where_none_are():
    for category in ("statue", "sign", "robot", "space suit", "bust"):
        assert match_score("man", ObjectDescription(category)) < MATCH_THRESHOLD
