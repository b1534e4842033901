"""One small dataset that the tests of this room look at, and do not change."""

from pathlib import Path

import pytest

from memorymaze.texts.datasets import DatasetRequest, make_dataset


@pytest.fixture(scope="session")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A dataset of three buildings, half of its texts with an error."""
    folder = tmp_path_factory.mktemp("datasets") / "made"
    request = DatasetRequest(buildings=3, per_route=4, errors="failure=0.5")
    make_dataset(request, folder, workers=1)
    return folder
