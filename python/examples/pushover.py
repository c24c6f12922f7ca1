#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Pushover curve of a steel frame: the force that pushes it sideways over how far it goes.

A frame of one storey is described as a dict. A jack pushes it, a load that Python computes before each substep from where the frame is, until
hinges of yield at feet and beam ends have made it a mechanism. Limit analysis tells the force at which that happens.

    pushover.py [PICTURE.png]
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import bullet_elastic_plastic as ep

YIELD_STRESS = 355e6  # [Pa]
HEIGHT, SPAN = 4.0, 6.0  # of a storey from floor to floor, and between axes of columns [m]
WIDTH, DEPTH, WEB, FLANGE = 0.3, 0.3, 0.011, 0.019  # of the I section [m]
JACK, SPEED = 20e6, 0.1  # stiffness [N/m] and speed [m/s] of the jack
FARTHEST = 0.3  # [m]


def frame():
	section = {"i": [WIDTH, DEPTH, WEB, FLANGE]}
	return {
		"version": 1,
		"title": "Pushover",
		"world": {"step": 1 / 240, "error": 0.01, "ramp": 0.2},
		"materials": {"steel": {"yield_stress": YIELD_STRESS}},
		"structures": [{"frame": {
			"name": "frame", "material": "steel", "column": section, "beam": section, "storeys": 1, "storey_height": HEIGHT, "bays_x": 1,
			"bays_z": 0, "bay_x": SPAN, "parts": 6}}],
		"probes": [{"name": "sway", "of": "frame/node-0-1-0", "measure": "displacement", "axis": "x"}],
		"end": {"time": 10},
	}


def limit_force():
	"""Of the mechanism with hinges at both feet and at both ends of the beam, where it meets the columns [N]."""
	flanges = WIDTH * FLANGE * (DEPTH - FLANGE)
	web = WEB * (DEPTH - 2 * FLANGE) ** 2 / 4
	moment = YIELD_STRESS * (flanges + web)
	axis = HEIGHT - DEPTH / 2  # of the beam
	return 2 * moment * (1 + SPAN / (SPAN - DEPTH)) / axis


def pushover():
	"""Sway [m], force [N], and the yields: sway and name of each."""
	scene = ep.Scene(frame())
	pushed = scene.body("frame/node-0-1-0")
	start = pushed.position[0]
	scene.add_load(pushed.name, force=lambda time: (JACK * (SPEED * time - (pushed.position[0] - start)), 0, 0))
	yields = []
	scene.listen(lambda scene, event: yields.append((scene.probes["sway"][-1], event.name)), types=["yield"])
	while scene.ending is None and scene.probes["sway"][-1] < FARTHEST:
		scene.step()
	sway = scene.probes["sway"]
	return sway, JACK * (SPEED * scene.times - sway), yields


def main(picture):
	sway, force, yields = pushover()
	print(f"limit analysis: {limit_force() / 1e3:.0f} kN; at a sway of {sway[-1]:.2f} m the frame bears {force[-1] / 1e3:.0f} kN")
	figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
	axes.plot(sway, force / 1e3)
	axes.axhline(limit_force() / 1e3, color="grey", linestyle="--", label="limit analysis")
	for at, name in yields:
		print(f"{name} yields at {at:.3f} m")
		axes.axvline(at, color="tab:orange", linewidth=0.8)
	axes.axvline(at, color="tab:orange", linewidth=0.8, label="a joint yields")
	axes.set(xlabel="sway [m]", ylabel="force [kN]", title="Pushover of a steel frame", ylim=(0, None), xlim=(0, None))
	axes.legend()
	figure.savefig(picture, dpi=100)


if __name__ == "__main__":
	main(sys.argv[1] if len(sys.argv) > 1 else "pushover.png")
