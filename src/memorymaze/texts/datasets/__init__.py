"""Datasets of made buildings with made texts: splits, files, frames of perfect walks.

Does not hold how buildings (`construction`) and texts (`writing`) are made, nor running
agents on them (`runs`).
"""

from memorymaze.texts.datasets.making import (
    DatasetRequest,
    check_dataset_folder,
    make_dataset,
)

__all__ = ["DatasetRequest", "check_dataset_folder", "make_dataset"]
