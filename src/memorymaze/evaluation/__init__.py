"""Runs of agents on instructions: episodes, workers, run folders, and tables.

The way through: `plan_run` (plan.py) -> `run_plan` (driver.py) -> `load_runs` (tables.py)
-> `format_tables` (table_formats.py). One episode alone: `run_episode` (episode.py).
"""
