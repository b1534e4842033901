"""From an episode of a run to a recording for the Rerun viewer (https://rerun.io)."""

import io
import math
from collections.abc import Generator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageColor

from memorymaze.drawing.shapes import (
    FOUND_COLOR,
    INKS,
    PEOPLE_COLOR,
    THING_COLOR,
    VARIETIES,
    WALK_COLOR,
    plan_shapes,
    route_color,
)
from memorymaze.durable_files import replaced_when_whole
from memorymaze.errors import SettingsError
from memorymaze.evaluation.outcomes import outcome_line, source_line
from memorymaze.extras import require_extra
from memorymaze.pictures.films.video_file import check_target, progress_bar
from memorymaze.results.replay.film import ReplaySettings
from memorymaze.results.replay.senses import PICTURE_SIZE, Eyes, Scans
from memorymaze.results.story.moments import Moment, Moments
from memorymaze.results.story.recorded_episode import RecordedEpisode
from memorymaze.simulation import build_scene
from memorymaze.simulation.motion.wheeled_base import CAMERA_HEIGHT, ROBOT_RADIUS
from memorymaze.sites import Site

TIMELINE = "simulated_time"
CAMERA = "world/robot/camera"
WALL = ImageColor.getrgb(INKS["wall"].paper)
WALK, PEOPLE, THINGS, SCAN = map(
    ImageColor.getrgb, (WALK_COLOR, PEOPLE_COLOR, THING_COLOR, FOUND_COLOR)
)
PLAN = {
    "walls": ({"wall"}, WALL, 0.06),
    "doors": ({"door"}, ImageColor.getrgb(VARIETIES["door"]["wood"]), 0.05),
    "landmarks": (
        {"covering", "thing", "overhead"},
        ImageColor.getrgb(INKS["thing"].paper),
        0.03,
    ),
}
"""Entities of a plan: kinds of shapes, colour, radius of lines in metres."""
ON_FLOOR = 0.02
"""Metres over the floor at which lines lie."""
LEVELS = {"say": "INFO", "touch": "ERROR", "note": "DEBUG", "model": "DEBUG"}
MILLIMETRES = 1000.0
VIEW_EVERY = 1.0
"""Simulated seconds from one camera picture and scan to the next."""


def check_recording_path(path: str | Path) -> Path:
    """Refuse a file that cannot be written, or a machine without Rerun's package."""
    _library()
    return check_target(path, ".rrd", "--rerun")


def record_replay(
    episode: RecordedEpisode,
    path: str | Path,
    settings: ReplaySettings | None = None,
    *,
    view_every: float = VIEW_EVERY,
    progress: bool = False,
) -> None:
    """Write the recording of an episode, an rrd file; it is there in full or not at all.

    Of the settings those of the camera count. There is a picture and a scan at every
    `view_every` simulated seconds, and wherever something was detected.
    """
    if not view_every > 0:
        raise SettingsError(f"view_every: expected more than 0 s, got {view_every!r}")
    settings = settings or ReplaySettings()
    target = check_recording_path(path)
    moments = Moments(episode.story)
    scene = build_scene(episode.site, episode.record.settings.obstacles)
    scans = Scans(scene, moments)
    times = _view_times(moments, view_every)
    with ExitStack() as stack:
        stream = stack.enter_context(_stream_to(target, episode))
        eyes = None
        if settings.camera:
            eyes = Eyes(
                scene,
                moments,
                PICTURE_SIZE,
                episode.record.settings.looks,
                smooth=False,
            )
            stack.enter_context(closing(eyes))
        bar = stack.enter_context(progress_bar(len(times), "view", shown=progress))
        _log_building(stream, episode, moments)
        _log_moving(stream, episode, moments)
        for time in times:
            moment = moments.at(time)
            _log_view(stream, moment, scans.points(moment), eyes)
            bar.update()


@contextmanager
def _stream_to(target: Path, episode: RecordedEpisode) -> Generator[Any]:
    """Give a recording stream whose file takes its place when it is whole."""
    rerun = _library()
    stream: Any = rerun.RecordingStream(
        "memorymaze",
        recording_id=f"{episode.record.settings.agent.name}/{episode.result.episode_id}",
        send_properties=False,
    )
    # Only simulated time has a meaning here.
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    # What cannot be logged would only be warned of otherwise.
    was_strict = rerun.strict_mode()
    rerun.set_strict_mode(True)
    try:
        with replaced_when_whole(target) as unfinished:
            # The library itself would only warn of a file that it cannot open.
            unfinished.write_bytes(b"")
            stream.save(unfinished, default_blueprint=_blueprint_of(episode))
            stream.log(
                "about",
                rerun.TextDocument(
                    f"# {episode.result.agent} on {episode.result.episode_id}\n\n"
                    f"{episode.site.title} (simulated). {source_line(episode.result)}:"
                    f"\n\n> {episode.instruction}\n\n{outcome_line(episode.result)}",
                    media_type="text/markdown",
                ),
                static=True,
            )
            yield stream
            stream.flush()
            stream.disconnect()
    finally:
        rerun.set_strict_mode(was_strict)
        stream.disconnect()


def _view_times(moments: Moments, every: float) -> list[float]:
    count = int(moments.duration / every)
    times = {round(number * every, 6) for number in range(count + 1)}
    times |= {each.time for each in moments.sightings}
    return sorted(times | {moments.duration})


def _library() -> Any:
    require_extra("rerun", "rerun", purpose="recordings for Rerun")
    import rerun

    return rerun


def _blueprint_of(episode: RecordedEpisode) -> Any:
    """Return how the viewer lays a recording out."""
    import rerun.blueprint as layout
    from rerun import TimeRangeBoundary, VisibleTimeRange

    past = VisibleTimeRange(
        TIMELINE,
        start=TimeRangeBoundary.infinite(),
        end=TimeRangeBoundary.cursor_relative(seconds=0.0),
    )
    return layout.Blueprint(
        layout.Horizontal(
            layout.Spatial3DView(
                origin="world",
                name=f"{episode.site.title}",
                overrides={"world/walk": layout.VisibleTimeRanges(past)},
            ),
            layout.Vertical(
                layout.Spatial2DView(origin=CAMERA, name="Camera"),
                layout.TextDocumentView(origin="about", name="Episode"),
                layout.TextDocumentView(origin="step", name="Current step"),
                layout.TextLogView(origin="log", name="Calls and speech"),
                row_shares=[3, 2, 1, 2],
            ),
            column_shares=[3, 2],
        ),
        collapse_panels=True,
    )


def _log_building(stream: Any, episode: RecordedEpisode, moments: Moments) -> None:
    """Log what does not move: plan, the way described, the whole walk, things."""
    import rerun as rr

    site, route = episode.site, episode.route
    stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for entity, (kinds, colour, radius) in PLAN.items():
        shapes = [each for each in plan_shapes(site) if each.kind in kinds]
        lines = [line for shape in shapes for line in shape.outlines()]
        _lines(stream, f"world/plan/{entity}", lines, colour, radius)
    _names(stream, site)
    way = np.array(route.line.coords)[:, :2]
    color = ImageColor.getrgb(route_color(route.route))
    _lines(stream, "world/way_described", [way], color, 0.08)
    goal = [*way[-1].tolist(), ON_FLOOR]
    stream.log(
        "world/goal",
        rr.Points3D([goal], radii=0.4, colors=[color], labels=[f"goal: {route.goal}"]),
        static=True,
    )
    _lines(stream, "world/whole_walk", [moments.points], (150, 150, 150), 0.02)
    focal = PICTURE_SIZE[0] / 2
    stream.log(
        CAMERA,
        rr.Pinhole(
            resolution=PICTURE_SIZE,
            focal_length=focal,
            camera_xyz=rr.ViewCoordinates.FLU,
            image_plane_distance=1.0,
        ),
        rr.Transform3D(translation=[0.0, 0.0, CAMERA_HEIGHT]),
        static=True,
    )
    stream.log(
        "world/robot/body",
        rr.Cylinders3D(
            lengths=[0.9],
            radii=[ROBOT_RADIUS],
            centers=[[0.0, 0.0, 0.45]],
            colors=[WALK],
        ),
        static=True,
    )
    _things(stream, episode, moments)


def _log_moving(stream: Any, episode: RecordedEpisode, moments: Moments) -> None:
    """Log poses, people, what the agent did and said, and what it detected."""
    import rerun as rr

    before = None
    for time, x, y, heading in episode.story.walk.poses:
        stream.set_time(TIMELINE, duration=time)
        stream.log(
            "world/robot",
            rr.Transform3D(
                translation=[x, y, 0.0],
                rotation=rr.RotationAxisAngle([0, 0, 1], radians=heading),
            ),
        )
        here = [x, y, 2 * ON_FLOOR]
        strip = [here if before is None else before, here]
        stream.log("world/walk", rr.LineStrips3D([strip], colors=[WALK], radii=0.07))
        before = here
    for name, walk in moments.story.people.items():
        for time, x, y in walk.T.tolist():
            stream.set_time(TIMELINE, duration=time)
            person = rr.Cylinders3D(
                lengths=[1.7], radii=[0.25], centers=[[x, y, 0.85]], colors=[PEOPLE]
            )
            stream.log(f"world/people/{name}", person)
    for event in episode.story.events:
        stream.set_time(TIMELINE, duration=event.time)
        stream.log("log", rr.TextLog(event.text, level=LEVELS.get(event.kind, "TRACE")))
    shown = None
    for time in sorted({event.time for event in episode.story.events}):
        step = moments.at(time).step
        if step != shown:
            shown = step
            stream.set_time(TIMELINE, duration=time)
            text = "\n\n".join([step.heading, *step.lines])
            stream.log("step", rr.TextDocument(text))
    _log_boxes(stream, moments)


def _log_view(
    stream: Any, moment: Moment, scan: NDArray[np.float64], eyes: Eyes | None
) -> None:
    """Log what LiDAR and camera, if there is one, measured at a moment."""
    import rerun as rr

    stream.set_time(TIMELINE, duration=moment.time)
    stream.log("world/robot/lidar", rr.Points3D(scan, radii=0.04, colors=[SCAN]))
    if eyes is None:
        return
    frame = eyes.frame(moment)
    colours = _file(Image.fromarray(frame.rgb), "JPEG", quality=85)
    stream.log(
        f"{CAMERA}/image", rr.EncodedImage(contents=colours, media_type="image/jpeg")
    )
    # 0 is "not measured"; what is farther than 65 m does not fit 16 bits.
    far = np.where(np.isfinite(frame.depth), frame.depth * MILLIMETRES, 0.0)
    depth = np.where(far < 2**16, far, 0.0).astype(np.uint16)
    stream.log(
        f"{CAMERA}/depth",
        rr.EncodedDepthImage(
            blob=_file(Image.fromarray(depth), "PNG"),
            media_type="image/png",
            meter=MILLIMETRES,
        ),
    )


def _log_boxes(stream: Any, moments: Moments) -> None:
    import rerun as rr

    times = sorted({each.time for each in moments.sightings})
    for time in times:
        found = [each for each in moments.sightings if each.time == time]
        corners = np.array([each.box for each in found])
        stream.set_time(TIMELINE, duration=time)
        stream.log(
            f"{CAMERA}/detections",
            rr.Boxes2D(
                array=corners,
                array_format=rr.Box2DFormat.XYXY,
                labels=[each.label for each in found],
            ),
        )
        # A box fits only the picture that it was found in.
        stream.set_time(TIMELINE, duration=math.nextafter(time, math.inf) + 0.5)
        stream.log(f"{CAMERA}/detections", rr.Clear(recursive=False))


def _lines(
    stream: Any,
    entity: str,
    lines: list[NDArray[np.float64]],
    colour: tuple[int, ...],
    radius: float,
) -> None:
    import rerun as rr

    strips = [
        np.column_stack([line[:, :2], np.full(len(line), ON_FLOOR)]) for line in lines
    ]
    stream.log(
        entity,
        rr.LineStrips3D(strips, colors=[colour], radii=radius),
        static=True,
    )


def _names(stream: Any, site: Site) -> None:
    import rerun as rr

    named = [
        (each.polygon.representative_point(), each.name)
        for each in (*site.rooms, *site.areas, *site.corridors)
        if each.name
    ]
    if named:
        places = [(at.x, at.y, ON_FLOOR) for at, _ in named]
        labels = [name for _, name in named]
        stream.log(
            "world/plan/names",
            rr.Points3D(places, labels=labels, radii=0.05, colors=[WALL]),
            static=True,
        )


def _things(stream: Any, episode: RecordedEpisode, moments: Moments) -> None:
    import rerun as rr

    for entry in episode.story.entries:
        if entry["kind"] == "things" and entry["things"]:
            poses = [moments.things[each["object_id"]] for each in entry["things"]]
            sizes = [each["size"] for each in entry["things"]]
            stream.log(
                "world/things",
                rr.Boxes3D(
                    centers=[
                        [pose.x, pose.y, size[2] / 2]
                        for pose, size in zip(poses, sizes, strict=True)
                    ],
                    sizes=[[depth, length, high] for length, depth, high in sizes],
                    rotation_axis_angles=[
                        rr.RotationAxisAngle([0, 0, 1], radians=pose.heading)
                        for pose in poses
                    ],
                    colors=[THINGS],
                    labels=[each["category"] for each in entry["things"]],
                ),
                static=True,
            )


def _file(picture: Image.Image, kind: str, **options: Any) -> bytes:
    content = io.BytesIO()
    picture.save(content, kind, **options)
    return content.getvalue()
