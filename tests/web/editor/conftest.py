"""Plans being edited."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest

from memorymaze.web.editor.pages import EDITOR_ROOM, LARGEST_PLAN, EditorPages
from memorymaze.web.editor.plan_file import PlanFile
from memorymaze.web.serving.entrance import Entrance
from memorymaze.web.serving.web import ServedApplication, make_app, serving
from memorymaze.world.sites.loading import new_plan

EditPlan = Callable[..., AbstractContextManager[str]]


@pytest.fixture
def annex(tmp_path: Path) -> Path:
    """The plan of `sites new`."""
    path = tmp_path / "annex.geojson"
    path.write_bytes(new_plan("annex"))
    return path


@pytest.fixture
def edit() -> EditPlan:
    """Serve the page of a plan: `with edit(path) as address`."""

    @contextmanager
    def serve(path: Path, picture: Path | None = None) -> Iterator[str]:
        entrance = Entrance("token", "editor", "Open the printed address.")
        pages = EditorPages(PlanFile(path), entrance, picture)
        app = make_app(
            pages.routes,
            EDITOR_ROOM,
            max_body=LARGEST_PLAN,
            hosts=["127.0.0.1"],
            rate=None,
        )
        with serving(ServedApplication(app)) as [address]:
            yield address

    return serve
