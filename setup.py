"""Builds the Python package robosim with CMake, and packs what its install component robosim-wheel contains."""
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"project\(robosim VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)


class CMakeBuild(build_ext):
    """Compiles the target robosim_python, and installs the package with the libraries and the data."""

    def build_extension(self, ext):
        build = SOURCE / "build" / "wheel"
        target = pathlib.Path(self.build_lib).resolve()
        subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_CXX_FLAGS_RELEASE=-O3", "-DCMAKE_UNITY_BUILD=ON", "-DROBOSIM_PYTHON_FOLDER=.",
                        f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "robosim_python"], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "robosim-wheel", "--prefix", target], check=True)


setup(version=VERSION, packages=[], ext_modules=[Extension("robosim._robosim", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
