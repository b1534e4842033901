"""Replays: what an episode of a run looked like, as a video or a Rerun recording."""
