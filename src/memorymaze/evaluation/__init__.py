"""Running agents over corpora: settings, episodes, workers, run folders.

The way through: `plan_run` (plan) -> `run_plan` (driver) -> `run_episode` (episode) ->
`EpisodeResult` (results) -> a run folder (run_folder). Which agents there are is in
`agent_catalogue`; every agent gets a robot through `guarded_robot`. Does not hold what is
made of finished runs (`results`), nor any way of drawing.
"""
