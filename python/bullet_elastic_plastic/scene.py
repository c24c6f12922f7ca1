# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Scenes that are computed step by step."""

from __future__ import annotations

import json
import os
from typing import (Any, Callable, Dict, Generic, Iterable, Iterator, List, Mapping, NamedTuple, NoReturn, Optional, Sequence, Tuple,
					TypeVar, Union, overload)

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import SceneError

Vector = NDArray[np.float64]

#: Three numbers, or a function that gives them for a time [s].
VectorOverTime = Union[Sequence[float], Vector, Callable[[float], ArrayLike]]

EVENT_TYPES = ("yield", "break", "crack", "rupture", "remove", "cut", "push")
NUM_ENERGIES = 6  # the last columns of a run


class Event(NamedTuple):
	"""What has happened in a scene."""

	time: float  #: [s]
	type: str  #: "yield" or "break" of a joint, "crack" or "rupture" of a fibre of its section; what the scene or you have done: "remove" or "push" a body, "cut" a joint
	name: str  #: of the body or joint
	dof: Optional[str]  #: degree of freedom that decides in the joint, as "axial"; of other events None
	energy: float  #: that the joint has dissipated [J]
	place: Tuple[float, float, float]  #: [m]
	part: Optional[int] = None  #: of the section, that has cracked or ruptured: 0 is the section itself, then its bars in their order


Listener = Callable[["Scene", Event], None]
Value = TypeVar("Value")
Part = TypeVar("Part", bound="Thing")


def as_json(value: object) -> str:
	"""A value as scene files have it; arrays and numbers of NumPy become lists and numbers."""

	def plain(unknown: Any) -> Any:
		if hasattr(unknown, "tolist"):
			return unknown.tolist()
		if isinstance(unknown, os.PathLike):
			return os.fspath(unknown)
		raise TypeError(f"a scene holds numbers, texts, lists and dicts, and no {type(unknown).__name__}")

	return json.dumps(value, default=plain)


def as_settings(settings: Optional[Mapping[str, object]]) -> List[Tuple[str, str]]:
	if settings is None:
		return []
	if not isinstance(settings, Mapping):
		raise TypeError(f'settings are a dict of paths and values, such as {{"world.step": 0.01}}, not {settings!r}')
	return [(str(path), as_json(value)) for path, value in settings.items()]


# What single precision bears; places and velocities as in scene files.
MOST_LOAD, MOST_PLACE, MOST_VELOCITY = 1e18, 1e6, 1e5


def as_vector(value: ArrayLike, what: str, unit: str, most: float) -> Tuple[float, float, float]:
	try:
		vector = np.asarray(value, dtype=float)
	except (TypeError, ValueError):
		vector = np.empty(0)
	if vector.shape != (3,) or not np.isfinite(vector).all():
		raise SceneError(f"{what} is {value!r}; it must be three finite numbers [{unit}]")
	if np.abs(vector).max() > most:
		raise SceneError(f"{what} is {value!r}; each number must be from {-most:g} to {most:g} [{unit}]")
	return float(vector[0]), float(vector[1]), float(vector[2])


class Readings(Mapping[str, Vector]):
	"""Numbers over time by name: one at the beginning and one after each step.

	Arrays are views of what the scene has read so far, not copies, and cannot be written to. They stay as they are when the scene goes
	on, or is gone: ask again for those that are longer.
	"""

	def __init__(self, run: _core.Run, first: int, names: Sequence[str], what: str) -> None:
		self._run, self._what = run, what
		self._columns = {name: first + i for i, name in enumerate(names)}

	def __getitem__(self, name: str) -> Vector:
		if name not in self._columns:
			raise KeyError(f"there is no {self._what} {_core.unknown_name(str(name), list(self._columns))}")
		return self._run.column(self._columns[name])

	def __iter__(self) -> Iterator[str]:
		return iter(self._columns)

	def __len__(self) -> int:
		return len(self._columns)

	def __repr__(self) -> str:
		return f"<{self._what}s: {', '.join(self)}>"


def as_array(value: Any) -> Vector:
	return np.array(value)


def as_pair(value: Any) -> Tuple[str, str]:
	first, second = value
	return first, second


class Reading(Generic[Value]):
	"""What a body or joint tells of itself now, under the name of the attribute."""

	def __init__(self, read: Callable[[Any], Value], text: str) -> None:
		self._read, self.__doc__ = read, text

	def __set_name__(self, owner: type, name: str) -> None:
		self._name = name

	@overload
	def __get__(self, thing: None, owner: type) -> Reading[Value]: ...
	@overload
	def __get__(self, thing: Thing, owner: type) -> Value: ...

	def __get__(self, thing: Optional[Thing], owner: type) -> Union[Reading[Value], Value]:
		return self if thing is None else self._read(thing._now()[self._name])

	def __set__(self, thing: Thing, value: NoReturn) -> None:
		raise AttributeError(f"{self._name} of {thing!r} is read only")


class Thing:
	"""Something of a scene that has a name."""

	def __init__(self, run: _core.Run, index: int, name: str) -> None:
		self._run, self._index, self._name = run, index, name

	@property
	def name(self) -> str:
		return self._name

	def _now(self) -> Dict[str, Any]:
		raise NotImplementedError

	def __repr__(self) -> str:
		return f"<{type(self).__name__.lower()} {self._name!r}>"


class Body(Thing):
	"""A body of a scene, as it is now. Made by Scene.body()."""

	is_there = Reading(bool, "In the world: it has appeared, and was not removed.")
	mass = Reading(float, "[kg]; 0 of what is not moved by forces.")
	position = Reading(as_array, 'Where the scene\'s file has it with "at" [m].')
	rotation = Reading(as_array, "A quaternion: x, y, z, w, as SciPy has it.")
	velocity = Reading(as_array, "Of its centre of mass [m/s].")
	spin = Reading(as_array, "[rad/s]")

	def _now(self) -> Dict[str, Any]:
		return self._run.body(self._index)

	def remove(self) -> None:
		"""Takes it out of the world with its joints."""
		self._run.remove_body(self._index)

	def push(self, velocity: ArrayLike) -> None:
		"""Gives it a velocity [m/s]."""
		self._run.push_body(self._index, as_vector(velocity, f"the velocity of {self._name!r}", "m/s", MOST_VELOCITY))


class Joint(Thing):
	"""A joint of a scene, as it is now. Made by Scene.joint().

	Arrays have a number for each degree of freedom: axial, shear_y, shear_z [N or m], torsion, bending_y, bending_z [N m or rad], in the
	joint's frame. Of Bullet's own joints only names and breaks are known.
	"""

	bodies = Reading(as_pair, 'Names of what it joins; one may be "world".')
	is_broken = Reading(bool, "Torn, by what it bore.")
	is_cut = Reading(bool, "Taken out by the scene or by you.")
	has_yielded = Reading(bool, "In some degree of freedom, at some time.")
	utilisation = Reading(float, "Load over yield value, the most of all degrees of freedom.")
	damage = Reading(float, "Share of its ductility that is spent.")
	elastic_energy = Reading(float, "[J]")
	plastic_energy = Reading(float, "[J]")
	damping_energy = Reading(float, "Taken up by the material's damping [J].")
	force = Reading(as_array, "Forces [N] and moments [N m].")
	deformation = Reading(as_array, "Elastic and plastic [m], [rad].")
	plastic_deformation = Reading(as_array, "[m], [rad]")

	def _now(self) -> Dict[str, Any]:
		return self._run.joint(self._index)

	def strength(self, about: str = "y", now: bool = False) -> NDArray[np.float64]:
		"""What a section with fibres bears of axial force and of one moment together: the corners of a convex line, a row (N, M) each [N], [N m].

		It closes from the last corner to the first. With now=True it is what is left: without fibres that have gone, and without the tension of
		those that have cracked. Empty of a joint without fibres. Raises ValueError if the moment is about neither "y" nor "z".
		"""
		if about not in ("y", "z"):
			raise ValueError(f'a section bends about "y" or "z", not about {about!r}')
		return self._run.strength(self._index, about == "z", now)

	def cut(self) -> None:
		"""Takes it out of the world."""
		self._run.cut_joint(self._index)


class LoadVector:
	"""A part of a load: three numbers, or a function of the time [s] that gives them."""

	def __init__(self, unit: str) -> None:
		self._unit = unit
		self.__doc__ = f"[{unit}]: three numbers, or a function of the time that gives them."

	def __set_name__(self, owner: type, name: str) -> None:
		self._name, self._slot = name, "_" + name

	@overload
	def __get__(self, load: None, owner: type) -> LoadVector: ...
	@overload
	def __get__(self, load: Load, owner: type) -> VectorOverTime: ...

	def __get__(self, load: Optional[Load], owner: type) -> Union[LoadVector, VectorOverTime]:
		return self if load is None else self.given(load)

	def __set__(self, load: Load, value: VectorOverTime) -> None:
		before = self.given(load)
		setattr(load, self._slot, value)
		try:
			load.update(load._run.time())
		except BaseException:
			setattr(load, self._slot, before)
			raise

	def given(self, load: Load) -> VectorOverTime:
		value: VectorOverTime = getattr(load, self._slot)
		return value

	def at(self, load: Load, time: float) -> Tuple[float, float, float]:
		value = self.given(load)
		return as_vector(value(time) if callable(value) else value, f"the {self._name} on {load._on!r}", self._unit, MOST_LOAD)


class Load:
	"""A force and a moment on bodies of a scene, which may change at any time. Made by Scene.add_load()."""

	force = LoadVector("N")
	moment = LoadVector("N m")

	def __init__(self, run: _core.Run, on: str, force: VectorOverTime, moment: VectorOverTime, at: ArrayLike, turns_along: bool) -> None:
		self._run, self._on = run, on
		self._force, self._moment = force, moment
		values = self._values(run.time())
		self._number = run.add_load(on, as_vector(at, f"the place of the load on {on!r}", "m", MOST_PLACE), turns_along)
		run.set_load(self._number, *values)

	@property
	def varies(self) -> bool:
		"""With the time."""
		return callable(self._force) or callable(self._moment)

	def remove(self) -> None:
		"""Its bodies bear it no longer."""
		self._force = self._moment = (0, 0, 0)
		self._run.remove_load(self._number)

	def update(self, time: float) -> None:
		"""Takes the values of a time [s]; the scene does this before each substep."""
		self._run.set_load(self._number, *self._values(time))

	def _values(self, time: float) -> Tuple[Tuple[float, float, float], Tuple[float, float, float]]:
		return Load.force.at(self, time), Load.moment.at(self, time)

	def __repr__(self) -> str:
		return f"<load on {self._on!r}>"


class Scene:
	"""A scene that is computed step by step.

	scene: the name of a scene's file, or what such a file says as a dict. settings: values by path that are put in place of what the
	scene says, as --set of ep-run does: {"load": 25e3, "world.step": 0.005}. folder: from which a dict includes files.

	Raises SceneError with all that is wrong, a line each.
	"""

	def __init__(self, scene: Union[str, os.PathLike[str], Mapping[str, object]], settings: Optional[Mapping[str, object]] = None, *,
				 folder: Union[str, os.PathLike[str]] = ".") -> None:
		if isinstance(scene, (str, os.PathLike)):
			run = _core.Run.read(os.fspath(scene), as_settings(settings))
		elif isinstance(scene, Mapping):
			run = _core.Run.parse(as_json(scene), "scene", as_settings(settings), os.fspath(folder))
		else:
			raise TypeError(f"a scene is the name of a file or a dict of what a file says, not {type(scene).__name__}")
		self._begin(run)

	def _begin(self, run: _core.Run) -> None:
		self._run = run
		titles = run.column_titles()
		self._probes = Readings(run, 1, titles[1:-NUM_ENERGIES], "probe")
		self._energies = Readings(run, len(titles) - NUM_ENERGIES, [title[:-2] for title in titles[-NUM_ENERGIES:]], "energy")
		self._loads: List[Load] = []
		self._listeners: List[Tuple[Listener, Tuple[str, ...]]] = []
		self._told = run.num_events()
		self._is_telling = self._is_stopped = False

	@classmethod
	def from_state(cls, state: bytes) -> Scene:
		"""A scene that goes on from what save_state() gave. Added loads and listeners are not in it."""
		scene = cls.__new__(cls)
		scene._begin(_core.Run.parse(_core.Run.scene_of(state), "state", [], "."))
		scene.load_state(state)
		return scene

	# ---- what it is

	@property
	def description(self) -> Dict[str, Any]:
		"""What the scene says, with what it includes and with the settings."""
		described: Dict[str, Any] = json.loads(self._run.scene_json())
		return described

	@property
	def step_length(self) -> float:
		"""[s]"""
		return self._run.step_length()

	@property
	def body_names(self) -> List[str]:
		return self._run.body_names()

	@property
	def joint_names(self) -> List[str]:
		return self._run.joint_names()

	def body(self, name: str) -> Body:
		"""A body by its name. Raises SceneError with the nearest name if there is none."""
		return self._one(self.bodies(name), name, "bodies")

	def joint(self, name: str) -> Joint:
		"""A joint by its name. Raises SceneError with the nearest name if there is none."""
		return self._one(self.joints(name), name, "joints")

	def bodies(self, pattern: str = "*") -> List[Body]:
		"""Those whose names are like a pattern, in which * stands for any letters."""
		names = self._run.body_names()
		return [Body(self._run, i, names[i]) for i in self._run.bodies_like(f'"{pattern}"', pattern)]

	def joints(self, pattern: str = "*") -> List[Joint]:
		"""Those whose names are like a pattern, in which * stands for any letters."""
		names = self._run.joint_names()
		return [Joint(self._run, i, names[i]) for i in self._run.joints_like(f'"{pattern}"', pattern)]

	@staticmethod
	def _one(found: List[Part], name: str, what: str) -> Part:
		if len(found) != 1:
			raise SceneError(f"{name!r} is like the names of {len(found)} {what}; ask for them by {what}()")
		return found[0]

	# ---- computing

	@property
	def time(self) -> float:
		"""[s]"""
		return self._run.time()

	@property
	def ending(self) -> Optional[str]:
		""""time", "standstill", "first break" or "not finite", by which the scene has ended; None, if it has not."""
		ending = self._run.ending()
		return None if ending == "none" else ending

	def step(self, count: int = 1) -> None:
		"""Steps the scene, also beyond its end; then listeners are told.

		What a listener or a function of a load raises, is raised when the step is whole and all listeners have been told.
		"""
		if self._is_telling:
			raise SceneError("a listener cannot step the scene that tells it: it goes on when the listener returns")
		for _ in range(count):
			try:
				self._run.step(self._update_loads if any(load.varies for load in self._loads) else None)
			finally:
				self._tell()

	def run(self, until: Optional[float] = None) -> Optional[str]:
		"""Steps the scene until its end, a time [s], or stop(), whatever comes first. Returns the ending."""
		self._is_stopped = False
		while self.ending is None and not self._is_stopped:
			if until is not None and self.time + self.step_length / 2 > until:
				break
			self.step()
		return self.ending

	def stop(self) -> None:
		"""run() returns after this step: for listeners."""
		self._is_stopped = True

	# ---- what comes of it

	@property
	def times(self) -> Vector:
		"""Of what probes and energies have read [s]."""
		return self._run.column(0)

	@property
	def probes(self) -> Readings:
		"""What the scene's probes have read: scene.probes["sag [m]"]."""
		return self._probes

	@property
	def energies(self) -> Readings:
		"""kinetic; elastic, plastic, damping and numerical of joints; gained, the sum of what steps have made from nothing [J]."""
		return self._energies

	@property
	def events(self) -> List[Event]:
		"""All so far."""
		return [Event(*self._run.event(i)) for i in range(self._run.num_events())]

	@property
	def num_broken(self) -> int:
		"""Joints that have broken; those that were cut do not count."""
		return self._run.num_broken()

	def summary(self) -> Dict[str, Any]:
		"""What ep-run writes to summary.json; "not_as_expected" lists what the scene expects and does not find."""
		summary: Dict[str, Any] = json.loads(self._run.summary_json())
		return summary

	def write(self, folder: Union[str, os.PathLike[str]]) -> None:
		"""Writes the files that ep-run writes: summary.json, probes.csv, energy.csv, events.csv and joints.csv."""
		self._run.write(os.fspath(folder))

	# ---- what you do to it

	def add_load(self, on: str, force: VectorOverTime = (0, 0, 0), moment: VectorOverTime = (0, 0, 0), *, at: ArrayLike = (0, 0, 0),
				 turns_along: bool = False) -> Load:
		"""A load on a body, or on each that is like a pattern.

		force [N] and moment [N m] are three numbers, or functions of the time [s], which are asked before each substep. at: where on
		the body, in its own axes [m]. turns_along: force and moment are in the body's own axes.
		"""
		load = Load(self._run, on, force, moment, at, turns_along)
		self._loads.append(load)
		return load

	def _update_loads(self, time: float) -> None:
		for load in self._loads:
			if load.varies:
				load.update(time)

	def listen(self, listener: Listener, types: Iterable[str] = EVENT_TYPES) -> Listener:
		"""Has a function called with the scene and the event, after each step in which there was one. Returns the function.

		A listener may do anything to the scene but step it or load a state. It is given the scene: one that holds it by itself keeps it in memory
		until Python's collector comes by.
		"""
		chosen = (types,) if isinstance(types, str) else tuple(types)
		for one in chosen:
			if one not in EVENT_TYPES:
				raise SceneError(f"types of events: {_core.unknown_name(str(one), EVENT_TYPES)}")
		if not callable(listener):
			raise TypeError(f"a listener is a function of a scene and an event, not {listener!r}")
		self._listeners.append((listener, chosen))
		return listener

	def unlisten(self, listener: Listener) -> None:
		"""Does not call it any more."""
		self._listeners = [known for known in self._listeners if known[0] != listener]

	def _tell(self) -> None:
		first: Optional[Exception] = None
		end = self._run.num_events()  # what listeners do is told after the next step
		self._is_telling = True
		try:
			while self._told < end:
				event = Event(*self._run.event(self._told))
				self._told += 1
				for listener, types in self._listeners:
					if event.type in types:
						try:
							listener(self, event)
						except Exception as error:
							first = first or error
		finally:
			self._is_telling = False
		if first is not None:
			raise first

	def save_state(self) -> bytes:
		"""The scene, its state and what probes have read: to go back to, or to go on elsewhere, with the same bits."""
		return self._run.save()

	def load_state(self, state: bytes) -> None:
		"""Goes back or forward to a state of this scene. Loads, listeners, bodies and joints that you hold stay what they are.

		Raises SceneError, and nothing changes, if it is a state of another scene.
		"""
		if self._is_telling:
			raise SceneError("a listener cannot load a state into the scene that tells it: do it between steps")
		if not isinstance(state, bytes):
			raise TypeError(f"a state is bytes, as save_state() gives them, not {type(state).__name__}")
		self._run.restore(state)
		self._told = self._run.num_events()

	def __repr__(self) -> str:
		return f"<scene at {self.time:.6g} s, {len(self.body_names)} bodies, {len(self.joint_names)} joints>"
