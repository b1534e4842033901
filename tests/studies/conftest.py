"""Small studies on tiny sites."""

from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.sites import load_site
from memorymaze.studies.study_file import Kind, Study, load_study, new_study

T_SITE = Path(__file__).parents[1] / "tiny_sites" / "t_junction.geojson"


@pytest.fixture
def make_study(tmp_path: Path) -> Callable[..., Study]:
    """Write a study of two routes and load it: `make_study("memory", "quota = 2")`.

    Lines of the file that begin as the values do are replaced by them.
    """

    def make(kind: Kind = "online", *replaced: str) -> Study:
        path = tmp_path / f"{kind}.toml"
        path.unlink(missing_ok=True)
        new_study(path, load_site(T_SITE), kind, str(T_SITE))
        lines = path.read_text(encoding="utf-8").splitlines()
        for new in replaced:
            name = new.partition("=")[0] + "="
            [place] = [n for n, line in enumerate(lines) if line.startswith(name)]
            lines[place] = new
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return load_study(path)

    return make
