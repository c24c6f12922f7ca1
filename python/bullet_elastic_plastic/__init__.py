# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Structures that bend before they break: scenes of Bullet Elastic-Plastic, computed step by step.

    import bullet_elastic_plastic as ep

    scene = ep.Scene("examples/scenes/cantilever.json", {"load": 25e3})
    scene.run()
    print(scene.probes["end [m]"][-1])

Scene files are described in docs/scenes.md of the project, this package in docs/python.md.
"""

from ._core import PRECISION, SceneError
from .scene import Body, Event, Joint, Load, Readings, Scene
from .sweeps import Table, read_table, sweep, write_parquet

__all__ = ["PRECISION", "Body", "Event", "Joint", "Load", "Readings", "Scene", "SceneError", "Table", "read_table", "sweep",
		   "write_parquet"]
