"""Plans a path around a wall with two planners of the catalogue, and checks both."""

import numpy as np
import outrider

# 60 x 40 cells of 0.1 m; a wall from the top leaves a gap at the bottom.
blocked = np.zeros((40, 60), dtype=np.bool_)
blocked[10:, 30] = True
ground = outrider.GridMap(blocked, resolution=0.1)
start, goal = (0.55, 3.55), (5.55, 3.55)

for name in ["a_star", "theta_star"]:
    plan = outrider.PathPlanner(name).plan(ground, start, goal)
    outrider.check(plan, ground, start, goal)
    print(f"{name}: {plan.cost:.3f} m in {len(plan.waypoints) - 1} legs, no shorter than {plan.lower_bound:.3f} m")

# Prints:
# a_star: 7.388 m in 5 legs, no shorter than 7.388 m
# theta_star: 7.277 m in 3 legs, no shorter than 5.000 m
