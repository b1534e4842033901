"""Small studies on tiny sites."""

import re
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx2
import numpy as np
import pytest

from memorymaze.basics.video_file import write_video
from memorymaze.web.studies.films import Films
from memorymaze.web.studies.serving import Addresses, serving_study
from memorymaze.web.studies.store import Store, open_store
from memorymaze.web.studies.study_file import Study, StudyKind, load_study, new_study
from memorymaze.world.sites import load_site

ServeStudy = Callable[[Study], AbstractContextManager["Served"]]
T_SITE = Path(__file__).parents[2] / "tiny_sites" / "t_junction.geojson"


@pytest.fixture
def make_study(tmp_path: Path) -> Callable[..., Study]:
    """Write a study of two routes and load it: `make_study("memory", "quota = 2")`.

    Lines of the file that begin as the values do are replaced by them.
    """

    def make(kind: StudyKind = "online", *replaced: str) -> Study:
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


@pytest.fixture(scope="session")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A video of two seconds: red ahead, green on the left, blue on the right."""
    path = tmp_path_factory.mktemp("films") / "film.mp4"
    picture = np.zeros((160, 320, 3), dtype=np.uint8)
    for channel, columns in enumerate([
        slice(120, 200),
        slice(40, 120),
        slice(200, 280),
    ]):
        picture[:, columns, channel] = 220
    write_video(path, [picture] * 20, (320, 160), 10, title="Colours", total=20)
    return path


@dataclass(frozen=True)
class Served:
    """A study that is served."""

    store: Store
    addresses: Addresses
    visits: ExitStack

    def browse(self) -> "Visitor":
        """Come as a participant with a browser of one's own."""
        visitor = Visitor(self.addresses.participants)
        self.visits.enter_context(visitor.client)
        return visitor


@pytest.fixture
def serve_study(film: Path) -> ServeStudy:
    """Serve a study whose videos are there: `with serve_study(study) as served`."""

    @contextmanager
    def serve(study: Study) -> Iterator[Served]:
        films = None
        if study.design.kind in {"online", "memory"}:
            for path in Films(study).paths.values():
                path.parent.mkdir(exist_ok=True)
                path.write_bytes(film.read_bytes())
            films = Films(study)
        with (
            open_store(study) as store,
            serving_study(store, films) as addresses,
            ExitStack() as visits,
        ):
            yield Served(store, addresses, visits)

    return serve


@pytest.fixture
def served(
    make_study: Callable[..., Study], serve_study: ServeStudy
) -> Iterator[Served]:
    """A study of the kind `online` that is served."""
    with serve_study(make_study()) as served:
        yield served


@pytest.fixture
def one(served: Served) -> "Visitor":
    """Somebody who comes to it."""
    return served.browse()


class Visitor:
    """Somebody who reads pages and sends forms, without scripts."""

    def __init__(self, address: str) -> None:
        self.client = httpx2.Client(base_url=address, follow_redirects=True)
        self.page = ""

    def get(self, path: str) -> str:
        self.page = self.client.get(path).text
        return self.page

    def post(self, path: str, **fields: str) -> httpx2.Response:
        """Send a form with the token of the page that is open."""
        found = re.search(r'name="csrf-token" content="(\w+)"', self.page)
        assert found, self.page
        fields = {
            name if "." in name else name.replace("_", ".", 1): value
            for name, value in fields.items()
        }
        sent = self.client.post(path, data={"csrf_token": found[1]} | fields)
        if sent.headers.get("content-type", "").startswith("text/html"):
            self.page = sent.text
        return sent

    def consent(self, query: str = "") -> None:
        """Take part."""
        self.get(f"/{query}")
        ids = re.findall(r'name="id\.(\w+)" value="([^"]*)"', self.page)
        fields = {f"id.{name}": value for name, value in ids}
        fields |= {f"consent.{number}": "on" for number in range(3)}
        self.post("/consent", **fields)

    def send(self, **fields: str) -> httpx2.Response:
        """Send the form of the step that is open."""
        found = re.search(r'action="(/study/[^"]+)"', self.page)
        assert found, self.page
        attempt = re.findall(r'name="(attempt)" value="(\d+)"', self.page)
        return self.post(found[1], **dict(attempt), **fields)

    def reach_first_way(self, query: str = "") -> None:
        """Consent and answer what comes before the first way."""
        self.consent(query)
        self.send(answer_0="1", answer_1="0")
        self.send(answer_0="0")
        self.send()
