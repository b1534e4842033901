import pytest

from memorymaze.robot.perception.noun_phrase import (
    head_splits,
    parse_name,
    parse_request,
)


@pytest.mark.parametrize(
    ("request_", "words", "complement", "inscription", "identifiers"),
    [
        ("Please look for the red door", ("red", "door"), (), (), ()),
        ("the door of the library", ("door",), ("library",), (), ()),
        ("a sign that says Library", ("sign",), (), ("library",), ()),
        ('a "Mail Room" sign', ("sign",), (), ("mail", "room"), ()),
        ("door with the number 2347", ("door",), (), ("2347",), ()),
        ("door with 2347 on it", ("door",), (), ("2347",), ()),
        ("door number 2347", ("door",), (), (), ("2347",)),
        ("Hall A", ("hall",), (), (), ("a",)),
        ("2 vending machines", ("vending", "machines"), (), (), ()),
        ("the 2nd door on the left", ("door",), (), (), ()),
        ("door to your left", ("door",), (), (), ()),
        ("chair next to the desk", ("chair",), (), (), ()),
        ("a bench made of wood", ("wood", "bench"), (), (), ()),
        ("row of lockers", ("lockers",), (), (), ()),
        ("first aid room", ("first", "aid", "room"), (), (), ()),
        ("chest of drawers", ("chest of drawers",), (), (), ()),
        ("the reading room", ("reading", "room"), (), (), ()),
        ("sign reading EXIT on the wall", ("sign",), (), ("exit",), ()),
    ],
)
def test_request_is_taken_apart(
    request_: str,
    words: tuple[str, ...],
    complement: tuple[str, ...],
    inscription: tuple[str, ...],
    identifiers: tuple[str, ...],
) -> None:
    (phrase,) = parse_request(request_)
    assert phrase.words == words
    assert phrase.complement == complement
    assert phrase.inscription == inscription
    assert phrase.identifiers == frozenset(identifiers)


@pytest.mark.parametrize(
    ("request_", "heads"),
    [
        ("couch or sofa", ["couch", "sofa"]),
        ("bench/chair", ["bench", "chair"]),
        ("table and chairs", ["table", "chairs"]),
        ("black and white poster", ["poster"]),
    ],
)
def test_alternatives_are_told_from_joined_colours(
    request_: str, heads: list[str]
) -> None:
    assert [phrase.words[-1] for phrase in parse_request(request_)] == heads


def test_name_keeps_its_number_apart() -> None:
    name = parse_name("Professor's Office 2347")
    assert name.words == ("professor", "office")
    assert name.identifiers == {"2347"}


def test_fixed_phrases_come_before_their_last_word() -> None:
    assert head_splits(("big", "white", "board"))[0] == ("white board", ("big",))
