"""Runs: agents on instructions, what is measured of their walks, and what is made of it.

`episodes` has settings, plans and the episode itself; `work` does many, here or on a
cluster, into a folder that survives a kill; `metrics` are pure functions; `story` says
what happened in an episode; `tables`, `report`, `replay` and `films` show it; `submission`
checks a run that somebody sends.

Way in: `episodes.plan.plan_run`, `work.driver.run_plan`.
To read first: `episodes/episode.py`, `episodes/results.py`.
"""
