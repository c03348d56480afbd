"""Steps a second of `GridVectorEnv`, with random moves and all that Python does with them, by processor time.

    python crates/python/benches/grid_steps.py
"""

import time

import gymnasium
import numpy as np
import tolman.gym  # noqa: F401

COUNT, STEPS = 64, 5000


def steps_a_second(name, **options):
    """Return the number of steps that all robots make in a second, the median of five runs."""
    envs = gymnasium.make_vec(name, num_envs=COUNT, vectorization_mode="vector_entry_point", **options)
    envs.reset(seed=1)
    actions = np.random.default_rng(1).integers(0, 3, (STEPS, COUNT))
    rates = []
    for _ in range(5):
        begun = time.process_time()
        for move in actions:
            envs.step(move)
        rates.append(STEPS * COUNT / (time.process_time() - begun))
    return np.median(rates)


if __name__ == "__main__":
    print(f"| environment | million steps a second, {COUNT} mazes |\n| --- | ---: |")
    for task in ("Errand", "Learn", "Locate"):
        for options in ({}, {"rays": True}, {"width": 16, "height": 16}):
            rate = steps_a_second(f"tolman/{task}-v0", **options)
            said = ", ".join(f"{key}={value}" for key, value in options.items())
            print(f"| {task} {said} | {rate / 1e6:.1f} |", flush=True)
