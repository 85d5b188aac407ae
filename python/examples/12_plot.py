"""Draws a search into a file."""

import pathlib
import tempfile

import numpy as np
import outrider
from outrider import plot

blocked = np.zeros((40, 60), dtype=np.bool_)
blocked[10:, 30] = True
ground = outrider.GridMap(blocked, resolution=0.1)
plan, trace = outrider.PathPlanner("a_star").trace(ground, (0.55, 3.55), (5.55, 3.55))

axes = plot.search(ground, plan, trace)
with tempfile.TemporaryDirectory() as folder:
    picture = pathlib.Path(folder, "search.png")
    axes.figure.savefig(picture)
    print(f"{len(trace)} expansions, axes {axes.get_xlabel()} and {axes.get_ylabel()}, a picture: {picture.exists()}")

# Prints:
# 776 expansions, axes x [m] and y [m], a picture: True
