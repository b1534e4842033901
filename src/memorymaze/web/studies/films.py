"""The videos of a study: made once for each route, while its pages are served already."""

import json
import math
import sys
import threading
import time
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Literal

from memorymaze.basics.video_file import require_encoder
from memorymaze.basics.wording import counted
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.runs.films import WalkthroughSettings
from memorymaze.runs.films.walkthrough import film_walkthrough
from memorymaze.web.studies.study_file import RouteShown, Study
from memorymaze.world.cameras.open_gl import choose_backend
from memorymaze.world.sites.plan import plan_bytes


@dataclass(frozen=True, slots=True)
class FilmState:
    """How far a video is."""

    route: str
    state: Literal["ready", "being made", "waiting", "failed"]
    share: float = 0.0
    """Of what is made of it, up to 1."""
    seconds_left: float | None = None
    """Until it is ready; None where nobody can tell."""
    problem: str = ""
    """Why it failed."""

    @property
    def left(self) -> str:
        """The time left in words; empty where nobody can tell."""
        if self.seconds_left is None:
            return ""
        if self.seconds_left < 60:
            return "less than a minute"
        return f"about {counted(math.ceil(self.seconds_left / 60), 'minute')}"


class Films:
    """The videos of a study: those that are there, and those that are being made."""

    def __init__(self, study: Study) -> None:
        """Look which videos are there.

        Raises:
            SettingsError: One is missing, and so is the extra `video`.
            RenderingError: One is missing, and this machine cannot draw.
        """
        self._study = study
        self.paths = {each.route: _film(study, each) for each in study.design.routes}
        """Where the video of each route is, or will be."""
        self._missing = [r for r, path in self.paths.items() if not path.is_file()]
        self._metres = {r: study.route(r).line.length for r in self._missing}
        self._share = dict.fromkeys(self._missing, 0.0)
        self._problem = ""
        self._began = 0.0
        self._ended = threading.Event()
        if self._missing:
            require_encoder()
            choose_backend()

    def ready(self, route: str) -> Path | None:
        """Return a route's video; None while it is not there as a whole."""
        path = self.paths[route]
        return path if path.is_file() else None

    def state(self, route: str) -> FilmState:
        """Tell how far a route's video is."""
        if self.ready(route) is not None:
            return FilmState(route, "ready", 1.0, 0.0)
        share = self._share[route]
        if self._problem:
            return FilmState(route, "failed", share, problem=self._problem)
        return FilmState(
            route, "being made" if share else "waiting", share, self._left(route)
        )

    def _left(self, route: str) -> float | None:
        """Estimate by the metres of way that were filmed so far."""
        filmed = sum(self._metres[r] * self._share[r] for r in self._missing)
        if not filmed:
            return None
        wanted = self._missing[: self._missing.index(route) + 1]
        left = sum(self._metres[r] * (1 - self._share[r]) for r in wanted)
        return (time.monotonic() - self._began) * left / filmed

    @contextmanager
    def being_made(self) -> Generator[None]:
        """Make what is missing meanwhile, with progress on stderr; break off at the end."""
        maker = threading.Thread(target=self._make, daemon=True)
        if self._missing:
            maker.start()
        try:
            yield
        finally:
            self._ended.set()
            if self._missing:
                maker.join()

    def _make(self) -> None:
        try:
            self._film_all()
        except _BrokenOff:
            pass
        except Exception as error:
            # Whatever it is, the pages go on and tell the experimenter.
            self._problem = str(error) or type(error).__name__
            print(
                f"memorymaze: the videos cannot be made: {self._problem}",
                file=sys.stderr,
            )

    def _film_all(self) -> None:
        self._began = time.monotonic()
        scene = build_scene(self._study.site)
        for number, route in enumerate(self._missing, start=1):
            path = self.paths[route]
            print(
                f"memorymaze: making the video of {route} ({number} of "
                f"{len(self._missing)}), once; it is kept as {path}",
                file=sys.stderr,
            )
            path.parent.mkdir(parents=True, exist_ok=True)

            def tell(done: int, count: int, route: str = route) -> None:
                self._share[route] = done / count
                if self._ended.is_set():
                    raise _BrokenOff

            film_walkthrough(
                scene,
                self._study.route(route),
                path,
                _settings(self._study),
                progress=True,
                told=tell,
            )


class _BrokenOff(Exception):
    """Nobody wants the film any more."""


def _settings(study: Study) -> WalkthroughSettings:
    wanted = study.design.walkthrough
    return WalkthroughSettings(
        size=(wanted.width, wanted.width // 2),
        panorama=True,
        fps=wanted.fps,
        speed=wanted.speed,
    )


def _film(study: Study, shown: RouteShown) -> Path:
    if shown.video is not None:
        return study.path.parent / shown.video
    # Another plan, route or setting is another film.
    made_from = json.dumps([
        sha256(plan_bytes(study.site)).hexdigest(),
        study.route(shown.route).id,
        study.design.walkthrough.model_dump(),
    ])
    name = f"{shown.route}-{sha256(made_from.encode()).hexdigest()[:12]}.mp4"
    return study.path.with_suffix(".films") / name
