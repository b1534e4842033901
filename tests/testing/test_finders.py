"""The contract of finders finds broken ones; those that come along are held to it elsewhere."""

import numpy as np
import pytest
from tests.robot.perception import own_finders

from memorymaze.robot.perception import ObjectFinder
from memorymaze.testing import check_object_finder

PICTURE = np.full((480, 640, 3), 128, dtype=np.uint8)


def test_one_of_ones_own_keeps_it() -> None:
    finder = own_finders.Middle(own_finders.MiddleOptions())
    check_object_finder(finder, PICTURE, "red chair")
    check_object_finder(own_finders.Blind())
    check_object_finder(own_finders.Tires(), repeatable=False)


@pytest.mark.parametrize(
    ("finder", "says"),
    [
        (own_finders.Shares(), "boxes in pixels, not in shares"),
        (own_finders.Turned(), "expected a box as left, top, right, bottom"),
        (own_finders.Tuples(), "expected find to return FoundBox"),
        (own_finders.Paints(), "the picture left as it is"),
        (own_finders.Tires(), "the same for the same picture"),
        (own_finders.Blind(), "'door' in the picture that was given"),
        (own_finders.Mute(), "expected a finder with `find"),
    ],
)
def test_broken_finders_are_found_out(finder: ObjectFinder, says: str) -> None:
    with pytest.raises(AssertionError, match=says):
        check_object_finder(finder, PICTURE)
