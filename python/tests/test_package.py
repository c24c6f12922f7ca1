# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""What the package does, and what it says to those who use it wrongly."""
import gc
import importlib.util
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import bullet_elastic_plastic as ep

SCENES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "scenes"

# 2 kg without weight: what a load gives it is known.
BOX = {"version": 1, "parameters": {"mass": 2}, "world": {"gravity": [0, 0, 0], "step": 0.01, "substeps": 4},
	   "bodies": [{"name": "box", "box": [1, 1, 1], "mass": "=mass"}],
	   "probes": [{"name": "v", "of": "box", "measure": "velocity", "axis": "x"},
				  {"name": "x", "of": "box", "measure": "position", "axis": "x"}],
	   "end": {"time": 1}}

# A rod of 1 cm^2 and 200 MPa holds two boxes and a heavy one breaks it off.
ROD = {"version": 1, "world": {"step": 0.005},
	   "bodies": [{"name": "top", "box": [1, 1, 1], "motion": "static"}, {"name": "load", "box": [1, 1, 1], "at": [0, -2, 0], "mass": 3000},
				  {"name": "tail", "box": [0.5, 0.5, 0.5], "at": [0, -4, 0], "mass": 1}],
	   "joints": [{"name": "rod", "from": "top", "to": "load", "material": {"yield_stress": 200e6, "ultimate_plastic_strain": 0.02},
				   "section": {"rectangle": [0.01, 0.01]}, "lengths": [1, 1]},
				  {"name": "wire", "from": "load", "to": "tail", "type": "ball", "at": [0, -3, 0]}],
	   "probes": [{"name": "y", "of": "load", "measure": "position"}],
	   "end": {"time": 1}}


class Computing(unittest.TestCase):
	def test_is_what_the_runner_computes(self):
		with tempfile.TemporaryDirectory() as folder:
			scene = ep.Scene(SCENES / "cantilever.json", {"load": 25e3, "end.time": 0.5})
			self.assertEqual(scene.run(), "time")
			scene.write(folder + "/own")
			subprocess.run([sys.executable, "-m", "bullet_elastic_plastic", SCENES / "cantilever.json", "--set", "load=25e3", "--set",
							"end.time=0.5", "--quiet", "--out", folder + "/runner"], check=False, stdout=subprocess.DEVNULL)
			for file in ("summary.json", "probes.csv", "energy.csv", "events.csv", "joints.csv"):
				own, runner = (pathlib.Path(folder, of, file).read_text() for of in ("own", "runner"))
				self.assertEqual(own, runner, file)
			table = ep.read_table(folder + "/own/probes.csv")
			np.testing.assert_allclose(table["end [m]"], scene.probes["end [m]"], rtol=1e-8)
			self.assertEqual(scene.summary()["probes"]["end [m]"]["last"], scene.probes["end [m]"][-1])

	def test_tells_what_a_section_bears(self):
		rod = json.loads(json.dumps(ROD))
		rod["joints"][0]["section"] = {"rectangle": [0.1, 0.2], "fibres": 64}
		joint = ep.Scene(rod).joint("rod")
		for about, depth in (("y", 0.1), ("z", 0.2)):
			axial, moment = joint.strength(about).T
			area = 0.1 * 0.2
			self.assertAlmostEqual(max(axial) / (200e6 * area), 1, 9)
			self.assertAlmostEqual(min(axial) / (200e6 * area), -1, 9)
			# The plastic modulus b d^2 / 4, of lumped fibres.
			self.assertAlmostEqual(max(moment) / (200e6 * area * depth / 4), 1, delta=0.03)
			np.testing.assert_array_equal(joint.strength(about, now=True), joint.strength(about))
		with self.assertRaisesRegex(ValueError, "'x'"):
			joint.strength("x")
		self.assertEqual(ep.Scene(ROD).joint("rod").strength().shape, (0, 2))

	def test_takes_numbers_of_numpy_and_settings_by_path(self):
		scene = ep.Scene({**BOX, "end": {"time": np.float32(0.5)}}, {"mass": np.int64(4), "bodies.box.at": np.array([1, 2, 3])})
		self.assertEqual(scene.body("box").mass, 4)
		np.testing.assert_array_equal(scene.body("box").position, [1, 2, 3])
		self.assertEqual(scene.description["parameters"]["mass"], 4)

	def test_ends_where_it_is_told(self):
		scene = ep.Scene(BOX)
		self.assertIsNone(scene.ending)
		self.assertIsNone(scene.run(until=0.25))
		self.assertAlmostEqual(scene.time, 0.25)
		self.assertEqual(scene.run(), "time")
		self.assertAlmostEqual(scene.time, 1)
		self.assertEqual(scene.run(), "time")
		scene.step(3)
		self.assertAlmostEqual(scene.time, 1.03)
		self.assertEqual(len(scene.times), 104)

	def test_tells_of_bodies_and_joints(self):
		scene = ep.Scene(ROD)
		self.assertEqual(scene.joint("rod").bodies, ("top", "load"))
		self.assertEqual([body.name for body in scene.bodies("t*")], ["top", "tail"])
		scene.run(until=0.05)
		rod, load = scene.joint("rod"), scene.body("load")
		# It flows: force and energy are known from its section.
		self.assertAlmostEqual(rod.force[0], 20e3, delta=20)
		self.assertAlmostEqual(rod.utilisation, 1, delta=1e-3)
		self.assertTrue(rod.has_yielded and not rod.is_broken and not rod.is_cut)
		# Until it first unloads, what flows is told when the load has given it, half a step later.
		half_step = (scene.times[1] - scene.times[0]) / 2
		flowed = 20e3 * rod.plastic_deformation[0]
		self.assertLessEqual(rod.plastic_energy, flowed + 1)
		self.assertGreaterEqual(rod.plastic_energy, flowed - 20e3 * abs(load.velocity[1]) * half_step - 1)
		self.assertLess(load.velocity[1], 0)
		np.testing.assert_allclose(load.rotation, [0, 0, 0, 1], atol=1e-6)
		scene.run()
		self.assertTrue(rod.is_broken)
		self.assertEqual(scene.num_broken, 1)
		self.assertEqual([(event.type, event.name, event.dof) for event in scene.events],
						 [("yield", "rod", "axial"), ("break", "rod", "axial")])
		rod.cut()
		scene.joint("wire").cut()
		self.assertEqual(scene.events[-1].type, "cut")
		load.remove()
		self.assertFalse(load.is_there)
		scene.step()


class Arrays(unittest.TestCase):
	def test_are_views(self):
		scene = ep.Scene(BOX)
		scene.run()
		first, second = scene.probes["v"], scene.probes["v"]
		self.assertTrue(np.shares_memory(first, second))
		self.assertFalse(first.flags.owndata)
		self.assertFalse(np.shares_memory(first, scene.probes["x"]))
		with self.assertRaises(ValueError):
			first[0] = 1
		with self.assertRaises(ValueError):
			first.setflags(write=True)

	def test_outlive_their_scene_and_stay_as_they_are(self):
		views, copies = [], []
		for mass in range(1, 30):
			scene = ep.Scene(BOX, {"mass": mass})
			scene.add_load("box", (6, 0, 0))
			early, before = scene.probes["v"], len(scene.probes["v"])
			scene.run()
			self.assertEqual(len(early), before)
			views += [early, scene.probes["v"], scene.energies["kinetic"]]
			copies += [np.array(view) for view in views[-3:]]
			scene.step(200)
			del scene
		gc.collect()
		for view, copy in zip(views, copies):
			np.testing.assert_array_equal(view, copy)

	def test_are_a_mapping(self):
		scene = ep.Scene(BOX)
		self.assertEqual(list(scene.probes), ["v", "x"])
		self.assertEqual(list(scene.energies), ["kinetic", "elastic", "plastic", "damping", "numerical", "gained"])
		self.assertIn("v", scene.probes)
		self.assertNotIn("w", scene.probes)
		with self.assertRaisesRegex(KeyError, "no probe .*velocity.* is not known; known are v, x"):
			scene.probes["velocity"]


class Loads(unittest.TestCase):
	def test_move_as_newton_says(self):
		scene = ep.Scene(BOX)
		load = scene.add_load("box", (6, 0, 0))
		scene.run(until=0.5)
		load.force = np.array([-6, 0, 0])
		scene.run(until=0.75)
		load.remove()
		scene.run()
		self.assertAlmostEqual(scene.probes["v"][-1], 6 / 2 * 0.25, places=4)

	def test_may_be_functions_of_the_time(self):
		scene = ep.Scene(BOX)
		times = []

		def force(time):
			times.append(time)
			return 6 * time, 0, 0

		scene.add_load("box", force=force)
		scene.run()
		self.assertAlmostEqual(scene.probes["v"][-1], 1.5, places=4)
		self.assertEqual(len(times), 1 + 400)  # once when it is added
		self.assertAlmostEqual(times[-1], 1 - 0.00125, places=6)

	def test_raise_when_the_step_is_whole(self):
		scene = ep.Scene(BOX)

		def force(time):
			if time > 0.5:
				raise ZeroDivisionError("of a function")
			return 6, 0, 0

		load = scene.add_load("box", force)
		with self.assertRaisesRegex(ZeroDivisionError, "of a function"):
			scene.run()
		self.assertAlmostEqual(scene.time, 0.51)
		self.assertEqual(len(scene.times), 52)
		load.force = (0, 0, 0)
		self.assertEqual(scene.run(), "time")

	def test_cannot_change_the_scene_within_a_step(self):
		acts = [lambda scene: scene.step(), lambda scene: scene.body("box").remove(), lambda scene: scene.body("box").push((1, 0, 0)),
				lambda scene: scene.add_load("box"), lambda scene: scene.save_state()]
		for act in acts:
			scene = ep.Scene(BOX)
			inside = []
			scene.add_load("box", lambda time: (act(scene) if inside else inside.append(1)) or (0, 0, 0))
			with self.assertRaisesRegex(ep.SceneError, "not possible within a step, where loads are asked for: do it between steps"):
				scene.step()

	def test_that_are_wrong_are_named(self):
		scene = ep.Scene(BOX)
		with self.assertRaisesRegex(ep.SceneError, 'on is no body: "boxx" is not known; did you mean "box"'):
			scene.add_load("boxx", (1, 0, 0))
		with self.assertRaisesRegex(ep.SceneError, r"the force on 'box' is \(1, 2\); it must be three finite numbers \[N\]"):
			scene.add_load("box", (1, 2))
		load = scene.add_load("box", (1, 0, 0))
		for wrong in (np.nan, (np.inf, 0, 0), "up", None):
			with self.assertRaisesRegex(ep.SceneError, "three finite numbers"):
				load.force = wrong
		self.assertEqual(load.force, (1, 0, 0))
		scene.run()
		self.assertAlmostEqual(scene.probes["v"][-1], 0.5, places=4)


class Listeners(unittest.TestCase):
	def test_hear_and_act(self):
		scene = ep.Scene(ROD)
		heard = []

		def cut(scene, event):
			scene.joint("wire").cut()
			scene.body("tail").push((1, 0, 0))
			heard.append(event.type)

		scene.listen(lambda scene, event: heard.append(event.name), types=["cut"])
		scene.listen(cut, types="yield")
		scene.run()
		self.assertEqual(heard, ["yield", "wire"])
		self.assertTrue(scene.joint("wire").is_cut)
		scene.unlisten(cut)

	def test_stop_a_run(self):
		scene = ep.Scene(ROD)
		scene.listen(lambda scene, event: scene.stop(), types=["break"])
		self.assertIsNone(scene.run())
		self.assertAlmostEqual(scene.time, scene.events[-1].time, delta=scene.step_length)

	def test_that_raise_do_not_spoil_the_scene(self):
		scene = ep.Scene(ROD)
		heard = []

		def fail(scene, event):
			raise LookupError(f"by {event.type}")

		scene.listen(fail)
		scene.listen(lambda scene, event: heard.append(event.type))
		for kind in ("yield", "break"):
			with self.assertRaisesRegex(LookupError, f"by {kind}"):
				scene.run()
		self.assertEqual(heard, ["yield", "break"])
		self.assertEqual(scene.run(), "time")
		self.assertEqual(len(scene.times), 201)

	def test_cannot_step_or_load(self):
		for act in (lambda scene, event: scene.run(), lambda scene, event: scene.load_state(scene.save_state())):
			scene = ep.Scene(ROD)
			scene.listen(act)
			with self.assertRaisesRegex(ep.SceneError, "a listener cannot"):
				scene.run()

	def test_may_drop_the_scene(self):
		holder = {"scene": ep.Scene(ROD)}
		events = []

		def drop(scene, event):
			holder.clear()
			gc.collect()
			events.append(event)

		holder["scene"].listen(drop)
		holder["scene"].run()
		self.assertEqual([event.type for event in events], ["yield", "break"])

	def test_that_are_wrong_are_named(self):
		with self.assertRaisesRegex(ep.SceneError, 'types of events: "yeild" is not known; did you mean "yield"'):
			ep.Scene(ROD).listen(print, types=["yeild"])
		with self.assertRaisesRegex(TypeError, "a listener is a function of a scene and an event, not 3"):
			ep.Scene(ROD).listen(3)


class States(unittest.TestCase):
	def test_go_on_with_the_same_bits(self):
		scene = ep.Scene(SCENES / "column-loss.json", {"column": 0.25, "end.time": 1.2})
		scene.run(until=0.5)
		state = scene.save_state()
		scene.run()
		other = ep.Scene.from_state(state)
		self.assertAlmostEqual(other.time, 0.5)
		other.run()
		np.testing.assert_array_equal(scene.times, other.times)
		for name in scene.probes:
			np.testing.assert_array_equal(scene.probes[name], other.probes[name])
		self.assertEqual(scene.events, other.events)
		self.assertEqual(scene.summary(), other.summary())
		# And back to before the column was removed.
		end, summary = scene.probes["sag [m]"], scene.summary()
		scene.load_state(state)
		self.assertTrue(scene.bodies("house/column-1-0-0/*")[0].is_there)
		scene.run()
		self.assertEqual(scene.summary(), summary)
		np.testing.assert_array_equal(scene.probes["sag [m]"], end)

	def test_keep_what_is_held(self):
		scene = ep.Scene(BOX)
		load, box = scene.add_load("box", (6, 0, 0)), scene.body("box")
		state = scene.save_state()
		scene.run(until=0.5)
		scene.load_state(state)
		np.testing.assert_array_equal(box.velocity, 0)
		self.assertEqual(len(scene.probes["v"]), 1)
		load.force = (12, 0, 0)
		scene.run()
		self.assertAlmostEqual(box.velocity[0], 6, places=4)

	def test_of_others_are_refused(self):
		scene = ep.Scene(BOX)
		state = scene.save_state()
		with self.assertRaisesRegex(ep.SceneError, "the state is of another scene"):
			ep.Scene(ROD).load_state(state)
		for spoilt in (b"", b"nothing", state[: len(state) // 2], state[::-1]):
			with self.assertRaisesRegex(ep.SceneError, "no state that can be read"):
				scene.load_state(spoilt)
		with self.assertRaisesRegex(TypeError, "a state is bytes, as save_state"):
			scene.load_state("text")
		with self.assertRaisesRegex(ep.SceneError, "world.joints"):
			ep.Scene(ROD, {"world.joints": "rigid"}).save_state()
		scene.run()


class Errors(unittest.TestCase):
	def test_have_the_runners_text(self):
		with tempfile.TemporaryDirectory() as folder:
			file = pathlib.Path(folder, "wrong.json")
			file.write_text(json.dumps({**BOX, "wrold": {}, "end": {"time": -1}}, indent=1))
			with self.assertRaises(ep.SceneError) as caught:
				ep.Scene(file)
			runner = subprocess.run([sys.executable, "-m", "bullet_elastic_plastic", file], capture_output=True, text=True, check=False)
			self.assertEqual(str(caught.exception), runner.stderr.strip())
			self.assertIn('"wrold" is not known; did you mean "world"?', str(caught.exception))
			self.assertIn("end.time is -1", str(caught.exception))

	def test_name_what_is_wrong(self):
		for scene, settings, text in ((BOX, {"mas": 3}, '--set mas=3: key "mas" is not known'), (BOX, {"mass": "heavy"}, "heavy"), ({}, None, "version"),
									  (BOX, {"world.step": float("nan")}, "NaN"), ("nowhere.json", None, "nowhere.json.*cannot be read")):
			with self.assertRaisesRegex(ep.SceneError, text):
				ep.Scene(scene, settings)
		with self.assertRaisesRegex(TypeError, "a scene is the name of a file or a dict of what a file says, not int"):
			ep.Scene(3)
		with self.assertRaisesRegex(TypeError, "no object"):
			ep.Scene({**BOX, "title": object()})
		with self.assertRaisesRegex(TypeError, 'such as {"world.step": 0.01}, not'):
			ep.Scene(BOX, ["mass=3"])
		scene = ep.Scene(ROD)
		with self.assertRaisesRegex(ep.SceneError, 'is no joint: "rot" is not known; did you mean "rod"'):
			scene.joint("rot")
		with self.assertRaisesRegex(ep.SceneError, "is like the names of 3 bodies; ask for them by bodies()"):
			scene.body("*")
		with self.assertRaisesRegex(ep.SceneError, r"the velocity of 'load' is 3; it must be three finite numbers \[m/s\]"):
			scene.body("load").push(3)
		with self.assertRaisesRegex(RuntimeError, "/dev/null/x"):
			scene.write("/dev/null/x")

	def test_of_numbers_that_are_too_large(self):
		scene = ep.Scene(ROD)
		for wrong in ((0, 1.1e18, 0), (-1e30, 0, 0), (0, 0, 1e308)):
			for given in (wrong, lambda time, wrong=wrong: wrong):
				for kind in ("force", "moment"):
					with self.assertRaisesRegex(ep.SceneError, rf"the {kind} on 'load' is .*; each number must be from -1e\+18 to 1e\+18 \[N"):
						scene.add_load("load", **{kind: given})
		load = scene.add_load("load", (1e18, 0, 0))
		with self.assertRaisesRegex(ep.SceneError, "the moment on 'load'"):
			load.moment = (1e19, 0, 0)
		load.remove()
		with self.assertRaisesRegex(ep.SceneError, r"the place of the load on 'load' is .* to 1e\+06 \[m\]"):
			scene.add_load("load", (1, 0, 0), at=(1e7, 0, 0))
		with self.assertRaisesRegex(ep.SceneError, r"the velocity of 'load' is .* to 100000 \[m/s\]"):
			scene.body("load").push((0, 1.1e5, 0))
		# A function that grows too large is told of in the step.
		scene.add_load("load", lambda time: (0, 1e20 if time > 0.02 else 0, 0))
		with self.assertRaisesRegex(ep.SceneError, "the force on 'load'"):
			scene.step(10)

	def test_of_numbers_that_are_not_finite(self):
		scene = ep.Scene(BOX)
		load = scene.add_load("box", at=(0, 1e4, 0))
		# More than a load may be: nothing that is allowed leads there.
		load._run.set_load(load._number, (1e308, 0, 0) if ep.PRECISION == "double" else (1e38, 0, 0), (0, 0, 0))
		with self.assertRaisesRegex(ep.SceneError, "the scene cannot go on: since .* not finite"):
			scene.step(100)
		self.assertEqual(scene.ending, "not finite")


class Sweeps(unittest.TestCase):
	def test_make_a_table(self):
		table = ep.sweep({**BOX, "bodies": [{**BOX["bodies"][0], "velocity": ["=mass", 0, 0]}]}, {"mass": (1, 3, 3), "world.substeps": "1:2:2"},
						 jobs=2)
		np.testing.assert_array_equal(table["mass"], [1, 1, 2, 2, 3, 3])
		np.testing.assert_allclose(table["v last"], table["mass"], rtol=1e-6)
		self.assertEqual(set(table["ending"]), {"time"})

	def test_are_written_as_parquet_where_that_is_there(self):
		table = {"load": np.array([1., 2.]), "ending": np.array(["time", "broken"])}
		with tempfile.TemporaryDirectory() as folder:
			file = os.path.join(folder, "cases.parquet")
			if importlib.util.find_spec("pyarrow"):
				ep.write_parquet(table, file)
				import pyarrow.parquet
				self.assertEqual(pyarrow.parquet.read_table(file).to_pydict(), {"load": [1, 2], "ending": ["time", "broken"]})
			else:
				with self.assertRaisesRegex(ImportError, "pip install pyarrow"):
					ep.write_parquet(table, file)

	def test_draw_and_go_on(self):
		with tempfile.TemporaryDirectory() as folder:
			first = ep.sweep(BOX, random=3, vary={"mass": "normal(5,1)"}, seed=7, settings={"end.time": 0.1}, out=folder)
			again = ep.sweep(BOX, random=3, vary={"mass": "normal(5,1)"}, seed=7, settings={"end.time": 0.1}, out=folder)
			np.testing.assert_array_equal(first["mass"], again["mass"])
			self.assertEqual(len(set(first["mass"])), 3)
			self.assertTrue(pathlib.Path(folder, "cases", "case-000003", "probes.csv").exists())

	def test_say_what_is_wrong(self):
		for arguments, text in (({"over": {"mass": (1, 2)}}, "from:to:count"), ({"over": {"mas": (1, 2, 2)}}, "mas"),
								({"vary": {"mass": "normal(1,1)"}}, "belong together"), ({}, "for one case there is Scene"),
								({"over": {"mass": (-1, 1, 2)}}, "bodies.box.mass")):
			with self.assertRaisesRegex(ep.SceneError, text):
				ep.sweep(BOX, **arguments)


class Memory(unittest.TestCase):
	def grown(self, act, times):
		"""Largest memory of the process after many times, over that after some of them [MB]."""
		peaks = []
		for count in (times // 4, times):
			for _ in range(count):
				act()
			peaks.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
		return peaks[1] - peaks[0]

	def test_is_flat_over_many_scenes(self):
		def act():
			scene = ep.Scene(SCENES / "cantilever.json", {"end.time": 0.02})
			scene.add_load("beam/12", lambda time: (0, -time, 0))
			scene.listen(lambda scene, event: None)
			scene.run()
			state = scene.save_state()
			scene.load_state(state)
			ep.Scene.from_state(state).probes["end [m]"]
			try:
				ep.Scene(BOX, {"mas": 1})
			except ep.SceneError:
				pass

		gc.disable()  # nothing is left for it
		try:
			# A scene has 7 MB: if one of the three were kept each time, that would be 300.
			self.assertLess(self.grown(act, 60), 10)
		finally:
			gc.enable()


if __name__ == "__main__":
	unittest.main()
