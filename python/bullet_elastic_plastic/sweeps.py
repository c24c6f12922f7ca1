# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Many cases of a scene, each computed by a process of its own: ep-run, which comes with the package."""

from __future__ import annotations

import csv
import importlib
import os
import pathlib
import subprocess
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from ._core import Run, SceneError
from .scene import as_json, as_settings

RUNNER = os.fspath(pathlib.Path(__file__).parent / "bin" / "ep-run")

#: Columns by their titles: numbers, or texts where one is no number.
Table = Dict[str, NDArray[Any]]


def read_table(file: Union[str, os.PathLike[str]]) -> Table:
	"""A table that ep-run has written: cases.csv, probes.csv and others. What is empty is NaN."""
	with open(file, newline="") as stream:
		head, *rows = list(csv.reader(stream)) or [[]]
	table: Table = {}
	for i, title in enumerate(head):
		texts = [row[i] for row in rows]
		try:
			table[title] = np.array([float(text) if text else np.nan for text in texts])
		except ValueError:
			table[title] = np.array(texts)
	return table


def write_parquet(table: Mapping[str, NDArray[Any]], file: Union[str, os.PathLike[str]]) -> None:
	"""Writes a table as an Apache Parquet file. It needs pyarrow, and raises ImportError without it."""
	try:
		arrow, parquet = (importlib.import_module(name) for name in ("pyarrow", "pyarrow.parquet"))
	except ImportError as error:
		raise ImportError("Parquet files need pyarrow (pip install pyarrow); ep-run's tables are CSV") from error
	parquet.write_table(arrow.table(dict(table)), os.fspath(file))


def sweep(scene: Union[str, os.PathLike[str], Mapping[str, object]], over: Optional[Mapping[str, Union[str, Tuple[float, float, int]]]] = None, *,
		  random: int = 0, vary: Optional[Mapping[str, str]] = None, seed: int = 1, settings: Optional[Mapping[str, object]] = None,
		  jobs: int = 0, out: Union[str, os.PathLike[str], None] = None) -> Table:
	"""Computes many cases of a scene and returns what ep-run writes to cases.csv, a line each.

	over: ranges by path, (from, to, count) or "from:to:count": all combinations are computed. random: how many cases are drawn for each,
	and vary by which laws: {"materials.steel.yield_stress": "normal(390e6,25e6)"}. seed: of what is drawn. settings: as Scene
	has them. jobs: cases at the same time; 0: one for each processor. out: a folder for all that each case leaves, in cases/; a sweep
	that was interrupted goes on there. Without it nothing is left.

	Raises SceneError with what ep-run says.
	"""
	if out is None:
		with tempfile.TemporaryDirectory() as temporary:
			return sweep(scene, over, random=random, vary=vary, seed=seed, settings=settings, jobs=jobs, out=temporary)
	folder = pathlib.Path(out)
	if isinstance(scene, Mapping):
		folder.mkdir(parents=True, exist_ok=True)
		file = folder / "described.json"
		# As the scene's own: paths in it are of where Python is.
		file.write_text(Run.parse(as_json(scene), "scene", [], ".").scene_json())
	else:
		file = pathlib.Path(scene)
	command: List[str] = [RUNNER, os.fspath(file), "--out", os.fspath(folder), "--jobs", str(jobs or os.cpu_count() or 1), "--seed", str(seed)]
	for path, spread in (over or {}).items():
		command += ["--sweep", f"{path}={spread if isinstance(spread, str) else ':'.join(repr(_plain(part)) for part in spread)}"]
	for path, law in (vary or {}).items():
		command += ["--vary", f"{path}={law}"]
	if random:
		command += ["--random", str(random)]
	if not over and not vary and not random:
		raise SceneError("a sweep has ranges (over) or laws (vary, with random); for one case there is Scene")
	for path, value in as_settings(settings):
		command += ["--set", f"{path}={value}"]
	ran = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
	if ran.returncode != 0:
		raise SceneError(ran.stderr.strip() or f"ep-run has ended with status {ran.returncode}")
	return read_table(folder / "cases.csv")


def _plain(number: Any) -> Any:
	return number.item() if hasattr(number, "item") else number
