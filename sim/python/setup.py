"""The module as CMake builds it, for setuptools to pack; what there is to say of it stands in pyproject.toml.

MCKIBBEN_BUILD names a folder where CMake has built it already (`./mckibben python --wheel` does); the libraries that it
links go with it then."""
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


# What any Linux with Python has, by manylinux's list (PEP 600); all else goes with the module.
EVERYWHERE = re.compile(r"linux-vdso|ld-linux|lib(c|m|dl|rt|pthread|util|resolv|gcc_s|stdc\+\+)\.so")


def carry_libraries(module):
    """What the module links, into `libs` beside it, with their licences and UDUNITS' tables. Needs patchelf, dpkg."""
    libs = module.parent / "libs"
    (libs / "licenses").mkdir(parents=True, exist_ok=True)
    linked = re.findall(r"^\s*(\S+) => (/\S+)", subprocess.run(["ldd", module], check=True, capture_output=True, text=True).stdout, re.M)
    for name, path in linked:
        if EVERYWHERE.match(name):
            continue
        shutil.copy(path, libs / name)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", libs / name], check=True)
        for place in (path, str(pathlib.Path(path).resolve())):
            found = subprocess.run(["dpkg", "-S", place], capture_output=True, text=True).stdout
            if package := found.split(":")[0]:
                shutil.copy(f"/usr/share/doc/{package}/copyright", libs / f"licenses/{package}.txt")
    subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/libs", module], check=True)
    for table in pathlib.Path("/usr/share/xml/udunits").glob("*.xml"):
        shutil.copy(table, libs)


class ByCMake(build_ext):
    def build_extension(self, extension):
        there = os.environ.get("MCKIBBEN_BUILD")
        folder = pathlib.Path(there) if there else built_in(pathlib.Path(self.build_temp).resolve() / "cmake")
        built, = (folder / "python/mckibben").glob("_core.*.so")
        into = pathlib.Path(self.get_ext_fullpath(extension.name))
        into.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(built, into)
        if there:
            carry_libraries(into)


setup(version=VERSION, ext_modules=[Extension("mckibben._core", sources=[])], cmdclass={"build_ext": ByCMake})
