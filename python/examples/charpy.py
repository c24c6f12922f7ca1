#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Charpy impact tests over the temperature: what a notched specimen takes up when a hammer breaks it or bends it through.

Steel that is cold yields later and tears earlier. By which laws is made up here, in steel_at(); where all of the specimen passes between the
anvils unbroken, its energy follows from geometry. docs/charpy.md of the project has the test as a program of its own, with pendulum and friction.

    charpy.py [PICTURE.png]
"""
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import bullet_elastic_plastic as ep

LENGTH, HEIGHT, WIDTH, NOTCH = 0.055, 0.010, 0.010, 0.002  # of the specimen [m]
GAP = 0.040  # between the anvils [m]
HINGE = NOTCH + (HEIGHT - NOTCH) / 2  # from the face at the anvils to the middle of the ligament [m]
YOUNGS_MODULUS, DENSITY = 200e9, 7800
HAMMER_MASS, HAMMER_SPEED = 19.5, 5.5  # [kg], [m/s]
UNIT = 1000  # Bullet computes in millimetres here: its margins and tolerances are for bodies of size 1 and more


def steel_at(temperature):
	"""Yield stress [Pa] and the plastic turn that tears the ligament [rad], at a temperature [degrees Celsius]."""
	return 400e6 * (1 + 0.5 * math.exp(-(temperature + 120) / 60)), 0.05 + 1.5 * (1 + math.tanh((temperature + 20) / 30))


def plastic_moment(yield_stress):
	return yield_stress * WIDTH * (HEIGHT - NOTCH) ** 2 / 4


def stiffness():
	return YOUNGS_MODULUS * WIDTH * (HEIGHT - NOTCH) ** 3 / 12 / (LENGTH / 2)


def passing_energy(yield_stress):
	"""Plastic work of a specimen that is bent until it fits between the anvils [J]: docs/charpy.md derives it."""
	turn = 2 * math.acos(GAP / 2 / math.hypot(LENGTH / 2, HINGE)) + 2 * math.atan(HINGE / (LENGTH / 2))
	moment = plastic_moment(yield_stress)
	return moment * (turn - moment / stiffness())


def scaled(*lengths):
	return [UNIT * length for length in lengths]


def prism(outline, height):
	"""A hull of points x, z, that is as high as this along y."""
	return scaled(*(value for x, z in outline for y in (-height / 2, height / 2) for value in (x, y, z)))


def test(yield_stress, turn):
	"""The blow goes along x, the specimen lies along z, its notch at x = 0."""
	half = LENGTH / 2
	relief = 0.040 * math.tan(math.radians(11))
	wedge = 0.005 / math.tan(math.radians(15))
	hammer = [(0, -0.002), (0, 0.002), (-wedge, 0.007), (-0.2, 0.007), (-0.2, -0.007), (-wedge, -0.007)]
	anvil = [(0, GAP / 2), (0, GAP / 2 + 0.04), (0.04, GAP / 2 + 0.04), (0.04, GAP / 2 + relief)]
	area = WIDTH * (HEIGHT - NOTCH)
	along = {"stiffness": YOUNGS_MODULUS * area / half}
	across = {"stiffness": YOUNGS_MODULUS / 2.6 * area / half}
	rigid = {"stiffness": UNIT**2 * stiffness()}
	bending = {"stiffness": UNIT**2 * stiffness(), "yield": UNIT**2 * plastic_moment(yield_stress), "ductility": turn}
	pieces = [{"name": name, "box": scaled(HEIGHT, WIDTH, half), "mass": DENSITY * HEIGHT * WIDTH * half, "friction": 0,
			   "at": scaled(-HEIGHT / 2, 0, side * half / 2)} for name, side in (("left", -1), ("right", 1))]
	anvils = [{"name": f"anvil {side}", "hull": prism([(x, side * z) for x, z in anvil], 0.1), "motion": "static", "friction": 0}
			  for side in (-1, 1)]
	return {
		"version": 1,
		"world": {"gravity": [0, 0, 0], "step": 1e-4, "error": 0.001},
		"bodies": [*pieces, *anvils, {
			"name": "hammer", "hull": prism(hammer, 0.1), "mass": HAMMER_MASS, "friction": 0, "at": scaled(-HEIGHT - 0.001, 0, 0),
			"velocity": scaled(HAMMER_SPEED, 0, 0)}],
		"joints": [{"name": "ligament", "from": "left", "to": "right", "at": scaled(-HINGE, 0, 0), "along": [0, 0, 1], "up": [1, 0, 0],
					"capacity": {"axial": along, "shear_y": across, "shear_z": across, "torsion": rigid, "bending_y": rigid,
								 "bending_z": bending}}],
		"probes": [{"name": "work", "of": "ligament", "measure": "plastic_energy"},
				   {"name": "speed", "of": "hammer", "measure": "velocity", "axis": "x"}],
		"end": {"time": 0.02},
	}


def energy_at(temperature):
	"""Plastic work [J], what the hammer has lost [J], and whether the specimen has broken."""
	scene = ep.Scene(test(*steel_at(temperature)))
	scene.run()
	lost = HAMMER_MASS / 2 * (HAMMER_SPEED**2 - (scene.probes["speed"][-1] / UNIT) ** 2)
	return scene.probes["work"][-1] / UNIT**2, lost, scene.num_broken > 0


def main(picture):
	temperatures = np.arange(-100, 101, 12.5)
	results = [energy_at(temperature) for temperature in temperatures]
	for temperature, (work, lost, broken) in zip(temperatures, results):
		print(f"{temperature:6.1f} degrees: {work:6.1f} J, hammer {lost:6.1f} J, {'broken' if broken else 'bent through'}")
	figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
	axes.plot(temperatures, [passing_energy(steel_at(temperature)[0]) for temperature in temperatures], "--", color="grey",
			  label="bent through, by geometry")
	axes.plot(temperatures, [work for work, _, _ in results], "o-", label="plastic work")
	axes.plot(temperatures, [lost for _, lost, _ in results], ".:", label="lost by the hammer")
	axes.set(xlabel="temperature [°C]", ylabel="energy [J]", title="Charpy impact tests", ylim=(0, None))
	axes.legend()
	figure.savefig(picture, dpi=100)


if __name__ == "__main__":
	main(sys.argv[1] if len(sys.argv) > 1 else "charpy.png")
