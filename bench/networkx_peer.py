"""Shortest paths along the eight moves of a grid: the planners called from Python, and networkx on the graph of the moves.

    PYTHONPATH=build/python python3 bench/networkx_peer.py [--json]

Ends with 77 where networkx is not installed, and with 1 if the lengths differ.
"""

import json
import math
import statistics
import sys
import time

import numpy as np
import outrider

try:
    import networkx
except ImportError:
    sys.exit(77)

SIDE, BLOCKS, QUERIES, ROUNDS = 128, 60, 20, 3
TASK = f"shortest paths on {SIDE} x {SIDE} cells with blocks, called from Python"


def blocks():
    rng = np.random.default_rng(1)
    blocked = np.zeros((SIDE, SIDE), np.bool_)
    for _ in range(BLOCKS):
        (x, y), (w, h) = rng.integers(SIDE, size=2), rng.integers(1, 24, size=2)
        blocked[y:y + h, x:x + w] = True
    return blocked


def graph_of(blocked):
    """Vertices are free cells (x, y); a diagonal move needs both cells beside it."""
    graph = networkx.Graph()
    free = {(int(x), int(y)) for y, x in np.argwhere(~blocked)}
    for x, y in free:
        for dx, dy in ((1, 0), (0, 1), (1, 1), (-1, 1)):
            if {(x + dx, y), (x, y + dy), (x + dx, y + dy)} <= free:
                graph.add_edge((x, y), (x + dx, y + dy), weight=math.hypot(dx, dy))
    return graph


def octile(a, b):
    dx, dy = abs(a[0] - b[0]), abs(a[1] - b[1])
    return max(dx, dy) + (math.sqrt(2.0) - 1.0) * min(dx, dy)


def length(graph, path):
    return sum(graph.edges[pair]["weight"] for pair in zip(path, path[1:]))


def measure(solver, queries, solve):
    """The row of a solver, and the lengths of its paths."""
    spent, lengths = [math.inf] * len(queries), [0.0] * len(queries)
    for _ in range(ROUNDS):
        for i, (start, goal) in enumerate(queries):
            begin = time.perf_counter_ns()
            answer = solve(start, goal)
            spent[i] = min(spent[i], (time.perf_counter_ns() - begin) / 1000)
            lengths[i] = answer()
    return {"task": TASK, "solver": solver, "answered": f"{len(queries)} of {len(queries)}",
            "median us": round(statistics.median(spent), 2), "mean us": round(statistics.mean(spent), 2)}, lengths


def main():
    blocked = blocks()
    graph, ground = graph_of(blocked), outrider.GridMap(blocked)
    cells = sorted(max(networkx.connected_components(graph), key=len))
    rng = np.random.default_rng(2)
    queries = [tuple(cells[k] for k in rng.integers(len(cells), size=2)) for _ in range(QUERIES)]
    measured = []
    for name in ("dijkstra", "a_star", "jps", "octile_labels"):
        planner = outrider.PathPlanner(name)

        def plan(start, goal, planner=planner):
            found = planner.plan(ground, (start[0] + 0.5, start[1] + 0.5), (goal[0] + 0.5, goal[1] + 0.5))
            return lambda: found.cost

        plan(*queries[0])
        measured.append(measure(name, queries, plan))
    for name, search in (("dijkstra_path", networkx.dijkstra_path),
                         ("astar_path", lambda *a: networkx.astar_path(*a, heuristic=octile))):
        def find(start, goal, search=search):
            path = search(graph, start, goal)
            return lambda: length(graph, path)

        measured.append(measure(f"networkx {networkx.__version__}, {name}", queries, find))
    least = min(row["mean us"] for row, _ in measured)
    for row, _ in measured:
        row["times as long"] = round(row["mean us"] / least, 1)
    rows = [row for row, _ in measured]
    if "--json" in sys.argv[1:]:
        print(json.dumps({"rows": rows}))
    else:
        print(*(json.dumps(row) for row in rows), sep="\n")
    same = all(math.isclose(a, b, rel_tol=1e-9) for _, lengths in measured for a, b in zip(lengths, measured[0][1]))
    if not same:
        print("the lengths differ", file=sys.stderr)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
