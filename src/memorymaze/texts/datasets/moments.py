"""Means, deviations and ranges of columns of numbers, added up piece by piece."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry.points import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class RowMoments:
    """What is known of some rows; all arrays have the shape of a row."""

    count: int
    total: FloatArray
    squares: FloatArray
    lowest: FloatArray
    highest: FloatArray

    @classmethod
    def none(cls) -> "RowMoments":
        """Return what is known of no rows."""
        none, far = np.zeros(1), np.full(1, np.inf)
        return cls(0, none, none, far, -far)

    @classmethod
    def of(cls, rows: NDArray[Any], times: int = 1) -> "RowMoments":
        """Return what is known of rows, (N, C), each of them counted so many times."""
        values = rows.astype(np.float64)
        return cls(
            times * len(values),
            times * values.sum(axis=0),
            times * (values**2).sum(axis=0),
            values.min(axis=0),
            values.max(axis=0),
        )

    def __add__(self, other: "RowMoments") -> "RowMoments":
        """Return what is known of both."""
        return RowMoments(
            self.count + other.count,
            self.total + other.total,
            self.squares + other.squares,
            np.minimum(self.lowest, other.lowest),
            np.maximum(self.highest, other.highest),
        )

    def record(self, *, picture: bool) -> dict[str, Any]:
        """Return LeRobot's statistics; those of pictures have the shape (C, 1, 1)."""
        mean = self.total / self.count
        deviation = np.sqrt(np.maximum(self.squares / self.count - mean**2, 0.0))
        shape = (-1, 1, 1) if picture else (-1,)
        return {
            "min": self.lowest.reshape(shape).tolist(),
            "max": self.highest.reshape(shape).tolist(),
            "mean": mean.reshape(shape).tolist(),
            "std": deviation.reshape(shape).tolist(),
            "count": [self.count],
        }
