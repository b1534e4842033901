import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from memorymaze.world.looks.boards import exit_board, pictogram_board, sign_board
from memorymaze.world.looks.displays import DISPLAYS, Display
from memorymaze.world.looks.lettering import Field, fitted, write
from memorymaze.world.sites import load_sites

WHITE, BLACK = (1.0, 1.0, 1.0), (0.0, 0.0, 0.0)


def written(text: str, width: int, height: int) -> tuple[np.ndarray, Field]:
    """Write into the middle of a larger sheet; return where ink is."""
    margin = 40
    image = Image.new("RGB", (width + 2 * margin, height + 2 * margin), "white")
    field = Field(margin, margin, margin + width, margin + height)
    write(image, field, text, BLACK)
    return np.array(image.convert("L")) < 200, field


def assert_within(ink: np.ndarray, field: Field) -> None:
    rows, columns = np.nonzero(ink)
    if len(rows):
        assert columns.min() >= field.left
        assert columns.max() <= field.right
        assert rows.min() >= field.top
        assert rows.max() <= field.bottom


def test_the_words_of_the_shipped_signs_are_never_cut():
    texts = {
        each.text
        for site in load_sites(None).values()
        for each in site.landmarks
        if each.text
    }
    for text in sorted(texts):
        for size in ((240, 60), (120, 160)):
            ink, field = written(text, *size)
            assert ink.any(), text
            assert_within(ink, field)


@given(st.text(max_size=60), st.integers(12, 300), st.integers(12, 300))
def test_no_words_leave_their_field(text, width, height):
    ink, field = written(text, width, height)
    assert_within(ink, field)


def test_all_words_are_set():
    text = "Six metres across, a million points of light"
    for size in ((400, 60), (200, 200), (80, 300)):
        assert " ".join(fitted(text, *size).words) == text


def test_words_are_as_large_as_their_field_allows():
    ink, field = written("EXIT", 300, 90)
    rows, columns = np.nonzero(ink)
    assert np.ptp(rows) > 0.7 * field.height or np.ptp(columns) > 0.9 * field.width


def test_short_words_in_tall_fields_stand_one_below_the_other():
    assert fitted("BIKE REPAIR DAY", 150, 150).words == ("BIKE", "REPAIR", "DAY")


def test_letters_are_not_squeezed_beyond_reading():
    for site in load_sites(None).values():
        for each in site.landmarks:
            if each.text:
                setting = fitted(each.text, 300, 100)
                assert setting.squeeze >= 0.7 or setting.size == 6


def test_signs_are_dark_on_light_and_light_on_dark():
    light = sign_board(0.8, 0.4, "LIBRARY", (0.95, 0.95, 0.95))
    dark = sign_board(0.8, 0.4, "LIBRARY", (0.05, 0.1, 0.3))
    assert light[0, 0].mean() > 200 > 60 > light.min()
    assert dark[0, 0].mean() < 60 < 200 < dark.max()


@pytest.mark.parametrize(("text", "side"), [("← Lifts", "left"), ("Lifts →", "right")])
def test_arrows_stand_on_the_side_they_point_to(text: str, side: str):
    board = sign_board(1.8, 0.4, text, (0.05, 0.1, 0.3)).mean(axis=2)
    plain = sign_board(1.8, 0.4, "Lifts", (0.05, 0.1, 0.3)).mean(axis=2)
    third = board.shape[1] // 6
    edge = np.s_[:, :third] if side == "left" else np.s_[:, -third:]
    assert board[edge].mean() > plain[edge].mean() + 5


def test_boards_have_the_shape_of_their_surface_and_stay_small():
    for width, height in ((0.2, 0.15), (1.8, 0.4), (4.0, 2.3)):
        rows, columns, _ = sign_board(width, height, "Hall", WHITE).shape
        assert columns / rows == pytest.approx(width / height, rel=0.05)
        assert max(rows, columns) <= 512


def test_exit_signs_are_green_with_a_white_runner():
    board = exit_board(0.6, 0.25, "EXIT").astype(int)
    green = (board[:, :, 1] > board[:, :, 0] + 40).mean()
    left = board[:, : board.shape[1] // 3]
    assert green > 0.5
    assert left.min(axis=2).max() > 230


def test_pictograms_differ():
    signs = [
        pictogram_board(0.4, 0.4, "", (each,), (0.1, 0.3, 0.7))
        for each in ("woman", "man", "wheelchair", "cross", "heart", "stroller")
    ]
    for number, first in enumerate(signs):
        for second in signs[number + 1 :]:
            assert (first != second).mean() > 0.02


@pytest.mark.parametrize(
    ("text", "shows"), [("Men", True), ("Women →", True), ("Menu", False)]
)
def test_a_sign_shows_a_pictogram_for_the_whole_word_alone(text: str, shows: bool):
    ground = (0.1, 0.3, 0.7)
    on = Display(0.4, 0.4, text, "sign", ground, None, 0)
    plain = sign_board(0.4, 0.4, text, ground)
    assert np.array_equal(DISPLAYS["picture:sign"](on), plain) != shows
