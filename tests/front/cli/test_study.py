import signal
import ssl
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx2
import pytest
from tests.web.studies.made_up_people import let_take_part

from memorymaze.web.studies.study_file import load_study

Memorymaze = Callable[..., Any]
TINY_SITES = Path(__file__).parents[2] / "tiny_sites"


def test_a_new_study_says_what_to_type_next(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    said = memorymaze("study", "new", path, "--site", "museum_5f", "--kind", "memory")
    assert said.code == 0
    assert f"memorymaze study serve {path}" in said.out
    assert 'kind = "memory"' in path.read_text(encoding="utf-8")
    again = memorymaze("study", "new", path, "--site", "museum_5f")
    assert again.code == 2
    assert "exists already" in again.err


def test_a_study_is_exported_and_read_by_the_other_verbs(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path, out = tmp_path / "mine.toml", tmp_path / "mine.jsonl"
    plan = TINY_SITES / "t_junction.geojson"
    memorymaze("study", "new", path, "--site", plan, "--kind", "memory")
    said = memorymaze("study", "export", path, "--out", out)
    assert "there are no answers yet" in said.err
    let_take_part(load_study(path), 4)
    said = memorymaze("study", "export", path, "--out", out)
    assert "written by people" in said.out
    checked = memorymaze("instructions", "check", out, "--sites", TINY_SITES)
    assert (checked.code, "no problems" in checked.err) == (0, True)
    counted = memorymaze("instructions", "stats", out, "--sites", TINY_SITES)
    assert "memory" in counted.out


def test_a_study_is_not_shown_to_others_before_its_contact_is_changed(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    memorymaze("study", "new", path, "--site", "museum_5f")
    said = memorymaze("study", "serve", path, "--host", "0.0.0.0")
    assert said.code == 1
    assert "field 'contact': expected who answers questions" in said.err
    assert not (tmp_path / "mine.films").exists()


def test_a_missing_extra_is_named_with_what_to_type(
    memorymaze: Memorymaze, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "starlette", None)
    said = memorymaze("study", "serve", tmp_path / "mine.toml")
    assert said.code == 2
    assert "the package starlette is not installed; type: " in said.err


def test_a_participant_is_withdrawn_by_the_id_of_a_platform(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    memorymaze("study", "new", path, "--site", TINY_SITES / "t_junction.geojson")
    let_take_part(load_study(path), 1)
    said = memorymaze("study", "withdraw", path, "made-up-0")
    assert (said.code, "nothing of them is left" in said.out) == (0, True)
    again = memorymaze("study", "withdraw", path, "made-up-0")
    assert again.code == 1
    assert "there is no participant 'made-up-0'" in again.err


def test_a_study_is_served_at_the_printed_addresses_until_ctrl_c(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    memorymaze("study", "new", path, "--site", TINY_SITES / "corridor.geojson")
    (tmp_path / "own.mp4").write_bytes(b"a video of one's own")
    with path.open("a", encoding="utf-8") as file:
        file.write('video = "own.mp4"\n')
    command = [sys.executable, "-m", "memorymaze", "study", "serve", str(path)]
    free = ["--port", "0", "--experimenter-port", "0"]
    server = subprocess.Popen([*command, *free], stdout=subprocess.PIPE, text=True)
    assert server.stdout is not None
    told = [server.stdout.readline().split(maxsplit=1) for _ in range(3)]
    assert [line[0] for line in told] == ["participants:", "experimenter:", "Ctrl-C"]
    assert "Welcome" in httpx2.get(told[0][1].strip()).text
    shown = httpx2.get(told[1][1].strip())
    assert (shown.status_code, "set-cookie" in shown.headers) == (303, True)
    again = memorymaze("study", "serve", path, *free)
    assert again.code == 1
    assert f"are being written already, by the process {server.pid}" in again.err
    server.send_signal(signal.SIGINT)
    assert server.wait(timeout=30) == 0
    server.stdout.close()


def test_a_study_on_site_is_served_over_https_and_explains_how_to_trust_it(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    plan = TINY_SITES / "corridor.geojson"
    memorymaze("study", "new", path, "--site", plan, "--kind", "onsite")
    command = [sys.executable, "-m", "memorymaze", "study", "serve", str(path)]
    server = subprocess.Popen(
        [*command, "--experimenter-port", "0", "--tls"],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert server.stdout is not None
    told = [server.stdout.readline() for _ in range(5)]
    entrance = told[0].split()[1]
    authority = tmp_path / "mine.tls" / "authority.crt"
    assert entrance.startswith("https://127.0.0.1:")
    assert str(authority) in told[1]
    assert f"{entrance.partition('/enter/')[0]}/trust explains" in told[2]
    trusting = ssl.create_default_context(cafile=str(authority))
    with httpx2.Client(verify=trusting, follow_redirects=True) as tablet:
        tablet.get(entrance)
        trust = tablet.get(told[2].split()[1])
        assert told[3].split()[-1] in trust.text
        given = tablet.get(str(trust.url) + "/authority.crt")
        assert given.content == authority.read_bytes()
        assert "Or type what is said" in tablet.get(f"{trust.url}/../interview").text
    server.send_signal(signal.SIGINT)
    assert server.wait(timeout=30) == 0
    server.stdout.close()


def test_a_certificate_is_made_for_one_address_only(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    memorymaze("study", "new", path, "--site", "museum_5f", "--kind", "onsite")
    text = path.read_text(encoding="utf-8").replace("PLEASE CHANGE: your", "Our")
    path.write_text(text, encoding="utf-8")
    said = memorymaze("study", "serve", path, "--tls", "--host", "0.0.0.0")
    assert said.code == 2
    assert "expected with --host the one address that the tablet goes to" in said.err
