from memorymaze.evaluation.seeds import episode_generators, obstacle_generator


def test_the_same_seed_and_episode_give_the_same_numbers() -> None:
    first, second = (episode_generators(3, "a-1")[0].random(4) for _ in range(2))
    assert first.tolist() == second.tolist()


def test_seed_episode_and_purpose_each_give_other_numbers() -> None:
    robot, agent = episode_generators(3, "a-1")
    other_seed, other_episode = episode_generators(4, "a-1"), episode_generators(3, "b")
    drawn = [robot, agent, other_seed[0], other_episode[0]]
    assert len({generator.random() for generator in drawn}) == 4


def test_things_and_people_have_numbers_of_their_own() -> None:
    robot, agent = episode_generators(3, "a-1")
    drawn = [robot, agent, obstacle_generator(3, "a-1"), obstacle_generator(4, "a-1")]
    assert len({generator.random() for generator in drawn}) == 4
    assert obstacle_generator(3, "b").random() == obstacle_generator(3, "b").random()
