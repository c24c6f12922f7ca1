#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Which column may a building lose? And how thick must columns and beams be?

The building of examples/scenes/column-loss.json comes to rest once. From that state each column of its front is taken away in turn.
Then a sweep computes the loss that the file describes for several thicknesses, each case in a process of its own.

    column_loss.py [PICTURE.png]
"""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bullet_elastic_plastic as ep

SCENE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "scenes" / "column-loss.json"


def lose_each_column(thickness=0.3, rest=1.0, end=2.5):
	"""For each column of the front on the ground: times, sag of the node above it [m], joints broken."""
	above = {f"{x}-0-0": f"house/node-{x}-1-0" for x in range(3)}
	scene = ep.Scene(SCENE, {
		"column": thickness, "end.time": end, "events": [], "expect": [],
		"probes": [{"name": column, "of": node, "measure": "displacement", "axis": "y"} for column, node in above.items()]})
	scene.run(until=rest)
	at_rest = scene.save_state()
	losses = {}
	for column in above:
		scene.load_state(at_rest)
		for part in scene.bodies(f"house/column-{column}/*"):
			part.remove()
		scene.run()
		losses[column] = scene.times, scene.probes[column], scene.num_broken
	return losses


def sag_over_thickness():
	"""Of the loss in the file: a table with a line for each thickness."""
	return ep.sweep(SCENE, {"column": (0.2, 0.5, 7)}, settings={"end.time": 2.5})


def main(picture):
	figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
	for column, (times, sag, broken) in lose_each_column().items():
		left.plot(times, sag, "--" if column == "2-0-0" else "-", label=f"{column}: {broken} joints broken")
		print(f"without column {column}: sag {-1000 * sag[-1]:.0f} mm, {broken} joints broken")
	left.set(xlabel="time [s]", ylabel="node above the column [m]", title="Columns and beams of 0.3 m: the loss of a column")
	left.legend(fontsize="small")
	table = sag_over_thickness()
	right.plot(table["column"], -table["sag [m] least"], marker="o")
	right.set(xlabel="thickness [m]", ylabel="most sag [m]", yscale="log", title="The loss of column 1-0-0")
	figure.savefig(picture, dpi=100)


if __name__ == "__main__":
	main(sys.argv[1] if len(sys.argv) > 1 else "column-loss.png")
