"""Names written with capitals."""

import pytest

from memorymaze.language.reading import parse_route_description
from memorymaze.language.reading.proper_names import proper_names


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("Turn left. Duty Free Shop, on your right.", ("duty free shop",)),
        ("1. Left at the end.\n2. Pass the Left Luggage office.", ("left luggage",)),
        ("Turn Right and go Straight Ahead until The Gift Shop", ()),
        ("Turn Left At The Duty Free Shop. Then Right.", ()),
        ("turn left at the duty free shop", ()),
        ("Pass Duty Free Shop, then left", ("duty free shop",)),
    ],
)
def test_runs_of_capitals_are_names_unless_words_for_ways_have_them_too(
    text: str, names: tuple[str, ...]
) -> None:
    assert proper_names(text) == names


@pytest.mark.parametrize("name", ["Duty Free Shop", "Flower Stand", "Board Room"])
def test_a_destination_keeps_all_words_of_its_name(name: str) -> None:
    plan = parse_route_description(f"Turn left. {name} is on your right.")
    assert plan.arrival.destinations == (name.lower(),)
    assert plan.arrival.side == "right"
    assert not plan.arrival.mentions
