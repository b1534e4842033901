"""The videos of a study: made once for each route, and kept beside the study file."""

import json
import sys
from hashlib import sha256
from pathlib import Path

from memorymaze.pictures.films import WalkthroughSettings, film_walkthrough
from memorymaze.simulation.scene import build_scene
from memorymaze.studies.study_file import RouteShown, Study


def make_films(study: Study) -> dict[str, Path]:
    """Return the video of each route; what is missing is made, with progress on stderr."""
    films = {each.route: _film(study, each) for each in study.design.routes}
    missing = {route: path for route, path in films.items() if not path.is_file()}
    if not missing:
        return films
    scene = build_scene(study.site)
    for number, (route, path) in enumerate(missing.items(), start=1):
        print(
            f"memorymaze: making the video of {route} ({number} of {len(missing)}), "
            f"once; it is kept as {path}",
            file=sys.stderr,
        )
        path.parent.mkdir(parents=True, exist_ok=True)
        film_walkthrough(
            scene, study.route(route), path, _settings(study), progress=True
        )
    return films


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
        sha256(study.site.plan).hexdigest(),
        study.route(shown.route).id,
        study.design.walkthrough.model_dump(),
    ])
    name = f"{shown.route}-{sha256(made_from.encode()).hexdigest()[:12]}.mp4"
    return study.path.with_suffix(".films") / name
