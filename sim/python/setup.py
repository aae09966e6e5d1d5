"""The module as CMake builds it, for setuptools to pack; what there is to say of it stands in pyproject.toml.

MCKIBBEN_BUILD names a folder where CMake has built it already (`./mckibben python --wheel` does)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(mckibben VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


def built_in(folder):
    """CMake's folder, with the module in it."""
    subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release",
                    "-D", "MCKIBBEN_UNITY=ON", "-D", f"Python_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "mckibben_python"], check=True)
    return folder


class ByCMake(build_ext):
    def build_extension(self, extension):
        there = os.environ.get("MCKIBBEN_BUILD")
        folder = pathlib.Path(there) if there else built_in(pathlib.Path(self.build_temp).resolve() / "cmake")
        built, = (folder / "python/mckibben").glob("_core.*.so")
        into = pathlib.Path(self.get_ext_fullpath(extension.name))
        into.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(built, into)


setup(version=VERSION, ext_modules=[Extension("mckibben._core", sources=[])], cmdclass={"build_ext": ByCMake})
