"""What every finder of objects must do that a run may have as its detector."""

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import DetectorError, SettingsError
from memorymaze.robot.perception.own_finder import OwnFinder
from memorymaze.robot.perception.picture_detector import FoundBox, ObjectFinder
from memorymaze.testing.expectation import expect

QUERIES = (
    "red chair",
    "door",
    "",
    ".",
    "sign that says “5, 6 & 7”",
    "左の椅子",
    "\ud83d",
)
"""What robots ask for: things, nothing, signs, another language, half a character."""
SAME = (1.0, 0.01)
"""Pixels and scores within which a box is the same again."""


def check_object_finder(
    finder: ObjectFinder,
    picture: NDArray[np.uint8] | None = None,
    query: str = "door",
    *,
    repeatable: bool = True,
) -> None:
    """Check that a finder keeps the contract of `ObjectFinder`.

    It is asked for many things in pictures of several sizes, then for the first again. It
    must answer all of it with boxes in pixels, leave the pictures as they are, and answer
    the same again, whatever was looked at in between.

    Args:
        finder: The finder.
        picture: One in which it finds something; None for noise, in which it need not.
        query: What it finds there.
        repeatable: Whether the finder promises to answer the same again.

    Raises:
        AssertionError: It breaks the contract.
    """
    noise = np.random.default_rng(0).integers(0, 256, (480, 640, 3), dtype=np.uint8)
    first = noise if picture is None else picture
    found = _found(finder, first, query)
    if picture is not None:
        expect(bool(found), f"find: {query!r} in the picture that was given", found)
    for words in QUERIES:
        _found(finder, noise, words)
    _found(finder, noise[:48, :64].copy(), query)
    if repeatable:
        again = _found(finder, first, query)
        same = len(again) == len(found) and all(map(_alike, again, found))
        expect(same, f"find: the same for the same picture, {found}", again)


def _found(
    finder: ObjectFinder, picture: NDArray[np.uint8], query: str
) -> list[FoundBox]:
    """Let a finder look; return what it found."""
    shown = picture.copy()
    try:
        found = OwnFinder(type(finder).__name__, finder).find(shown, query)
    except (DetectorError, SettingsError) as error:
        raise AssertionError(
            f"expected boxes for {query!r} in a picture {picture.shape}; got {error}"
        ) from error
    expect(np.array_equal(shown, picture), "find: the picture left as it is", "another")
    boxes = [each.box for each in found]
    # Shares would all be dropped, without a word, as too small.
    expect(
        not boxes or max(map(max, boxes)) > 1,
        "find: boxes in pixels, not in shares of the picture",
        boxes,
    )
    return found


def _alike(one: FoundBox, other: FoundBox) -> bool:
    pixels, score = SAME
    return (
        one.label == other.label
        and np.allclose(one.box, other.box, rtol=0, atol=pixels)
        and abs(one.score - other.score) <= score
    )
