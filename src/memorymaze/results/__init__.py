"""What is made of finished runs: tables, comparisons, reports, replays, leaderboards.

`tables` has the figures, `story` what happened in an episode, which `report` and `replay`
show; `instruction_study` is about texts alone. Nothing is run in here, and
no figure is measured that a run folder does not hold.
"""
