import json
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

from memorymaze.basics.errors import SettingsError
from memorymaze.runs.report.leaderboard import (
    Leaderboard,
    read_leaderboard,
    write_leaderboard,
)
from memorymaze.runs.report.pages import Pages
from memorymaze.texts.corpus import load_corpus

TESTS = Path(__file__).parents[2]


def read(folder: Path) -> Leaderboard:
    return read_leaderboard(
        folder,
        load_corpus(TESTS / "tiny_instructions.jsonl", sites=TESTS / "tiny_sites"),
    )


@pytest.fixture
def submitted(runs: dict[str, Path], tmp_path: Path) -> Path:
    """`guide` and `stop` by committed code, one by edited code, and no run at all."""
    folder = tmp_path / "submitted"
    for name, run in (("guide", "guide"), ("stop", "stop"), ("edited", "stop")):
        shutil.copytree(runs[run], folder / name)
        file = folder / name / "run.json"
        record = json.loads(file.read_text(encoding="utf-8"))
        record["code"]["commit"] = "0123456789" + "+" * (name == "edited")
        file.write_text(json.dumps(record), encoding="utf-8")
    (folder / "nothing").mkdir()
    (folder / "README").write_text("not a run", encoding="utf-8")
    return folder


def test_runs_stand_in_the_order_of_their_success(
    submitted: Path, tmp_path: Path, opened: Callable[..., Page]
) -> None:
    write_leaderboard(read(submitted), tmp_path / "out")
    page = opened(tmp_path / "out" / "index.html")
    rows = page.locator("table").first.locator("tbody").first.locator("tr")
    assert [re.split(r"\s+", text)[:2] for text in rows.all_inner_texts()] == [
        ["1", "guide"],
        ["2", "stop"],
    ]
    head = page.get_by_role("columnheader", name="SPD (m)", exact=True).first
    head.get_by_role("button").press("Enter")
    assert head.get_attribute("aria-sort") == "ascending"
    head.get_by_role("button").press("Enter")
    assert head.get_attribute("aria-sort") == "descending"
    assert "stop" in rows.first.inner_text()
    page.get_by_role("link", name="guide").first.click()
    assert "settings.seed" in page.locator("main").inner_text()


def test_the_page_passes_the_accessibility_checks_of_axe(
    submitted: Path,
    tmp_path: Path,
    opened: Callable[..., Page],
    complaints: Callable[[Page], list[str]],
) -> None:
    write_leaderboard(read(submitted), tmp_path / "out")
    page = opened(tmp_path / "out" / "index.html", bypass_csp=True)
    assert complaints(page) == []


def test_runs_that_cannot_stand_on_it_are_listed_with_the_reason(
    submitted: Path, tmp_path: Path
) -> None:
    board = read(submitted)
    assert [each.name for each in board.standing] == ["guide", "stop"]
    reasons = {each.name: each.reasons[0] for each in board.refused}
    assert "expected a run by committed code" in reasons["edited"]
    assert "a folder without run.json" in reasons["nothing"]
    write_leaderboard(board, tmp_path / "out")
    text = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert "expected a run by committed code" in text
    assert "README" not in text


def test_a_damaged_run_is_named_and_left_out_and_the_others_stand(
    submitted: Path,
) -> None:
    trace = next((submitted / "stop" / "traces").rglob("*.gz"))
    content = trace.read_bytes()
    # The bits that say how the first block is packed.
    trace.write_bytes(content[:10] + bytes([content[10] | 6]) + content[11:])
    (submitted / "nothing" / "run.json").write_text("[" * 100_000, encoding="utf-8")
    board = read(submitted)
    assert [each.name for each in board.standing] == ["guide"]
    reasons = {each.name: each.reasons for each in board.refused}
    assert str(trace) in reasons["stop"][0]
    assert "run.json" in reasons["nothing"][0]


def test_a_leaderboard_that_fails_leaves_nothing_that_blocks_the_next(
    submitted: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    board = read(submitted)

    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as disk:
        disk.setattr(Pages, "copy_static", full)
        with pytest.raises(OSError, match="No space"):
            write_leaderboard(board, tmp_path / "out")
    assert not (tmp_path / "out").exists()
    write_leaderboard(board, tmp_path / "out")
    assert (tmp_path / "out" / "index.html").exists()


def test_a_leaderboard_without_runs_says_so(tmp_path: Path) -> None:
    (tmp_path / "in" / "nothing").mkdir(parents=True)
    write_leaderboard(read(tmp_path / "in"), tmp_path / "out")
    text = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert "No run stands on this leaderboard yet" in text


def test_a_folder_that_holds_no_runs_is_refused(
    runs: dict[str, Path], tmp_path: Path
) -> None:
    with pytest.raises(SettingsError, match="got a run folder"):
        read(runs["stop"])
    with pytest.raises(SettingsError, match="got none"):
        read(tmp_path)
    with pytest.raises(SettingsError, match="No such file"):
        read(tmp_path / "none")
