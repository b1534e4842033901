"""Poses, polylines, trajectories and shortest walks on a floor; no files, no sites."""
