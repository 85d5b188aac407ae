"""Runs a scenario with another seed, and reads its log as arrays."""

import outrider

run = outrider.run("scenarios/yard/yard.yaml", seed=2)
print(f"{run.job}: {run.status}, {run.metrics['reached']:.0f} of {run.metrics['targets']:.0f} targets")

shots = run.log["shots"]
print(f"{len(shots)} shots, the first after {shots['time_ns'][0] / 1e9:.1f} s")

try:
    outrider.run("scenarios/yard/yard.yaml", set={"robot.radius": -1})
except outrider.BadInput as refusal:
    print(refusal)

# Prints:
# guard: done, 23 of 24 targets
# 23 shots, the first after 1.4 s
# robot.radius: '-1' is not valid; expected a number from 0 to 100 m
