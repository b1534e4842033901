from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles.surroundings import Closeness


def _gaps(crowded, person_of, site, gaps: list[float]) -> Closeness:
    """Let the gap between robot and person take these values, one after the other."""
    robot = crowded(site)
    person = person_of(robot, 10, 0)
    closeness = Closeness(robot.surroundings.crowd)
    for number, gap in enumerate(gaps):
        x = person.x - person.radius - 0.25 - gap
        closeness.update(float(number), Pose(x, 0, 0))
    return closeness


def test_staying_close_is_one_near_miss(wide, crowded, person_of):
    closeness = _gaps(crowded, person_of, wide, [0.5, 0.29, 0.1, 0.2, 0.5])

    [miss] = closeness.near_misses
    assert miss.time == 1.0
    assert abs(miss.gap - 0.1) < 1e-9
    assert miss.person == "person-0"


def test_swaying_at_the_limit_counts_once(wide, crowded, person_of):
    gaps = [0.29, 0.31, 0.29, 0.35, 0.28]

    assert len(_gaps(crowded, person_of, wide, gaps).near_misses) == 1


def test_coming_back_counts_again(wide, crowded, person_of):
    assert len(_gaps(crowded, person_of, wide, [0.2, 0.45, 0.2]).near_misses) == 2


def test_passing_at_a_distance_is_no_near_miss(wide, crowded, person_of):
    assert _gaps(crowded, person_of, wide, [0.6, 0.31, 0.6]).near_misses == []
