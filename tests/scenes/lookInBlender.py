# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Imports a film into Blender, compares it with what it should be, and renders a picture:

    blender -b --factory-startup --python-exit-code 1 --python tests/scenes/lookInBlender.py -- FILM.glb PICTURE.png [EXPECTED.json]

EXPECTED.json, which tests/scenes/testBlender.cpp writes, holds for some pictures the bodies' poses and places on bent surfaces.
"""

import json
import math
import sys

import bpy
import numpy
from mathutils import Matrix, Quaternion, Vector

if "bool" not in vars(numpy):
    numpy.bool = bool  # Debian 12's Blender asks for it, but its NumPy has it no more

RATE = 60  # pictures a second
Y_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))  # from glTF's axes to Blender's


def pose_of(body):
    """In glTF's axes."""
    return Y_UP.inverted() @ body.matrix_world @ Y_UP


def surface_of(body):
    """Places of its corners in glTF's axes, bent as they are."""
    evaluated = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
    to_ours = Y_UP.inverted() @ evaluated.matrix_world
    return [to_ours @ corner.co for corner in evaluated.to_mesh().vertices]


def compare(expected):
    """Tells the largest deviation of poses [m], of directions at a distance of 1 m, and of places on surfaces [m]."""
    of_poses = of_surfaces = 0
    for picture in expected["pictures"]:
        bpy.context.scene.frame_set(picture["number"])
        for name, numbers in picture["poses"].items():
            found = pose_of(bpy.data.objects[name])
            x, y, z, w = numbers[3:]
            wanted = Matrix.Translation(numbers[:3]) @ Quaternion((w, x, y, z)).to_matrix().to_4x4()
            deviation = max(abs(found[row][i] - wanted[row][i]) for row in range(3) for i in range(4))
            if deviation > 1e-5:
                print(name, "in picture", picture["number"], "is at", found, "in place of", wanted)
            of_poses = max(of_poses, deviation)
        for name, places in picture["surfaces"].items():
            corners = surface_of(bpy.data.objects[name])
            for place in places:
                of_surfaces = max(of_surfaces, min((corner - Vector(place)).length for corner in corners))
    print("deviation of poses: %g" % of_poses)
    print("deviation of surfaces: %g" % of_surfaces)


def add_sight(scene):
    """Light, and a camera from which all that can move is seen."""
    places = [Y_UP @ place for each in scene.objects
              if each.type == "MESH" and (each.parent or each).animation_data for place in surface_of(each)]
    middle = sum(places, Vector()) / len(places)
    size = max((place - middle).length for place in places)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    direction = Vector((.35, -1, .3)).normalized()
    camera.location = middle + direction * size * 3
    camera.rotation_euler = direction.to_track_quat("Z", "Y").to_euler()
    camera.data.clip_end = 10 * size
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 4
    sun.rotation_euler = (math.radians(50), 0, math.radians(30))
    for each in (camera, sun):
        scene.collection.objects.link(each)
    scene.camera = camera


def render(scene, picture):
    """Returns the share of the picture that is not the background."""
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 480, 270, 100
    scene.render.film_transparent = True
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    pixels = bpy.data.images.load(picture).pixels[:]
    return sum(alpha > .5 for alpha in pixels[3::4]) / (len(pixels) / 4)


def main(film, picture, expected=None):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = RATE
    bpy.ops.import_scene.gltf(filepath=film)
    joints = [each for each in scene.objects if "joint" in each]
    print(len(joints), "joints,", sum(bool(each["is_broken"]) for each in joints), "broken")
    if expected:
        with open(expected, encoding="utf-8") as file:
            compare(json.load(file))
    else:
        scene.frame_set(int(max(action.frame_range[1] for action in bpy.data.actions)))
    add_sight(scene)
    print("covered: %.3f of the picture" % render(scene, picture))


main(*sys.argv[sys.argv.index("--") + 1:])
