import pytest

from memorymaze.robot.perception.camera_view import ObjectDescription
from memorymaze.robot.simulation.scene_sentences import (
    PlaceSurface,
    SceneView,
    summary_sentence,
    thing_words,
    view_sentence,
)

CARPET = PlaceSurface("carpet", "wood_panel")
DOOR = ObjectDescription("door", color="brown", material="wood", text="2103")
BENCH = ObjectDescription("bench")


@pytest.mark.parametrize(
    ("what", "words"),
    [
        (DOOR, 'brown wooden door "2103"'),
        (BENCH, "bench"),
        (ObjectDescription("door", state="open", name="Office"), "open door (Office)"),
        (ObjectDescription("glass door", material="glass"), "glass door"),
        (ObjectDescription("globe", name="The Globe"), "globe (The Globe)"),
        (
            ObjectDescription("sign", name="Lifts", text="Lifts  3\n4"),
            'sign "Lifts 3 4"',
        ),
    ],
)
def test_a_thing_is_named_by_what_can_be_seen_of_it(
    what: ObjectDescription, words: str
) -> None:
    assert thing_words(what) == words


@pytest.mark.parametrize(
    ("depth", "width", "begin"),
    [
        (1.0, 2.0, "A wood-panelled wall close by"),
        (5.0, 2.0, "A carpet floor that ends at a wood-panelled wall some steps on"),
        (10.0, 2.0, "A corridor that leads on, with a carpet floor"),
        (30.0, 2.0, "A long corridor that leads on"),
        (30.0, 9.0, "A wide open space with a carpet floor"),
    ],
)
def test_a_view_tells_how_far_one_sees(depth: float, width: float, begin: str) -> None:
    assert view_sentence(SceneView(depth, width, CARPET, ())).startswith(begin)


def test_a_view_tells_near_things_and_far_ones() -> None:
    seen = ((DOOR, 1.0), (BENCH, 2.0), (BENCH, 2.5), (DOOR, 6.0))
    sentence = view_sentence(SceneView(1.0, 2.0, CARPET, seen))
    assert sentence.endswith(
        'near by a brown wooden door "2103" and 2 benches; '
        'farther off a brown wooden door "2103".'
    )


def test_equal_things_with_words_are_counted_too() -> None:
    poster = ObjectDescription("poster", text="OPEN DAY")
    seen = ((poster, 1.0), (poster, 2.0))
    assert view_sentence(SceneView(1.0, 2.0, CARPET, seen)).endswith(
        '2 posters "OPEN DAY".'
    )


def test_no_more_than_six_things_are_named() -> None:
    seen = tuple((ObjectDescription(f"thing{k}"), 1.0) for k in range(9))
    sentence = view_sentence(SceneView(1.0, 2.0, CARPET, seen))
    assert sentence.endswith("a thing5 and more.")


@pytest.mark.parametrize(
    ("far", "leading"),
    [
        ((), "leads nowhere far"),
        ((0, 1, 7), "leads on in 1 direction"),
        ((0, 2, 4, 6), "leads on in 4 directions"),
        (range(8), "leads on in 1 direction"),
    ],
)
def test_a_summary_counts_the_ways(far: range, leading: str) -> None:
    views = [SceneView(20.0 if k in far else 1.0, 2.0, CARPET, ()) for k in range(8)]
    assert leading in summary_sentence(views, CARPET, [])
