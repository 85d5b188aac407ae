"""native_costs.py OUT.json: random queries on random grids, with the costs that the library gives; null: no path.

Grids from open to crowded, a hundred queries of one planner on each, start and goal free. The page answers them too
(web/tests/browser/wasm.mjs).
"""
import json
import sys

import numpy as np
import outrider

QUERIES = 100
random = np.random.default_rng(1)
cases = []
for number, planner in enumerate(outrider.path_planners()):
    if not outrider.PathPlanner(planner).guarantee["complete"]:
        continue
    columns, rows = (int(side) for side in random.integers(20, 90, size=2))
    resolution = float(random.uniform(0.02, 1.0))
    blocked = random.random((rows, columns)) < 0.1 + 0.05 * (number % 6)
    free = np.argwhere(~blocked)
    places = [(free[random.integers(len(free), size=QUERIES)][:, ::-1] + 0.5) * resolution for _ in range(2)]
    for model in ("cells", "corners"):
        try:
            ground = outrider.GridMap(blocked, resolution=resolution, model=model)
            costs = outrider.PathPlanner(planner).costs(ground, *places)
        except outrider.BadInput:
            continue  # it does not plan on such ground
        cases.append({"planner": planner, "model": model, "columns": columns, "rows": rows, "resolution": resolution,
                      "cells": blocked.astype(int).ravel().tolist(), "starts": places[0].tolist(),
                      "goals": places[1].tolist(), "costs": [None if np.isnan(cost) else float(cost) for cost in costs]})
with open(sys.argv[1], "w", encoding="utf-8") as out:
    json.dump(cases, out)
