"""A random walk through the university, as a Gymnasium environment.

Try it: python examples/gymnasium_random.py
"""

import gymnasium


def main() -> None:
    """Walk a hundred random steps and tell how that went."""
    env = gymnasium.make("memorymaze.gym:MemoryMaze/University-v0", max_steps=100)
    observation, info = env.reset(seed=7)
    print(f"{info['episode_id']} (source: {info['instruction_source']}):")
    print(observation["instruction"])
    over, earned = False, 0.0
    env.action_space.seed(7)
    while not over:
        action = 1 + env.action_space.sample() % 3  # never 0, which stops
        observation, reward, terminated, truncated, info = env.step(action)
        over, earned = terminated or truncated, earned + float(reward)
    print(f"reward {earned:.2f}, {info['collisions']} collisions")
    print(f"success {info['success']:.0f}, {info['spd']:.1f} m from the goal")
    env.close()


if __name__ == "__main__":
    main()
