"""Places and arrays of numbers, as all rooms write their types."""

import numpy as np
from numpy.typing import NDArray

XY = tuple[float, float]
"""A place, metres."""
FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
