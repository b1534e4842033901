import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.world.drawing.label_placing import Box, LabelSpace, PlacedLabel, wrapped

SHEET = (0.0, 0.0, 40.0, 40.0)


def _box(space: LabelSpace, label: PlacedLabel) -> Box:
    wide, high = space.extent(label.text, label.font_size)
    return (
        label.x - wide / 2,
        label.y - high / 2,
        label.x + wide / 2,
        label.y + high / 2,
    )


def _overlap(one: Box, other: Box) -> bool:
    slack = 1e-9
    return (
        one[0] < other[2] - slack
        and other[0] < one[2] - slack
        and one[1] < other[3] - slack
        and other[1] < one[3] - slack
    )


@given(
    st.lists(
        st.tuples(st.floats(0, 40), st.floats(0, 40), st.text("abc ", min_size=1)),
        max_size=30,
    )
)
def test_labels_beside_things_cover_neither_each_other_nor_the_edge(
    things: list[tuple[float, float, str]],
):
    space = LabelSpace(metres_per_point=0.05)
    boxes: list[Box] = []
    for x, y, text in things:
        label = space.beside(text, (x, y, x + 0.5, y + 0.5), 8, SHEET)
        if label:
            boxes.append(_box(space, label))
    for index, box in enumerate(boxes):
        assert not any(_overlap(box, other) for other in boxes[:index])
        assert min(box[:2]) >= -1e-9
        assert max(box[2:]) <= 40 + 1e-9


def test_a_name_is_written_as_large_as_it_fits():
    space = LabelSpace(metres_per_point=0.05)
    wide = space.inside(["Office 12"], [(0, 0, 9, 2)], [12, 8, 4])
    narrow = space.inside(["Office 12"], [(10, 0, 11.2, 1)], [12, 8, 4])
    assert wide is not None
    assert (wide.x, wide.y, wide.font_size, wide.angle) == (4.5, 1, 12, 0)
    assert narrow is not None
    assert narrow.font_size == 4


def test_a_name_in_a_tall_room_is_turned():
    space = LabelSpace(metres_per_point=0.05)
    label = space.inside(["Conference Room"], [(0, 0, 1, 9)], [10])
    assert label is not None
    assert label.angle == pytest.approx(1.5708, abs=1e-4)


def test_a_label_without_room_is_left_out():
    space = LabelSpace(metres_per_point=0.05)
    space.take(SHEET)
    assert space.beside("bench", (5, 5, 6, 6), 8, SHEET) is None
    assert space.inside(["Hall"], [(5, 5, 20, 20)], [8]) is None
    assert space.along("Hall", [(5, 5)], 0.3, 8) is None


def test_a_slanted_name_takes_only_the_strip_it_covers():
    space = LabelSpace(metres_per_point=0.05)
    label = space.along("A long name of a hallway", [(10, 10)], 0.7854, 8)
    assert label is not None
    assert space.is_free((6, 11.5, 8, 13))
    assert not space.is_free((9.9, 9.9, 10.1, 10.1))


@given(st.text("ab ", max_size=20))
def test_wrapping_keeps_all_words_in_order(text: str):
    for version in wrapped(text):
        assert version.split() == text.split()
