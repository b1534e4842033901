import numpy as np

from memorymaze.world.looks import artwork

GREY = (0.5, 0.5, 0.5)


def test_posters_show_their_words_and_differ_by_them():
    first = artwork.poster_picture(0.6, 0.85, "CHESS CLUB", GREY, 1)
    second = artwork.poster_picture(0.6, 0.85, "JAZZ BAND", GREY, 1)
    changed = np.nonzero((first != second).any(axis=2))[0]
    assert len(changed)
    assert changed.max() < 0.65 * len(first)


def test_screens_keep_their_picture_beside_their_words():
    blank = artwork.film(1.4, 0.85, "", 1)
    worded = artwork.film(1.4, 0.85, "Live from orbit", 1)
    assert blank.shape == worded.shape
    lower = worded[len(worded) // 2 :]
    assert (lower.min(axis=2) > 230).mean() > 0.03


def test_notice_boards_and_panels_come_in_variants():
    for draw in (artwork.cork_board, artwork.headlined, artwork.poster_picture):
        pictures = [draw(1.5, 1.1, "NEWS", GREY, each) for each in range(3)]
        assert not np.array_equal(pictures[0], pictures[1])


def test_pictures_are_read_only_and_kept():
    first = artwork.painting_picture(1.0, 0.7, GREY, 0)
    assert first is artwork.painting_picture(1.0, 0.7, GREY, 0)
    assert not first.flags.writeable


def test_a_floor_map_marks_where_one_is():
    plan = artwork.floor_map_picture(
        1.6, 1.2, "You are here", (0.93, 0.93, 0.92), 0
    ).astype(int)
    red = (plan[:, :, 0] > 180) & (plan[:, :, 1] < 60)
    assert 20 < red.sum() < 0.02 * red.size
