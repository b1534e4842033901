"""An episode and its run: settings, plans, what is handed to agents, what is measured.

The way through: `plan_run` (plan) -> `run_episode` (episode) -> `EpisodeResult` (results);
`work` does many of them. Which agents there are is in `agent_catalogue`; every agent gets
a robot through `guarded_robot`. Does not hold what is made of finished runs, nor any way
of drawing.
"""
