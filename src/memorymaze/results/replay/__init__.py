"""Replays: what an episode of a run looked like, as a video or a Rerun recording."""

from memorymaze.results.replay.recorded_episode import RecordedEpisode, load_episode

__all__ = ["RecordedEpisode", "load_episode"]
