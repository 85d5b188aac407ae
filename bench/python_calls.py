"""The price of a call from Python over a query: at most 5 us one by one, and 0.2 us in arrays.

    PYTHONPATH=build/python python3 bench/python_calls.py build/bench/call_bench
"""

import subprocess
import sys
import time

import numpy as np
import outrider

QUERIES, ROUNDS = 20_000, 15


def best_ns(work):
    """The least time of a query over some rounds."""
    spent = []
    for _ in range(ROUNDS):
        begin = time.perf_counter_ns()
        work()
        spent.append((time.perf_counter_ns() - begin) / QUERIES)
    return min(spent)


def main():
    cpp = float(subprocess.run(sys.argv[1:], check=True, capture_output=True, text=True).stdout)
    ground, planner = outrider.GridMap(np.zeros((16, 16), np.bool_)), outrider.PathPlanner("jps")
    starts, goals = np.tile((0.5, 0.5), (QUERIES, 1)), np.tile((3.5, 0.5), (QUERIES, 1))
    start, goal = (0.5, 0.5), (3.5, 0.5)
    single = best_ns(lambda: [planner.plan(ground, start, goal) for _ in range(QUERIES)])
    arrays = best_ns(lambda: planner.costs(ground, starts, goals))
    print(f"a query of jps: {cpp / 1000:.2f} us from C++; from Python one by one {(single - cpp) / 1000:+.2f} us "
          f"(at most 5), in arrays {(arrays - cpp) / 1000:+.3f} us (at most 0.2)")
    return 0 if single - cpp <= 5000 and arrays - cpp <= 200 else 1


if __name__ == "__main__":
    sys.exit(main())
