"""`memorymaze replay`: what an episode of a run looked like, as a video."""

import argparse
import re
from pathlib import Path

from memorymaze.front.cli.verbs import Verbs, file_stem, given_path


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "replay",
        help="make a video of an episode of a run",
        description="Make a video of an episode from its trace: what the robot saw "
        "beside the plan, with the instruction, the current step and the calls; or a "
        "recording for the Rerun viewer.",
        epilog="example: memorymaze replay runs/guide onl-university-r1-01-1 "
        "--speed 4 --out walk.mp4",
    )
    parser.add_argument(
        "run_folder", metavar="RUN", type=given_path, help="a run folder"
    )
    parser.add_argument(
        "episode", metavar="EPISODE", help="id of an episode, as episodes.jsonl has it"
    )
    parser.add_argument(
        "--out",
        metavar="FILE",
        help="video (default: RUN/replays/EPISODE.mp4); needs the extra [video]",
    )
    parser.add_argument(
        "--rerun",
        metavar="FILE.rrd",
        nargs="?",
        const="",
        help="write a recording for the Rerun viewer (default: "
        "RUN/replays/EPISODE.rrd) instead of a video, or beside the one that --out "
        "names; needs the extra [rerun]",
    )
    parser.add_argument(
        "--speed",
        type=float,
        default=2.0,
        metavar="X",
        help="simulated seconds per second of video (2)",
    )
    parser.add_argument(
        "--fps", type=float, default=10.0, metavar="N", help="frames a second (10)"
    )
    parser.add_argument(
        "--size",
        type=picture_size,
        default=(1280, 720),
        metavar="WxH",
        help="pixels (1280x720)",
    )
    parser.add_argument(
        "--no-camera",
        action="store_true",
        help="leave out what the robot saw, which takes most of the time",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.basics.video_file import check_video_path, require_encoder
    from memorymaze.runs.replay.film import ReplaySettings, film_replay
    from memorymaze.runs.replay.recording import check_recording_path, record_replay
    from memorymaze.runs.story import load_episode

    settings = ReplaySettings(
        size=options.size,
        fps=options.fps,
        speed=options.speed,
        camera=not options.no_camera,
    )
    name = file_stem(options.episode)
    folder = options.run_folder / "replays"
    recording = options.rerun
    if recording == "":
        recording = str(folder / f"{name}.rrd")
    video = options.out
    if video is None and recording is None:
        video = str(folder / f"{name}.mp4")
    if video is not None:
        require_encoder()
    episode = load_episode(options.run_folder, options.episode)
    if any(
        file is not None and Path(file).parent == folder for file in (video, recording)
    ):
        folder.mkdir(exist_ok=True)
    if video is not None:
        check_video_path(video)
    if recording is not None:
        check_recording_path(recording)
    if recording is not None:
        record_replay(episode, recording, settings, progress=True)
        print(recording)
    if video is not None:
        count = film_replay(episode, video, settings, progress=True)
        print(f"{video}: {count / settings.fps:.0f} s, {count} frames")


def picture_size(text: str) -> tuple[int, int]:
    """Read an option such as `1280x720`."""
    found = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    if found is None:
        raise argparse.ArgumentTypeError(f"expected WIDTHxHEIGHT, got {text!r}")
    return int(found[1]), int(found[2])
