from memorymaze.runs.episodes.seeds import obstacle_generator, seeds_of


def test_the_same_seed_and_episode_give_the_same_numbers() -> None:
    first, second = (seeds_of(3, "a-1").robot.random(4) for _ in range(2))
    assert first.tolist() == second.tolist()


def test_seed_episode_and_purpose_each_give_other_numbers() -> None:
    seeds = seeds_of(3, "a-1")
    drawn = [seeds.robot, seeds.agent, seeds.detector]
    drawn += [seeds_of(4, "a-1").robot, seeds_of(3, "b").robot]
    assert len({generator.random() for generator in drawn}) == 5
    assert len({seeds_of(*each).people for each in [(3, "a-1"), (4, "a-1")]}) == 2


def test_things_and_people_have_numbers_of_their_own() -> None:
    seeds = seeds_of(3, "a-1")
    drawn = [seeds.robot, seeds.agent]
    drawn += [obstacle_generator(3, "a-1"), obstacle_generator(4, "a-1")]
    assert len({generator.random() for generator in drawn}) == 4
    assert obstacle_generator(3, "b").random() == obstacle_generator(3, "b").random()
