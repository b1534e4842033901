"""What stands where in a recording: entities, their times, and how they are laid out."""

import io
import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from shapely import get_coordinates

from memorymaze.results.replay.eyes import PICTURE_SIZE, Eyes
from memorymaze.results.replay.moments import Moment, Moments
from memorymaze.results.replay.recorded_episode import RecordedEpisode
from memorymaze.simulation.motion.wheeled_base import CAMERA_HEIGHT, ROBOT_RADIUS

if TYPE_CHECKING:
    from memorymaze.sites import Site

TIMELINE = "simulated_time"
CAMERA = "world/robot/camera"
WALL, ROUTE, WALK = (47, 47, 47), (215, 48, 31), (17, 17, 17)
PEOPLE, THINGS, SCAN = (11, 114, 133), (194, 24, 91), (122, 79, 181)
ON_FLOOR = 0.02
"""Metres over the floor at which lines lie."""
LEVELS = {"say": "INFO", "touch": "ERROR", "note": "DEBUG", "model": "DEBUG"}
MILLIMETRES = 1000.0


def blueprint_of(episode: RecordedEpisode) -> Any:
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


def log_building(stream: Any, episode: RecordedEpisode, moments: Moments) -> None:
    """Log what does not move: plan, the way described, the whole walk, things."""
    import rerun as rr

    site, route = episode.site, episode.route
    stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    floor = site.walkable_floor
    rings = [get_coordinates(ring) for ring in (floor.exterior, *floor.interiors)]
    _lines(stream, "world/plan/walls", rings, WALL, 0.06)
    doors = [get_coordinates(door.line) for door in site.doors]
    _lines(stream, "world/plan/doors", doors, (156, 90, 30), 0.05)
    _lines(
        stream,
        "world/plan/landmarks",
        [get_coordinates(each.footprint) for each in site.landmarks],
        (76, 140, 74),
        0.03,
    )
    _names(stream, site)
    way = np.array(route.line.coords)[:, :2]
    _lines(stream, "world/way_described", [way], ROUTE, 0.08)
    goal = [*way[-1].tolist(), ON_FLOOR]
    stream.log(
        "world/goal",
        rr.Points3D([goal], radii=0.4, colors=[ROUTE], labels=[f"goal: {route.goal}"]),
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


def log_moving(stream: Any, episode: RecordedEpisode, moments: Moments) -> None:
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
    for name, walk in moments.walks_of_people.items():
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


def log_view(
    stream: Any, moment: Moment, scan: NDArray[np.float64], eyes: Eyes | None
) -> None:
    """Log what the sensors measured at a moment.

    Args:
        stream: Of the recording.
        moment: Of the episode.
        scan: Points in the robot's frame, metres, (N, 3).
        eyes: The camera; None to leave it out.
    """
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
    colour: tuple[int, int, int],
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


def _names(stream: Any, site: "Site") -> None:
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

    for entry in episode.entries:
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
