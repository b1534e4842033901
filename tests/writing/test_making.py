"""Instructions that are made for a run lie in its folder."""

from pathlib import Path

import pytest

from memorymaze.errors import RunFolderError, SettingsError
from memorymaze.instructions import load_instructions
from memorymaze.writing import GenerationRequest, make_instructions, parse_rates
from memorymaze.writing.making import instructions_for_run


def _request(folder: Path, seed: int = 0) -> GenerationRequest:
    return GenerationRequest(
        sites_folder=folder, site="crossing", per_cell=2, seed=seed
    )


def test_the_same_request_finds_its_file_again(
    tiny_sites_folder: Path, tmp_path: Path
) -> None:
    request = _request(tiny_sites_folder)
    path = instructions_for_run(tmp_path / "run", request)
    content = path.read_bytes()
    assert instructions_for_run(tmp_path / "run", request) == path
    assert path.read_bytes() == content
    assert len(load_instructions([path])) == 8


def test_another_request_does_not_touch_the_file(
    tiny_sites_folder: Path, tmp_path: Path
) -> None:
    path = instructions_for_run(tmp_path, _request(tiny_sites_folder))
    content = path.read_bytes()
    with pytest.raises(RunFolderError, match="choose another folder"):
        instructions_for_run(tmp_path, _request(tiny_sites_folder, seed=1))
    assert path.read_bytes() == content


def test_a_folder_with_another_run_is_left_alone(
    tiny_sites_folder: Path, tmp_path: Path
) -> None:
    (tmp_path / "run.json").write_text("{}", encoding="utf-8")
    with pytest.raises(RunFolderError, match="holds a run"):
        instructions_for_run(tmp_path, _request(tiny_sites_folder))
    assert not (tmp_path / "generated.jsonl").exists()


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
