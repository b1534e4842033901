import re
import signal
import subprocess
import sys
from pathlib import Path

import httpx2
import pytest

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.front.cli.main import command_line
from memorymaze.world.sites.loading import new_plan


def test_the_printed_address_opens_the_page_until_ctrl_c(tmp_path: Path) -> None:
    plan = tmp_path / "annex.geojson"
    plan.write_bytes(new_plan("annex"))
    command = [sys.executable, "-m", "memorymaze", "sites", "edit", str(plan)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as editor:
        assert editor.stdout is not None
        found = re.search(r"edit annex\.geojson at (\S+)", editor.stdout.readline())
        assert found
        with httpx2.Client(follow_redirects=True) as client:
            assert "Edit annex.geojson" in client.get(found[1]).text
        editor.send_signal(signal.SIGINT)
        assert editor.wait(timeout=20) == 0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        pytest.param(
            ["new.geojson", "--picture", "none.png"],
            "expected a file that ends in .png, .* none: no such file",
            id="a picture that is not there",
        ),
        pytest.param(
            ["new.geojson", "--port", "99999999"], "to 65535, got 99999999", id="port"
        ),
        pytest.param(["university"], r"expected a plan's file, \*\.geojson", id="name"),
    ],
)
def test_what_cannot_be_edited_is_refused_before_a_page_is_served(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    options = command_line().parse_args(["sites", "edit", *arguments])
    with pytest.raises(MemoryMazeError, match=said):
        options.run(options)
    assert list(tmp_path.iterdir()) == []
