# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""What docs/python.md shows is run, from its first block to its last."""
import contextlib
import inspect
import io
import os
import pathlib
import re
import tempfile
import unittest

import bullet_elastic_plastic as ep

PROJECT = pathlib.Path(__file__).resolve().parents[2]


class Documentation(unittest.TestCase):
	def test_runs_and_prints_what_it_says(self):
		text = (PROJECT / "docs" / "python.md").read_text()
		blocks = re.findall(r"```python\n(.*?)```(?:\n\nprints\n\n```\n(.*?)```)?", text, re.S)
		self.assertGreater(len(blocks), 4)
		names = {}
		before = os.getcwd()
		with tempfile.TemporaryDirectory() as folder:
			os.symlink(PROJECT / "examples", folder + "/examples")
			os.chdir(folder)
			try:
				for code, printed in blocks:
					output = io.StringIO()
					with contextlib.redirect_stdout(output):
						exec(compile(code, "docs/python.md", "exec"), names)
					if printed:
						self.assertEqual(output.getvalue(), printed)
			finally:
				os.chdir(before)

	def test_is_there_for_all_that_is_public(self):
		for name in ep.__all__:
			thing = getattr(ep, name)
			if inspect.isclass(thing) or inspect.isfunction(thing):
				self.assertTrue(inspect.getdoc(thing), name)


if __name__ == "__main__":
	unittest.main()
