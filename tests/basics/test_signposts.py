import pytest

from memorymaze.basics.signposts import signposts


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Library", [(None, "Library")]),
        ("Terrace →", [("right", "Terrace")]),
        ("← Lifts   Reception →", [("left", "Lifts"), ("right", "Reception")]),
        (
            "← Lifts   ↑ Reception   → Lockers",
            [("left", "Lifts"), ("ahead", "Reception"), ("right", "Lockers")],
        ),
        ("← Lifts → Shop", [("left", "Lifts"), ("right", "Shop")]),
        ("Lifts ← Shop →", [("left", "Lifts"), ("right", "Shop")]),
        ("Globe Balcony - straight on", [("ahead", "Globe Balcony - straight on")]),
        (
            "Shop to the right, Cafe on the left",
            [("right", "Shop to the right"), ("left", "Cafe on the left")],
        ),
        ("Cafe, Shop", [(None, "Cafe, Shop")]),
        ("Rights of way", [(None, "Rights of way")]),
        ("", [(None, "")]),
    ],
)
def test_signs_are_split_by_where_they_point(text, expected):
    assert [(each.arrow, each.words) for each in signposts(text)] == expected
