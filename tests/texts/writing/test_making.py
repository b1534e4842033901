"""What cannot be made is refused."""

from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.texts.writing import GenerationRequest, make_instructions, parse_rates


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"site": "crossng"}, "--site: expected one of"),
        ({"route": "R7"}, "--route: expected a route"),
    ],
)
def test_a_place_that_is_not_there_is_refused(
    tiny_sites_folder: Path, change: dict[str, str], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        make_instructions(GenerationRequest(sites_folder=tiny_sites_folder, **change))


def test_numbers_without_meaning_are_refused(tiny_sites_folder: Path) -> None:
    with pytest.raises(SettingsError, match="--per-cell: expected"):
        GenerationRequest(per_cell=0)
    with pytest.raises(SettingsError, match="no pairs"):
        GenerationRequest(paired=True, rates=parse_rates("none"))
