"""From an episode of a run to a recording for the Rerun viewer (https://rerun.io)."""

import os
import sys
from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from tqdm import tqdm

from memorymaze.errors import SettingsError
from memorymaze.extras import require_extra
from memorymaze.results.replay.eyes import PICTURE_SIZE, Eyes
from memorymaze.results.replay.film import SECONDS_BETWEEN_LINES
from memorymaze.results.replay.moments import Moments
from memorymaze.results.replay.outcome import outcome_line, source_line
from memorymaze.results.replay.recorded_episode import RecordedEpisode
from memorymaze.results.replay.recording_parts import (
    blueprint_of,
    log_building,
    log_moving,
    log_view,
)
from memorymaze.results.replay.scans import Scans
from memorymaze.results.replay.settings import ReplaySettings
from memorymaze.simulation import build_scene

VIEW_EVERY = 1.0
"""Simulated seconds from one camera picture and scan to the next."""


def check_recording_path(path: str | Path) -> Path:
    """Refuse a file that cannot be written, before anything is drawn for it.

    Raises:
        SettingsError: It is no rrd file, there is no folder for it or no leave to
            write, or the package for recordings is missing.
    """
    target = Path(path)
    folder = target.absolute().parent
    if target.suffix.lower() != ".rrd":
        raise SettingsError(f"--rerun: expected a file named *.rrd, got {str(path)!r}")
    if target.is_dir():
        raise SettingsError(f"--rerun: expected a file, got the folder {str(path)!r}")
    if not folder.is_dir():
        raise SettingsError(
            f"--rerun: expected a file in a folder that is there, got {str(path)!r}; "
            f"make {folder} first"
        )
    if not os.access(folder, os.W_OK | os.X_OK):
        raise SettingsError(f"--rerun: expected leave to write to {folder}, got none")
    _library()
    return target


def record_replay(
    episode: RecordedEpisode,
    path: str | Path,
    settings: ReplaySettings | None = None,
    *,
    view_every: float = VIEW_EVERY,
    progress: bool = False,
) -> None:
    """Write the recording of an episode; it is there in full or not at all.

    Args:
        episode: What to show.
        path: An rrd file, which is replaced.
        settings: Whether with what the camera saw counts here.
        view_every: Simulated seconds between camera pictures and scans, > 0; there is
            one more wherever something was detected.
        progress: Whether to show a bar with the time left on stderr.

    Raises:
        SettingsError: The file cannot be there, or the package is missing.
        RenderingError: This machine cannot draw; says what to install.
        RunFolderError: The trace does not fit the run's settings.
        OSError: The file cannot be written.
    """
    if not view_every > 0:
        raise SettingsError(f"view_every: expected more than 0 s, got {view_every!r}")
    settings = settings or ReplaySettings()
    target = check_recording_path(path)
    moments = Moments(episode.entries, episode.story)
    scene = build_scene(episode.site, episode.record.settings.obstacles)
    scans = Scans(scene, moments)
    times = _view_times(moments, view_every)
    with ExitStack() as stack:
        stream = stack.enter_context(_stream_to(target, episode))
        eyes = None
        if settings.camera:
            eyes = stack.enter_context(Eyes(scene, moments, PICTURE_SIZE, smooth=False))
        bar = stack.enter_context(
            tqdm(
                total=len(times),
                unit="view",
                file=sys.stderr,
                disable=not progress,
                mininterval=0.5 if sys.stderr.isatty() else SECONDS_BETWEEN_LINES,
            )
        )
        log_building(stream, episode, moments)
        log_moving(stream, episode, moments)
        for time in times:
            moment = moments.at(time)
            log_view(stream, moment, scans.points(moment), eyes)
            bar.update()


@contextmanager
def _stream_to(target: Path, episode: RecordedEpisode) -> Generator[Any]:
    """Give a recording stream whose file takes its place when it is whole."""
    rerun = _library()
    unfinished = target.with_name(f"{target.name}.{os.getpid()}.unfinished")
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
        # The library itself would only warn of a file that it cannot open.
        unfinished.write_bytes(b"")
        stream.save(unfinished, default_blueprint=blueprint_of(episode))
        stream.log(
            "about",
            rerun.TextDocument(
                f"# {episode.result.agent} on {episode.result.episode_id}\n\n"
                f"{episode.site.title} (simulated). {source_line(episode.result)}:\n\n"
                f"> {episode.instruction}\n\n{outcome_line(episode.result)}",
                media_type="text/markdown",
            ),
            static=True,
        )
        yield stream
        stream.flush()
        stream.disconnect()
        unfinished.replace(target)
    finally:
        rerun.set_strict_mode(was_strict)
        stream.disconnect()
        unfinished.unlink(missing_ok=True)


def _view_times(moments: Moments, every: float) -> list[float]:
    count = int(moments.duration / every)
    times = {round(number * every, 6) for number in range(count + 1)}
    times |= {each.time for each in moments.sightings}
    return sorted(times | {moments.duration})


def _library() -> Any:
    require_extra("rerun", "rerun", purpose="recordings for Rerun")
    import rerun

    return rerun
