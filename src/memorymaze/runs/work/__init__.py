"""Doing many episodes: workers here and on a cluster, and the folder of a run.

`driver` does a plan; a trace is kept before its result, so a kill loses nothing. Does not
hold what an episode is (`episodes`).
"""
