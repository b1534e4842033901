"""From an episode of a run to the file of its video."""

import math
from collections.abc import Generator
from contextlib import ExitStack, closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.video_file import (
    check_picture,
    check_ranges,
    write_video,
)
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.runs.episodes.in_words import outcome_line, source_line
from memorymaze.runs.replay.page import Page, layout_of
from memorymaze.runs.replay.plan_view import SMOOTHING, PlanView, legend_of
from memorymaze.runs.replay.senses import ReplayEyes, boxes_at, draw_boxes
from memorymaze.runs.story.moments import Moments
from memorymaze.runs.story.recorded_episode import RecordedEpisode
from memorymaze.world.drawing.plan_picture import draw_plan


@dataclass(frozen=True, slots=True)
class ReplaySettings:
    """What a replay looks like."""

    size: tuple[int, int] = (1280, 720)
    """Width and height of the video, pixels, even."""
    fps: float = 10.0
    """Frames per second."""
    speed: float = 2.0
    """Simulated seconds per second of video."""
    camera: bool = True
    """Whether the robot's view is drawn anew beside the plan."""
    smooth: bool = True
    """Whether edges in that view are smoothed, which takes longer."""
    hold: float = 3.0
    """Seconds of video that the outcome stands at the end."""

    def __post_init__(self) -> None:
        """Check every value."""
        check_picture("replay", self.size, smallest=240)
        check_ranges(self, "replay", fps=(1, 120), speed=(0.1, 100), hold=(0, 60))


def film_replay(
    episode: RecordedEpisode,
    path: str | Path,
    settings: ReplaySettings | None = None,
    *,
    progress: bool = False,
) -> int:
    """Write the video of an episode, and return how many frames it has.

    The same episode and settings give the same file on one machine.

    Raises:
        SettingsError: The file cannot be there, or the extra `video` is missing.
        OSError: The file cannot be written to its end.
    """
    settings = settings or ReplaySettings()
    count = len(_times(episode, settings))
    result = episode.result
    with closing(frames_of(episode, settings)) as frames:
        write_video(
            path,
            frames,
            settings.size,
            settings.fps,
            title=f"{result.agent} on {result.episode_id} (simulated)",
            total=count,
            progress=progress,
        )
    return count


def frames_of(
    episode: RecordedEpisode, settings: ReplaySettings
) -> Generator[NDArray[np.uint8]]:
    """Draw a replay frame by frame, at equal steps of simulated time."""
    moments = Moments(episode.story)
    result, site = episode.result, episode.site
    layout = layout_of(settings.size, camera=settings.camera)
    title = f"{result.agent} · {site.title} · {result.route} · simulated"
    label = source_line(result)
    sheet = draw_plan(
        site,
        [episode.route],
        np.vstack([moments.points, np.array(episode.route.line.coords)[:, :2]]),
        (SMOOTHING * layout.plan.width, SMOOTHING * layout.plan.height),
        magnified=SMOOTHING * layout.letter / 15,
    )
    plan = PlanView(sheet, moments, layout.letter)
    marks = legend_of(episode.route, moments)
    times = _times(episode, settings)
    last_time = moments.duration
    with ExitStack() as stack:
        eyes = None
        if layout.camera is not None:
            scene = build_scene(site, episode.record.settings.obstacles)
            size = (layout.camera.width, layout.camera.height)
            eyes = ReplayEyes(
                scene,
                moments,
                size,
                episode.record.settings.looks,
                smooth=settings.smooth,
            )
            stack.enter_context(closing(eyes))
        ending: NDArray[np.uint8] | None = None
        words: Page | None = None
        written: object = None
        for time in times:
            if ending is not None:
                yield ending
                continue
            moment = moments.at(time)
            # Words stay the same for many frames, and take the longest to draw.
            happened = (moment.step, len(moment.events))
            if words is None or happened != written:
                words, written = Page(layout), happened
                words.write_story(episode.instruction, label, moment.step)
                words.write_log(moment.events)
            page = words.copy()
            page.put(plan.picture(moment), layout.plan)
            if eyes is not None and layout.camera is not None:
                seen = eyes.picture(moment)
                found = boxes_at(moments, moment)
                page.put(draw_boxes(seen, found, layout.letter), layout.camera)
            page.write_head(title, f"{time:7.1f} s")
            page.write_legend(marks)
            if time >= last_time:
                page.write_outcome(outcome_line(result), arrived=result.success)
                ending = page.picture()
            yield page.picture()


def _times(episode: RecordedEpisode, settings: ReplaySettings) -> list[float]:
    """Return the simulated time of every frame, seconds; the last one often."""
    duration = episode.story.walk.duration
    step = settings.speed / settings.fps
    whole = math.ceil(duration / step - 1e-9)
    held = 1 + round(settings.hold * settings.fps)
    return [number * step for number in range(whole)] + [duration] * held
