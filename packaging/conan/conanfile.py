# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib
"""Conan 2 recipe: conan create packaging/conan also builds and runs test_package with it."""

import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rmdir

required_conan_version = ">=2.0"


class BulletElasticPlasticConan(ConanFile):
    name = "bullet-elastic-plastic"
    version = "0.2.0"
    description = "Joints for Bullet Physics that bend before they break"
    license = "Zlib"
    topics = ("physics", "simulation", "destruction", "bullet")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE.txt", "README.md", "src/*", "cmake/*", "docs/*.md"):
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("bullet3/3.25", transitive_headers=True)

    def validate(self):
        check_min_cppstd(self, 14)

    @property
    def _is_double(self):
        return bool(self.dependencies["bullet3"].options.get_safe("double_precision"))

    @property
    def _has_threads(self):
        return bool(self.dependencies["bullet3"].options.get_safe("bt2_thread_locks"))

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in ("EXAMPLES", "TESTS", "BENCHMARKS"):
            toolchain.cache_variables["BULLET_EP_BUILD_" + part] = False
        toolchain.cache_variables["BULLET_ROOT"] = self.dependencies["bullet3"].package_folder
        toolchain.cache_variables["BULLET_EP_PRECISION"] = "double" if self._is_double else "float"
        # Bullet's headers lock where its library does, and only if they are told.
        if self._has_threads:
            toolchain.preprocessor_definitions["BT_THREADSAFE"] = "1"
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE.txt", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # Conan makes these from package_info().
        for made in (("lib", "cmake"), ("lib", "pkgconfig"), ("share",)):
            rmdir(self, os.path.join(self.package_folder, *made))

    def package_info(self):
        suffix = "-float64" if self._is_double else ""
        self.cpp_info.libs = ["BulletElasticPlastic" + suffix]
        self.cpp_info.includedirs = ["include/bullet-elastic-plastic"]
        self.cpp_info.set_property("cmake_file_name", "BulletElasticPlastic")
        self.cpp_info.set_property("cmake_target_name", "BulletElasticPlastic::BulletElasticPlastic" + suffix)
        self.cpp_info.set_property("pkg_config_name", "bullet-elastic-plastic" + suffix)
        if self._has_threads:
            self.cpp_info.defines = ["BT_THREADSAFE=1"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m", "pthread"]
