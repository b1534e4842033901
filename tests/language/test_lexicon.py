import pytest

from memorymaze.language.nouns import (
    general_words,
    is_noun,
    kin_of,
    kind_distance,
    singular,
)


@pytest.mark.parametrize(
    ("general", "special"),
    [
        ("lift", "elevator"),
        ("toilet", "restroom"),
        ("plant", "fern"),
        ("furniture", "reception desk"),
        ("sign", "exit sign"),
        ("door", "elevator door"),
        ("seat", "armchair"),
        ("trash can", "recycling bin"),
        ("animal", "polar bear"),
        ("vehicle", "bicycle"),
    ],
)
def test_noun_covers_what_is_a_kind_of_it(general: str, special: str) -> None:
    assert kind_distance(general, special) is not None


@pytest.mark.parametrize(
    ("general", "special"),
    [
        ("armchair", "chair"),
        ("vending machine", "machine"),
        ("chair", "wheelchair"),
        ("stairs", "escalator"),
        ("table", "counter"),
        ("sign", "poster"),
        ("room", "box"),
        ("plant", "building"),
        ("tree", "flag"),
    ],
)
def test_noun_does_not_cover_what_is_none_of_it(general: str, special: str) -> None:
    assert kind_distance(general, special) is None


def test_unknown_word_is_only_like_itself() -> None:
    assert not is_noun("frobnicator")
    assert kind_distance("frobnicator", "frobnicator") == 0
    assert kind_distance("frobnicator", "machine") is None
    assert kin_of("frobnicator") == general_words("frobnicator") == ()


@pytest.mark.parametrize(
    ("plural", "one"),
    [
        ("shelves", "shelf"),
        ("children", "child"),
        ("gentlemen", "gentleman"),
        ("benches", "bench"),
        ("buses", "bus"),
        ("kiosks", "kiosk"),
        ("movies", "movie"),
        ("groceries", "grocery"),
        ("frobberies", "frobbery"),
        ("glass", "glass"),
        ("frobnicators", "frobnicator"),
    ],
)
def test_plural_has_its_singular(plural: str, one: str) -> None:
    assert singular(plural) == one


@pytest.mark.parametrize(
    ("said", "meant"),
    [("lift", "elevator"), ("sofa", "seat"), ("desk", "counter"), ("bench", "chair")],
)
def test_kin_are_the_same_or_what_it_is_or_its_like(said: str, meant: str) -> None:
    assert meant in kin_of(said)
    assert said not in kin_of(said)


def test_what_has_little_in_common_is_no_kin() -> None:
    assert "elevator" not in kin_of("desk")
    assert "bridge" not in kin_of("fountain")  # two of many structures


def test_general_words_begin_with_the_nearest() -> None:
    assert general_words("desk") == ("table", "furniture")
    assert "desk" not in general_words("table")
