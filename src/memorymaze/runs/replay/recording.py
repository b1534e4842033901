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

from memorymaze.basics.durable_files import replaced_when_whole
from memorymaze.basics.errors import SettingsError
from memorymaze.basics.extras import require_extra
from memorymaze.basics.robot_size import CAMERA_HEIGHT, ROBOT_RADIUS
from memorymaze.basics.video_file import check_target, progress_bar
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.runs.episodes.in_words import outcome_line, source_line
from memorymaze.runs.episodes.trace_entries import ThingsEntry
from memorymaze.runs.replay.film import ReplaySettings
from memorymaze.runs.replay.senses import PICTURE_SIZE, ReplayEyes, Scans
from memorymaze.runs.story.moments import Moment, Moments
from memorymaze.runs.story.recorded_episode import RecordedEpisode
from memorymaze.world.drawing.shapes import (
    FOUND_COLOR,
    INKS,
    PEOPLE_COLOR,
    THING_COLOR,
    VARIETIES,
    WALK_COLOR,
    plan_shapes,
    route_color,
)
from memorymaze.world.sites import Site

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
            eyes = ReplayEyes(
                scene,
                moments,
                PICTURE_SIZE,
                episode.record.settings.looks,
                smooth=False,
            )
            stack.enter_context(closing(eyes))
        bar = stack.enter_context(progress_bar(len(times), "view", shown=progress))
        log = _Log(stream, episode, moments)
        log.log_building()
        log.log_moving()
        for time in times:
            moment = moments.at(time)
            log.log_view(moment, scans.points(moment), eyes)
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


class _Log:
    """Writes an episode to a stream."""

    def __init__(self, stream: Any, episode: RecordedEpisode, moments: Moments) -> None:
        self._rr = _library()
        self._stream = stream
        self._episode = episode
        self._moments = moments

    def _log(self, entity: str, *what: Any, time: float | None = None) -> None:
        """Log what is there at a time, or always."""
        if time is not None:
            self._stream.set_time(TIMELINE, duration=time)
        self._stream.log(entity, *what, static=time is None)

    def log_building(self) -> None:
        """Log what does not move: plan, the way described, the whole walk, things."""
        rr, site, route = self._rr, self._episode.site, self._episode.route
        self._log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP)
        for entity, (kinds, colour, radius) in PLAN.items():
            shapes = [each for each in plan_shapes(site) if each.kind in kinds]
            lines = [line for shape in shapes for line in shape.outlines()]
            self._log_lines(f"world/plan/{entity}", lines, colour, radius)
        self._log_names(site)
        way = np.array(route.line.coords)[:, :2]
        color = ImageColor.getrgb(route_color(route.route))
        self._log_lines("world/way_described", [way], color, 0.08)
        goal = [*way[-1].tolist(), ON_FLOOR]
        title = f"goal: {route.goal}"
        self._log(
            "world/goal", rr.Points3D([goal], radii=0.4, colors=[color], labels=[title])
        )
        walk = [self._moments.points]
        self._log_lines("world/whole_walk", walk, (150, 150, 150), 0.02)
        self._log(
            CAMERA,
            rr.Pinhole(
                resolution=PICTURE_SIZE,
                focal_length=PICTURE_SIZE[0] / 2,
                camera_xyz=rr.ViewCoordinates.FLU,
                image_plane_distance=1.0,
            ),
            rr.Transform3D(translation=[0.0, 0.0, CAMERA_HEIGHT]),
        )
        self._log(
            "world/robot/body",
            rr.Cylinders3D(
                lengths=[0.9],
                radii=[ROBOT_RADIUS],
                centers=[[0.0, 0.0, 0.45]],
                colors=[WALK],
            ),
        )
        self._log_things()

    def log_moving(self) -> None:
        """Log poses, people, what the agent did and said, and what it detected."""
        rr, story = self._rr, self._episode.story
        before = None
        for time, x, y, heading in story.walk.poses:
            turned = rr.RotationAxisAngle([0, 0, 1], radians=heading)
            pose = rr.Transform3D(translation=[x, y, 0.0], rotation=turned)
            self._log("world/robot", pose, time=time)
            here = [x, y, 2 * ON_FLOOR]
            strip = [here if before is None else before, here]
            walked = rr.LineStrips3D([strip], colors=[WALK], radii=0.07)
            self._log("world/walk", walked, time=time)
            before = here
        for name, walk in story.people.items():
            for time, x, y in walk.T.tolist():
                person = rr.Cylinders3D(
                    lengths=[1.7], radii=[0.25], centers=[[x, y, 0.85]], colors=[PEOPLE]
                )
                self._log(f"world/people/{name}", person, time=time)
        for event in story.events:
            level = LEVELS.get(event.kind, "TRACE")
            self._log("log", rr.TextLog(event.text, level=level), time=event.time)
        shown = None
        for time in sorted({event.time for event in story.events}):
            step = self._moments.at(time).step
            if step != shown:
                shown = step
                text = "\n\n".join([step.heading, *step.lines])
                self._log("step", rr.TextDocument(text), time=time)
        self._log_boxes()

    def log_view(
        self, moment: Moment, scan: NDArray[np.float64], eyes: ReplayEyes | None
    ) -> None:
        """Log what LiDAR and camera, if there is one, measured at a moment."""
        rr, time = self._rr, moment.time
        points = rr.Points3D(scan, radii=0.04, colors=[SCAN])
        self._log("world/robot/lidar", points, time=time)
        if eyes is None:
            return
        frame = eyes.frame(moment)
        file = _file(Image.fromarray(frame.rgb), "JPEG", quality=85)
        colours = rr.EncodedImage(contents=file, media_type="image/jpeg")
        self._log(f"{CAMERA}/image", colours, time=time)
        # 0 is "not measured"; what is farther than 65 m does not fit 16 bits.
        far = np.where(np.isfinite(frame.depth), frame.depth * MILLIMETRES, 0.0)
        depth = np.where(far < 2**16, far, 0.0).astype(np.uint16)
        file = _file(Image.fromarray(depth), "PNG")
        measured = rr.EncodedDepthImage(
            blob=file, media_type="image/png", meter=MILLIMETRES
        )
        self._log(f"{CAMERA}/depth", measured, time=time)

    def _log_boxes(self) -> None:
        rr, sightings = self._rr, self._moments.sightings
        for time in sorted({each.time for each in sightings}):
            found = [each for each in sightings if each.time == time]
            boxes = rr.Boxes2D(
                array=np.array([each.box for each in found]),
                array_format=rr.Box2DFormat.XYXY,
                labels=[each.label for each in found],
            )
            self._log(f"{CAMERA}/detections", boxes, time=time)
            # A box fits only the picture that it was found in.
            after = math.nextafter(time, math.inf) + 0.5
            self._log(f"{CAMERA}/detections", rr.Clear(recursive=False), time=after)

    def _log_lines(
        self,
        entity: str,
        lines: list[NDArray[np.float64]],
        colour: tuple[int, ...],
        radius: float,
    ) -> None:
        strips = [
            np.column_stack([line[:, :2], np.full(len(line), ON_FLOOR)])
            for line in lines
        ]
        self._log(entity, self._rr.LineStrips3D(strips, colors=[colour], radii=radius))

    def _log_names(self, site: Site) -> None:
        named = [
            (each.polygon.representative_point(), each.name)
            for each in (*site.rooms, *site.areas, *site.corridors)
            if each.name
        ]
        if named:
            places = [(at.x, at.y, ON_FLOOR) for at, _ in named]
            labels = [name for _, name in named]
            names = self._rr.Points3D(places, labels=labels, radii=0.05, colors=[WALL])
            self._log("world/plan/names", names)

    def _log_things(self) -> None:
        rr = self._rr
        for entry in self._episode.story.entries:
            if isinstance(entry, ThingsEntry) and entry.things:
                ids = [each.object_id for each in entry.things]
                poses = [self._moments.things[each] for each in ids]
                sizes = [each.size for each in entry.things]
                things = rr.Boxes3D(
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
                    labels=[each.category for each in entry.things],
                )
                self._log("world/things", things)


def _file(picture: Image.Image, kind: str, **options: Any) -> bytes:
    content = io.BytesIO()
    picture.save(content, kind, **options)
    return content.getvalue()
