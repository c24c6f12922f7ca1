# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""The worked examples against what is known of them, and their pictures."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "examples"))

import charpy
import column_loss
import numpy as np
import pushover


def picture_of(example):
	"""The size of what it draws [bytes]."""
	with tempfile.TemporaryDirectory() as folder:
		file = pathlib.Path(folder, "picture.png")
		example.main(str(file))
		return file.read_bytes()[:4], file.stat().st_size


class Examples(unittest.TestCase):
	def test_pushover_comes_to_the_limit_force(self):
		sway, force, yields = pushover.pushover()
		self.assertEqual(len(yields), 4)
		# A frame that leans bears less by its own weight, and the jack moves: 2 %.
		plateau = force[sway > yields[-1][0]]
		np.testing.assert_allclose(plateau[len(plateau) // 2 :].mean(), pushover.limit_force(), rtol=0.02)
		self.assertLess(force[sway < yields[0][0]].max(), 0.95 * pushover.limit_force())

	def test_columns_that_are_lost(self):
		losses = column_loss.lose_each_column()
		self.assertEqual(len(losses), 3)
		for _, sag, _ in losses.values():
			self.assertLess(sag[-1], -0.01)
		# It is the same from both sides, and a corner that hangs out sags more than what is held from two.
		self.assertAlmostEqual(losses["0-0-0"][1][-1], losses["2-0-0"][1][-1], delta=0.01 * abs(losses["0-0-0"][1][-1]))
		self.assertLess(losses["0-0-0"][1].min(), losses["1-0-0"][1].min())

	def test_charpy_passes_as_geometry_says(self):
		work, lost, is_broken = charpy.energy_at(100)
		self.assertFalse(is_broken)
		self.assertAlmostEqual(work, charpy.passing_energy(charpy.steel_at(100)[0]), delta=0.01 * work)
		self.assertGreater(lost, work)
		# A brittle one takes its moment times its turn, and the elastic energy that breaks free.
		yield_stress, turn = charpy.steel_at(-100)
		work, _, is_broken = charpy.energy_at(-100)
		self.assertTrue(is_broken)
		self.assertAlmostEqual(work, charpy.plastic_moment(yield_stress) * turn, delta=0.01 * work)

	def test_draw_pictures(self):
		for example in (pushover, column_loss, charpy):
			head, size = picture_of(example)
			self.assertEqual(head, b"\x89PNG")
			self.assertGreater(size, 10000)


if __name__ == "__main__":
	unittest.main()
