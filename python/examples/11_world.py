"""Reads a world, measures clearances of many points at once, and plans on a grid made of it."""

import numpy as np
import outrider

world = outrider.World.load("scenarios/yard/yard.sdf")
(low, high) = world.bounds
print(f"{world.name}: {len(world.solids['name'])} solids in {high[0] - low[0]:.1f} x {high[1] - low[1]:.1f} m")

points = np.random.default_rng(1).uniform(low, high, size=(10_000, 2))
fits = world.clearances(points) >= 0.26
print(f"a robot of 0.26 m has room at {100 * fits.mean():.0f} % of the places")

ground = world.grid(0.26, resolution=0.1)
start, goal = points[fits][0], points[fits][1]
plan = outrider.PathPlanner("theta_star").plan(ground, start, goal)
print(f"from one to the next: {plan.length:.2f} m")

# Prints:
# yard: 47 solids in 20.1 x 14.1 m
# a robot of 0.26 m has room at 68 % of the places
# from one to the next: 9.05 m
