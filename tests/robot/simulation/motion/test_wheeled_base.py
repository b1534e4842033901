import numpy as np

from memorymaze.basics.geometry.points import XY
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
            base.update_view()
        assert whole.pose == tangible.pose
        assert np.array_equal(whole.data.qvel, tangible.data.qvel)
        assert whole.touched_geoms() == tangible.touched_geoms()
        assert whole.touched_places() == tangible.touched_places()
        touched.update(whole.touched_geoms())
    assert {scene.objects[geom].kind for geom in touched} == {"wall"}


def test_a_robot_that_has_room_moves_as_among_walls(scenes: dict[str, Scene]) -> None:
    scene = scenes["corridor"]
    start = scene.site.routes[0].start
    settings = SimulationSettings()
    asked: list[float] = []

    def room(place: XY) -> float:
        asked.append(scene.touchables.room(place))
        return asked[-1]

    assert scene.open_floor is not None
    tangible = scene.tangible, scene.tangible_geoms
    among_walls, in_the_open = (
        WheeledBase(
            scene.model, start, settings, np.random.default_rng(3), tangible, open_floor
        )
        for open_floor in (None, (scene.open_floor, room))
    )
    rng = np.random.default_rng(5)
    touches = 0
    for _ in range(80):
        # Now against a wall, now back to the middle of the corridor.
        speed, turn_rate = rng.uniform(-1, 1), rng.uniform(-1, 1)
        for _ in range(20):
            for base in (among_walls, in_the_open):
                base.drive(speed, turn_rate, 5)
                base.update_view()
            assert among_walls.pose == in_the_open.pose
            assert np.array_equal(among_walls.data.qvel, in_the_open.data.qvel)
            assert among_walls.touched_geoms() == in_the_open.touched_geoms()
            assert among_walls.touched_places() == in_the_open.touched_places()
            touches += bool(among_walls.touched_geoms())
    assert touches > 20
    assert min(asked) < 0.01
    assert max(asked) > 0.5


def test_things_and_people_are_in_the_model_that_moves_the_robot(
    corridor_site: Site,
) -> None:
    scene = build_scene(corridor_site, ObstacleSettings())
    assert scene.tangible is scene.model
    assert scene.open_floor is None
