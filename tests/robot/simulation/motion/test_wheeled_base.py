import numpy as np

from memorymaze.robot.simulation.motion.wheeled_base import WheeledBase
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.world.sites import Site


def test_what_nothing_touches_changes_no_motion(scenes: dict[str, Scene]) -> None:
    scene = scenes["corridor"]
    start = scene.site.routes[0].start
    settings = SimulationSettings()
    assert scene.tangible.ngeom < scene.model.ngeom
    whole, tangible = (
        WheeledBase(scene.model, start, settings, np.random.default_rng(3), model)
        for model in (None, (scene.tangible, scene.tangible_geoms))
    )
    rng = np.random.default_rng(5)
    touched: set[int] = set()
    for _ in range(800):
        speed, turn_rate = rng.uniform(0, 1), rng.uniform(-1, 1)
        for base in (whole, tangible):
            base.drive(speed, turn_rate, 5)
        assert whole.pose == tangible.pose
        assert np.array_equal(whole.data.qvel, tangible.data.qvel)
        assert whole.touched_geoms() == tangible.touched_geoms()
        assert whole.touched_places() == tangible.touched_places()
        touched.update(whole.touched_geoms())
    assert {scene.objects[geom].kind for geom in touched} == {"wall"}


def test_things_and_people_are_in_the_model_that_moves_the_robot(
    corridor_site: Site,
) -> None:
    scene = build_scene(corridor_site, ObstacleSettings())
    assert scene.tangible is scene.model
