import gzip
import json
import re
import shutil
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.runs.episodes.trace import trace_path
from memorymaze.runs.report import read_sources

Reported = Callable[..., list[str]]


def files_of(folder: Path) -> dict[str, bytes]:
    return {
        str(file.relative_to(folder)): file.read_bytes()
        for file in sorted(folder.rglob("*"))
        if file.is_file()
    }


def test_equal_runs_give_equal_files(
    report: Path, runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    reported(tmp_path / "again", *runs.values())
    assert files_of(tmp_path / "again") == files_of(report)


def test_nothing_is_fetched_from_elsewhere(report: Path) -> None:
    for name, content in files_of(report).items():
        links = re.findall(rb"(?:src|href|url)\s*[=(]\s*[\"']?\s*(\w+:|//)", content)
        assert links == [], name


def test_every_link_leads_to_a_file_or_place_of_the_report(report: Path) -> None:
    for page in report.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        for link in re.findall(r'(?:src|href)="([^"]+)"', text):
            file, _, place = link.partition("#")
            target = (page.parent / file) if file else page
            assert target.resolve().is_file(), (page, link)
            if place and target.suffix == ".html":
                assert f'id="{place}"' in target.read_text(encoding="utf-8"), link


def test_every_page_says_that_a_model_wrote_the_instructions(
    hostile_report: Path,
) -> None:
    for page in hostile_report.rglob("*.html"):
        assert "LANGUAGE MODEL, not by people" in page.read_text(encoding="utf-8")


def test_no_page_holds_characters_that_html_does_not_allow(
    hostile_report: Path,
) -> None:
    for name, content in files_of(hostile_report).items():
        assert re.findall(rb"[\x00-\x08\x0b\x0c\x0e-\x1f]", content) == [], name


def test_one_of_a_kind_is_counted_in_the_singular(hostile_report: Path) -> None:
    plural = re.compile(r"\b1 (?:episodes|walks|instructions|turns|routes|times)\b")
    for page in hostile_report.rglob("*.html"):
        # What notes on runs say is the tables' matter.
        if page.name != "index.html":
            assert plural.findall(page.read_text(encoding="utf-8")) == [], page
    episodes = (hostile_report / "episodes.html").read_text(encoding="utf-8")
    assert "1 episode<" in episodes


def test_pages_have_one_first_heading_and_skip_no_level(report: Path) -> None:
    for page in report.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        levels = [int(level) for level in re.findall(r"<h(\d)", text)]
        assert levels.count(1) == 1, page
        assert all(after - before <= 1 for before, after in pairwise(levels)), page


def test_tables_have_captions_and_heads_with_scope(report: Path) -> None:
    for page in report.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        assert text.count("<table") == text.count("<caption"), page
        assert re.findall(r"<th(?![^>]*scope=)[ >]", text) == [], page


def test_any_id_gives_a_harmless_file_name(hostile_report: Path) -> None:
    for file in hostile_report.rglob("*"):
        assert re.fullmatch(r"[a-z0-9_-]+(\.[a-z]+)?", file.name), file
    [page] = (hostile_report / "episodes").iterdir()
    assert re.fullmatch(r"a-b-x-[0-9a-f]{10}\.html", page.name)


def test_a_trace_that_cannot_be_read_costs_its_own_walk_only(
    runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    run = shutil.copytree(runs["guide"], tmp_path / "guide")
    traces = sorted((run / "traces").iterdir())
    traces[0].write_bytes(b"nothing")
    episode = traces[0].name.removesuffix(".jsonl.gz")
    assert trace_path(run, episode) == traces[0]
    [note] = reported(tmp_path / "out", run)
    assert f"episode {episode!r} is damaged" in note
    pages = {
        p.stem: p.read_text("utf-8") for p in (tmp_path / "out/episodes").iterdir()
    }
    assert "trace cannot be read" in pages.pop(episode)
    assert all("trace cannot be read" not in text for text in pages.values())


def test_instructions_with_another_text_are_told(
    runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    run = shutil.copytree(runs["stop"], tmp_path / "other")
    file = run / "instructions.jsonl.gz"
    content = gzip.decompress(file.read_bytes()).replace(b'"text":"', b'"text":"Oh: ')
    file.write_bytes(gzip.compress(content))
    [note] = reported(tmp_path / "out", runs["stop"], run)
    assert "of run B had another text" in note


def test_a_report_is_replaced_only_on_request(
    runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    reported(out, runs["stop"])
    (out / "old.txt").write_text("old", encoding="utf-8")
    with pytest.raises(SettingsError, match="exists already"):
        reported(out, runs["stop"])
    assert (out / "old.txt").exists()
    reported(out, runs["stop"], overwrite=True)
    assert (out / "index.html").exists()
    assert not (out / "old.txt").exists()


def test_what_is_no_report_is_never_replaced(
    runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    (tmp_path / "mine.txt").write_text("keep", encoding="utf-8")
    with pytest.raises(SettingsError, match="is no folder with static"):
        reported(tmp_path, runs["stop"], overwrite=True)
    with pytest.raises(SettingsError, match="expected a folder to make"):
        reported(Path(), runs["stop"], overwrite=True)
    assert [file.name for file in tmp_path.iterdir()] == ["mine.txt"]


def test_a_report_that_fails_leaves_nothing_behind(
    runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    def stop(done: int, total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        reported(tmp_path / "out", runs["stop"], progress=stop)
    assert list(tmp_path.iterdir()) == []
    reported(tmp_path / "out", runs["stop"])
    assert [file.name for file in tmp_path.iterdir()] == ["out"]


def test_a_folder_with_something_in_it_is_left_alone(
    runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    (tmp_path / "mine.txt").write_text("keep", encoding="utf-8")
    with pytest.raises(SettingsError, match="exists already"):
        reported(tmp_path, runs["stop"])
    assert [file.name for file in tmp_path.iterdir()] == ["mine.txt"]


def test_the_version_of_an_agent_of_ones_own_is_shown(
    runs: dict[str, Path], report: Path
) -> None:
    record = json.loads((runs["programmer"] / "run.json").read_text(encoding="utf-8"))
    [file] = record["settings"]["agent_files"]
    overview = (report / "index.html").read_text(encoding="utf-8")
    assert f"{file['name']} {file['sha256'][:12]}" in overview
    settings = (report / "settings.html").read_text(encoding="utf-8")
    assert file["sha256"] in settings


def test_what_cannot_be_reported_on_is_named(
    runs: dict[str, Path], tmp_path: Path
) -> None:
    stop = runs["stop"]
    with pytest.raises(RunFolderError, match="no such folder"):
        read_sources([tmp_path / "none"])
    with pytest.raises(SettingsError, match="once, got it twice"):
        read_sources([stop, stop])
    run = shutil.copytree(stop, tmp_path / "run")
    (run / "instructions.jsonl.gz").unlink()
    with pytest.raises(RunFolderError, match="expected the instructions of the run"):
        read_sources([run])
    shutil.rmtree(run / "plans")
    with pytest.raises(RunFolderError, match="expected the plans of the run's sites"):
        read_sources([run])


def test_pages_show_how_the_belief_went_of_agents_that_tell_it(report: Path) -> None:
    for page in (report / "episodes").iterdir():
        text = page.read_text(encoding="utf-8")
        # Of three agents two tell it.
        assert text.count('<figure class="belief">') == 2
        assert "<td>0 of 2 legs done</td>" in text
        assert "<td>2 of 2 legs done</td>" in text
        assert "doubts leg 1 (0.60); repairs leg 1: no such turn" in text
        assert "gave up, confidence 0.15." in text


def test_the_page_on_confidence_plots_whoever_told_one(report: Path) -> None:
    text = (report / "confidence.html").read_text(encoding="utf-8")
    assert "what agents claimed, and what came of it" in text
    figures = re.findall(r"<figcaption>(.*?), \w+: \d+ episode", text)
    assert set(figures) == {"A: guide", "C: programmer"}
    assert "told 0.15 on average, 0.00 of" in text


def test_a_report_says_where_no_agent_told_how_sure_it_was(
    runs: dict[str, Path], reported: Reported, tmp_path: Path
) -> None:
    assert reported(tmp_path / "out", runs["stop"]) == []
    text = (tmp_path / "out" / "confidence.html").read_text(encoding="utf-8")
    assert "No agent told how sure it was." in text
