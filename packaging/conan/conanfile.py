"""The library and, with -o sightline/*:program=True, the program: conan create packaging/conan, from the top folder."""

import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Sightline(ConanFile):
    name = "sightline"
    version = "0.1.0"
    license = "GPL-3.0-or-later"
    description = "Exact 3D visibility that can be checked"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False], "program": [True, False]}
    default_options = {"shared": False, "fPIC": True, "program": False}

    def export_sources(self):
        top = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "*.md", "LICENSE", "CITATION.cff", "kernel/*", "algorithms/*", "io/*", "harness/*",
                        "sightline/*", "apps/*", "proofs/*", "packaging/*"):
            copy(self, pattern, src=top, dst=self.export_sources_folder)

    def requirements(self):
        for name in ("cgal/[>=5.5]", "boost/[>=1.74]", "gmp/[>=6.2]", "mpfr/[>=4.1]", "nlohmann_json/[>=3.11]",
                     "onetbb/[>=2021]", "openmesh/[>=9]"):
            self.requires(name, transitive_headers=True)
        if self.options.program:
            for name in ("cli11/[>=2.3]", "fmt/[>=9]", "libpng/[>=1.6]"):
                self.requires(name)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.variables["SIGHTLINE_APPS"] = bool(self.options.program)
        toolchain.variables["SIGHTLINE_TESTS"] = False
        toolchain.variables["SIGHTLINE_BENCH"] = False
        toolchain.variables["SIGHTLINE_MPI"] = "OFF"
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_find_mode", "none")  # the package's own config file
        self.cpp_info.builddirs.append(os.path.join("lib", "cmake", "sightline"))
