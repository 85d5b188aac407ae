"""Catches a moving target at least cost."""

import numpy as np
import outrider

# A field that costs 1 a second, a swamp in the middle that costs 9, and a target that walks along the top.
costs = np.ones((12, 20), dtype=np.int64)
costs[3:9, 6:14] = 9
target = [(x, 11) for x in range(20)]
problem = outrider.PursuitProblem(costs, threshold=100, start=(10, 0), target=target)

for name in outrider.pursuit_planners():
    plan = outrider.PursuitPlanner(name).plan(problem)
    outrider.check(plan, problem)
    column, row = plan.path[-1]
    print(f"{name}: caught at second {plan.catch_time_s} in ({column}, {row}), cost {plan.cost}, no less than {plan.lower_bound}")

# Prints:
# optimal: caught at second 12 in (12, 11), cost 12, no less than 12
# anytime: caught at second 12 in (12, 11), cost 12, no less than 12
