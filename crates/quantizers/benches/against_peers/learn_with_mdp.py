"""FILE UNITS PERIOD -> inputs per second of processor time at the end, mean squared error, units: MDP's growing neural gas."""

import sys
import time

import mdp
import numpy as np

file, units, period = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
inputs = np.loadtxt(file, delimiter=",", ndmin=2)
first, last = np.split(inputs, [len(inputs) * 4 // 5])
# It begins with two inputs, as ours does.
gas = mdp.nodes.GrowingNeuralGasNode(
    start_poss=[inputs[0], inputs[1]], eps_b=0.2, eps_n=0.006, max_age=50, lambda_=period, alpha=0.5, d=0.995, max_nodes=units
)
gas.train(first)
begun = time.process_time()
gas.train(last)
rate = len(last) / (time.process_time() - begun)
gas.stop_training()

prototypes = gas.get_nodes_position()
mse = np.mean([np.min(np.sum((prototypes - row) ** 2, axis=1)) for row in inputs])
print(rate, mse, len(prototypes))
