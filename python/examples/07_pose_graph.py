"""Solves a pose graph, and proves that no other poses fit better."""

import math

import numpy as np
import outrider

rng = np.random.default_rng(3)
graph = outrider.PoseGraph()
count, information = 16, np.diag([100.0, 100.0, 400.0])
for i in range(count):
    graph.add_pose((0.0, 0.0, 0.0))
for i in range(count):
    measured = np.array([1.0, 0.0, 2 * math.pi / count]) + rng.normal(0, [0.1, 0.1, 0.05])
    graph.add_edge(i, (i + 1) % count, measured, information)

solution = graph.optimise()
print(f"{solution.status}: cost {solution.cost:.4f}, no less than {graph.lower_bound(solution.poses):.4f}")
far = graph.covariances(solution.poses)[count // 2]
print(f"the far pose is known to {math.sqrt(far[0, 0]):.3f} m")

# Prints:
# converged: cost 3.8797, no less than 3.8797
# the far pose is known to 0.330 m
