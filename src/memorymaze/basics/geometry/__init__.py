"""Poses, polylines, trajectories, and shortest walks over a floor, in metres and radians.

Plain arithmetic on plain numbers and polygons: no files, no sites, no robot.
"""
