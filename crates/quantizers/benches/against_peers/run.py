#!/usr/bin/env python3
"""Growing neural gases of others and ours, on the same inputs, in one run.

    python3 crates/quantizers/benches/against_peers/run.py [--scirs2] [--folder DIR]

makes a virtual environment with MDP, builds the Rust side (with --scirs2 also scirs2-cluster, which takes a while), writes
the inputs to files, and prints a table: inputs per second of processor time once all units are there, the mean squared
error after all inputs, and both as ratios to ours. All use the values of Fritzke 1995 and growth every `period` inputs.
"""

import argparse
import math
import os
import random
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Features, units, inputs, growth period.
SIZES = [(2, 100, 20_000, 100), (2, 1000, 25_000, 20), (11, 1000, 25_000, 20), (72, 42, 10_000, 100)]
# The last versions that work together: MDP 3.6 uses names that later numpys dropped.
PACKAGES = ["MDP==3.6", "numpy==1.23.5", "setuptools<60"]


def inputs(features, count):
    """Evenly in the unit square, or on a surface of three dimensions that is bent into many, with noise."""
    rng = random.Random(features)
    bends = [[rng.uniform(-2, 2) for _ in range(4)] for _ in range(features)]
    for _ in range(count):
        at = [rng.random() for _ in range(3)]
        if features == 2:
            yield at[:2]
        else:
            yield [
                math.sin(sum(b * a for b, a in zip(bend, at)) + bend[3]) + rng.uniform(-0.05, 0.05)
                for bend in bends
            ]


def python_with_mdp(folder):
    environment = folder / "venv"
    python = environment / "bin" / "python"
    if not python.exists():
        venv.create(environment, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", *PACKAGES], check=True)
    return python


def rust_side(folder, scirs2):
    command = ["cargo", "build", "--release", "--quiet", "--manifest-path", HERE / "rust" / "Cargo.toml"]
    command += ["--target-dir", folder / "target"]
    if scirs2:
        command += ["--features", "scirs2"]
    subprocess.run(command, check=True)
    return folder / "target" / "release" / "against-peers"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scirs2", action="store_true", help="compare with scirs2-cluster as well")
    parser.add_argument("--folder", type=Path, default=Path("target/against_peers"), help="where to work")
    options = parser.parse_args()
    folder = options.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)

    python = python_with_mdp(folder)
    rust = rust_side(folder, options.scirs2)
    learners = {"ours, widest lanes": [rust, "ours"], "ours, plain": [rust, "ours-plain"]}
    learners["MDP 3.6"] = [python, HERE / "learn_with_mdp.py"]
    if options.scirs2:
        learners["scirs2-cluster"] = [rust, "scirs2"]

    print("| features | units | learner | inputs/s | ours is faster by | MSE | MSE / ours |")
    print("| ---: | ---: | --- | ---: | ---: | ---: | ---: |")
    for features, units, count, period in SIZES:
        file = folder / f"{features}.csv"
        with open(file, "w") as out:
            for row in inputs(features, count):
                out.write(",".join(f"{value:.7g}" for value in row) + "\n")
        ours = None
        for name, command in learners.items():
            one_thread = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
            result = subprocess.run(
                [*command, str(file), str(units), str(period)],
                check=True, capture_output=True, text=True, env=one_thread,
            )
            rate, mse, found = (float(word) for word in result.stdout.split())
            if found < units:
                print(f"{name}: {found:.0f} units where {units} were asked for", file=sys.stderr)
            ours = ours or (rate, mse)
            print(
                f"| {features} | {units} | {name} | {rate:,.0f} | {ours[0] / rate:.1f} | {mse:.5g} | {mse / ours[1]:.3f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
