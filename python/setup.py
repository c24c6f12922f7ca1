# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""Has the project's own CMake build the compiled part of the package.

CMAKE_ARGS in the environment goes to CMake, such as -DBULLET_ROOT=...; BULLET_EP_PYTHON_BUILD names a folder of the build that is
kept, for those who build again and again; BULLET_EP_PYTHON_READY one of a build that has the compiled part already.
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = pathlib.Path(__file__).resolve().parent.parent


class CMakeBuild(build_ext):
	def build_extension(self, extension):
		package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
		ready = os.environ.get("BULLET_EP_PYTHON_READY")
		build = pathlib.Path(ready or os.environ.get("BULLET_EP_PYTHON_BUILD") or self.build_temp).resolve()
		if not ready:
			self.build_with_cmake(build)
		subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", package], check=True)

	@staticmethod
	def build_with_cmake(build):
		subprocess.run(["cmake", "-S", PROJECT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
						"-DBULLET_EP_BUILD_PYTHON=ON", "-DBULLET_EP_BUILD_TESTS=OFF", "-DBULLET_EP_BUILD_BENCHMARKS=OFF",
						"-DBULLET_EP_INSTALL=OFF", "-DBUILD_SHARED_LIBS=OFF", "-DCMAKE_UNITY_BUILD=ON", f"-DPython3_EXECUTABLE={sys.executable}",
						f"-Dpybind11_DIR={pybind11.get_cmake_dir()}",
						*shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
		subprocess.run(["cmake", "--build", build, "--target", "python-package"], check=True)


def version():
	return re.search(r"project\(BulletElasticPlastic VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text())[1]


setup(version=version(), ext_modules=[Extension("bullet_elastic_plastic._core", [])], cmdclass={"build_ext": CMakeBuild})
