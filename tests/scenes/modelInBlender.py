# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Models an arm of two boxes on a wall in Blender, and exports it:

    blender -b --factory-startup --python-exit-code 1 --python tests/scenes/modelInBlender.py -- MODEL.glb
"""

import sys

import bpy
import numpy

if "bool" not in vars(numpy):
    numpy.bool = bool  # as in lookInBlender.py


def box(name, place, size, properties=None, surface=None):
    bpy.ops.mesh.primitive_cube_add(size=1, location=place, scale=size)
    made = bpy.context.object
    made.name = name
    for key, value in (properties or {}).items():
        made[key] = value
    if surface:
        made.data.materials.append(bpy.data.materials.new(surface))


bpy.ops.wm.read_factory_settings(use_empty=True)
box("wall", (0, 0, 0), (1, 2, 2), {"motion": "static"})
box("arm", (1, 0, 0), (1, .4, .5))
box("tip", (2, 0, 0), (1, .4, .5), {"mass": 100.0}, "oak")
bpy.ops.export_scene.gltf(filepath=sys.argv[sys.argv.index("--") + 1], export_extras=True)
