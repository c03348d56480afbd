"""Graduated non-convexity (truncated least squares) of GTSAM on a g2o file: python gnc.py FILE FIRST_FALSE SIGMA_SCALE

Edges from number FIRST_FALSE on are false. Odometry is known to be right. Writes seconds, false closures kept, right closures dropped.
"""
import sys
import time

import gtsam
import numpy as np

path, first_false, scale = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
edges = []
for line in open(path):
    words = line.split()
    if words[0] == "EDGE_SE2":
        a, b, c, d, e, f = (float(word) / scale**2 for word in words[6:12])
        information = np.array([[a, b, c], [b, d, e], [c, e, f]])
        edges.append((int(words[1]), int(words[2]), gtsam.Pose2(*map(float, words[3:6])), information))
steps = {edge[0]: edge for edge in edges if edge[1] == edge[0] + 1}
graph, initial, known = gtsam.NonlinearFactorGraph(), gtsam.Values(), []
at, pose = min(steps), gtsam.Pose2()
initial.insert(at, pose)
first = at
while at in steps:
    pose = pose.compose(steps[at][2])
    at += 1
    initial.insert(at, pose)
for number, (i, j, measured, information) in enumerate(edges):
    graph.add(gtsam.BetweenFactorPose2(i, j, measured, gtsam.noiseModel.Gaussian.Information(information)))
    if j == i + 1:
        known.append(number)
graph.add(gtsam.PriorFactorPose2(first, gtsam.Pose2(), gtsam.noiseModel.Isotropic.Sigma(3, 1e-3)))
known.append(len(edges))
parameters = gtsam.GncLMParams()
parameters.setLossType(gtsam.GncLossType.TLS)
parameters.setKnownInliers(known)
start = time.perf_counter()
optimizer = gtsam.GncLMOptimizer(graph, initial, parameters)
optimizer.setInlierCostThresholdsAtProbability(0.99)
optimizer.optimize()
seconds = time.perf_counter() - start
kept = np.array(optimizer.getWeights())[: len(edges)] > 0.5
closures = np.array([j != i + 1 for i, j, _, _ in edges])
false = np.arange(len(edges)) >= first_false
print(seconds, int((kept & false).sum()), int((~kept & closures & ~false).sum()))
