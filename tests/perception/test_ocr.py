"""Reading signs from pictures, with the weights that the library ships."""

import math
from collections.abc import Callable
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFont

from memorymaze.geometry.pose import Pose
from memorymaze.perception.ocr import FoundLine, PictureSignReader, TextRecognizer
from memorymaze.robot.steps import CameraPicture

FONT = Path(matplotlib.get_data_path(), "fonts", "ttf", "DejaVuSans-Bold.ttf")


class Board:
    """A view of a wall, at a depth, with words on it."""

    def __init__(
        self, *words: tuple[int, int, str], depth: float = 3.0, pose: Pose | None = None
    ) -> None:
        self.words = words
        self.depth = depth
        self.pose = pose or Pose(0, 0, 0)

    def picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        image = Image.new("RGB", (width, height), (235, 235, 230))
        pen = ImageDraw.Draw(image)
        font = ImageFont.truetype(FONT, 40)
        for x, y, word in self.words:
            pen.text((x, y), word, (20, 20, 60), font)
        depth = np.full((height, width), self.depth, dtype=np.float32)
        return CameraPicture(np.asarray(image), depth)


class Reader:
    """Reads what it is told to."""

    def __init__(self, *lines: FoundLine) -> None:
        self.found = lines

    def lines(self, rgb):
        return self.found


def line(left: float, top: float, text: str, score: float = 0.9, tall: float = 30):
    return FoundLine((left, top, left + 20 * len(text), top + tall), text, score)


@pytest.fixture(scope="module")
def recognizer() -> TextRecognizer:
    return TextRecognizer()


def test_words_on_a_wall_are_read_with_distance_and_direction(
    recognizer: TextRecognizer,
):
    board = Board((300, 400, "Library"), (900, 700, "Room 2347"))

    library, room = PictureSignReader(recognizer).read(board)

    assert (library.text, room.text) == ("Library", "Room 2347")
    assert 3.0 < library.distance < room.distance < 3.8
    assert library.bearing_deg == pytest.approx(20, abs=5)
    assert room.bearing_deg == pytest.approx(-31, abs=5)


def test_a_bare_wall_has_no_texts(recognizer: TextRecognizer):
    assert PictureSignReader(recognizer).read(Board()) == []


def test_lines_below_each_other_are_one_text():
    reader = Reader(line(300, 440, "and Shop"), line(300, 400, "Restrooms"))

    [sign] = PictureSignReader(reader).read(Board())

    assert sign.text == "Restrooms and Shop"


@pytest.mark.parametrize(
    "other",
    [
        pytest.param(line(700, 400, "Lifts"), id="beside it"),
        pytest.param(line(300, 500, "Lifts"), id="far below it"),
        pytest.param(line(300, 440, "Lifts", tall=100), id="in other letters"),
    ],
)
def test_lines_apart_are_texts_of_their_own(other: FoundLine):
    signs = PictureSignReader(Reader(line(300, 400, "Restrooms"), other)).read(Board())

    assert {sign.text for sign in signs} == {"Restrooms", "Lifts"}


def test_doubtful_and_far_texts_are_dropped():
    doubtful = Reader(line(300, 400, "Rxsfr", score=0.5), line(300, 600, " "))
    sure = Reader(line(600, 400, "Restrooms"))

    assert PictureSignReader(doubtful).read(Board()) == []
    assert PictureSignReader(sure).read(Board(depth=6.2)) == []
    assert len(PictureSignReader(sure).read(Board(depth=5.8))) == 1


def test_a_text_read_again_keeps_its_number_even_misread():
    reader: Callable[..., Reader] = Reader
    signs = PictureSignReader(reader(line(600, 400, "Library")))
    [first] = signs.read(Board())
    signs._recognizer.found = (line(600, 400, "Librory"), line(100, 400, "Lifts"))

    again = {
        sign.text: sign.track_id for sign in signs.read(Board(pose=Pose(0.1, 0, 0)))
    }

    assert again["Librory"] == first.track_id != again["Lifts"]
