"""Plans a thousand paths in one call, which leaves the interpreter to other threads."""

import numpy as np
import outrider

rng = np.random.default_rng(1)
blocked = rng.random((200, 200)) < 0.2
free = np.argwhere(~blocked)[:, ::-1] + 0.5  # centres of the free cells as x, y
starts, goals = (free[rng.integers(len(free), size=1000)] for _ in range(2))

planner = outrider.PathPlanner("jps")
costs = planner.costs(outrider.GridMap(blocked), starts, goals)
print(planner.guarantee["sentence"])
print(f"{np.isnan(costs).sum()} have no path; the others cost {np.nanmean(costs):.1f} m on average")

# Prints:
# complete; shortest along the eight moves of the grid
# 5 have no path; the others cost 117.0 m on average
