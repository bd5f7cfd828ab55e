# SPDX-License-Identifier: Apache-2.0
"""Conan 2 recipe of the header-only package, from the local tree: `conan create .`

Thrust is not a requirement of the recipe: the package finds it on the machine of who uses it, in
CCCL_ROOT or in the CUDA toolkit, through the CMake files that it installs.
"""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy

required_conan_version = ">=2.0"


class DeferredShade(ConanFile):
    name = "deferred_shade"
    description = "Reorders shading requests so that SIMD lanes stay together"
    license = "Apache-2.0"
    topics = ("rendering", "ray-tracing", "simd", "thrust", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    exports_sources = "CMakeLists.txt", "LICENSE", "cmake/*", "include/*"
    no_copy_source = True

    def set_version(self):
        header = Path(self.recipe_folder, "include/deferred_shade/version.hpp").read_text()
        numbers = re.findall(r"#define DEFERRED_SHADE_VERSION_(?:MAJOR|MINOR|PATCH) +(\d+)", header)
        self.version = ".".join(numbers)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False
        for part in ("TESTS", "EXAMPLES", "BENCHMARKS"):
            toolchain.cache_variables[f"DEFERRED_SHADE_BUILD_{part}"] = False
        toolchain.cache_variables["DEFERRED_SHADE_FETCH_CCCL"] = False
        toolchain.generate()

    def build(self):
        CMake(self).configure()

    def package(self):
        copy(self, "LICENSE", self.source_folder, str(Path(self.package_folder, "licenses")))
        CMake(self).install()

    def package_id(self):
        self.info.clear()

    def package_info(self):
        # The package's own CMake files describe it: they find Thrust and the backends' runtimes.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["share/cmake/deferred_shade"]
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
