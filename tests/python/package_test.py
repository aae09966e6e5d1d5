"""The package as a whole: doctests, docstrings, and stubs that tell what is there."""
import ast
import doctest
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import mckibben
import mckibben._core
import mckibben.env
import mckibben.errors
import mckibben.frames
import mckibben.tables
from common import ROOT, main

FOLDER = pathlib.Path(mckibben.__file__).parent
BY_ALL = {"__init__", "__len__", "__getitem__"}


def names_of(of):
    return {name for name in vars(of) if not name.startswith("_") or name in BY_ALL & set(vars(of))}


class Package(unittest.TestCase):
    def test_doctests(self):
        for module in (mckibben, mckibben.env, mckibben.errors, mckibben.frames, mckibben.tables):
            failed, _ = doctest.testmod(module)
            self.assertEqual(failed, 0, module.__name__)
        self.assertGreater(doctest.testmod(mckibben.env).attempted, 3)

    def test_everything_public_has_words(self):
        for name in mckibben.__all__:
            thing = getattr(mckibben, name)
            self.assertTrue(thing.__doc__, name)
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_stubs_name_what_there_is_with_its_arguments(self):
        tree = ast.parse((FOLDER / "_core.pyi").read_text())
        stubs = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
        real = {name: value for name, value in vars(mckibben._core).items() if isinstance(value, type)}
        self.assertEqual(set(stubs), set(real))
        for name, node in stubs.items():
            functions = {item.name: item for item in node.body if isinstance(item, ast.FunctionDef)}
            there = names_of(real[name]) - (set() if "__init__" in functions else {"__init__"})
            self.assertEqual(set(functions), there, name)
            for member, function in functions.items():
                if function.decorator_list or member.startswith("__") and member != "__init__":
                    decorated = [ast.unparse(each) for each in function.decorator_list]
                    self.assertTrue(decorated in ([], ["overload"]) or isinstance(vars(real[name])[member], property))
                    continue
                given = [a.arg for a in function.args.args[1:] + function.args.kwonlyargs]
                signature = getattr(real[name], member).__doc__.splitlines()[0]
                self.assertEqual(given, re.findall(r"(\w+): ", signature)[1:], f"{name}.{member}")

    def test_a_wheel_holds_it_and_what_pypi_wants_to_know(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "sim/python"  # setuptools writes beside what it packs
            shutil.copytree(ROOT / "sim/python", source, ignore=shutil.ignore_patterns("__pycache__"))
            shutil.copy(ROOT / "CMakeLists.txt", folder)
            done = subprocess.run([sys.executable, "-c", "from setuptools import build_meta as b; print(b.build_wheel('.'))"],
                                  cwd=source, env={**os.environ, "MCKIBBEN_BUILD": str(FOLDER.parents[1])},
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            wheel = source / done.stdout.split()[-1]
            with zipfile.ZipFile(wheel) as packed:
                names = packed.namelist()
                metadata, = (packed.read(name).decode() for name in names if name.endswith("METADATA"))
                packed.extractall(f"{folder}/installed")
            self.assertIn(f"Version: {mckibben.__version__}", metadata)
            self.assertIn("Requires-Dist: numpy", metadata)
            # It carries its libraries: none but those of every Linux is taken from elsewhere.
            core, = pathlib.Path(f"{folder}/installed/mckibben").glob("_core.*.so")
            linked = subprocess.run(["ldd", core], capture_output=True, text=True).stdout
            self.assertIn(f"libnetcdf.so.19 => {core.parent}/libs/", linked)
            outside = [line.split()[0] for line in linked.splitlines() if "=> /" in line and str(core.parent) not in line]
            self.assertRegex(" ".join(outside), r"^(lib(c|m|dl|rt|pthread|resolv|gcc_s|stdc\+\+)\.so\.\d ?)+$")
            self.assertIn("mckibben/libs/udunits2.xml", names)
            self.assertTrue({"mckibben/py.typed", "mckibben/_core.pyi", "mckibben/env.py"} <= set(names), names)
            said = subprocess.run([sys.executable, "-c", "import mckibben; print(mckibben.Ride(load_kg=11.0).step(9.0).time_s, mckibben.__file__)"],
                                  env={**os.environ, "PYTHONPATH": f"{folder}/installed"}, capture_output=True, text=True)
            self.assertIn(f"0.012 {folder}/installed", said.stdout, said.stderr)

    def test_is_marked_as_typed(self):
        self.assertTrue((FOLDER / "py.typed").exists())
        self.assertRegex(mckibben.__version__, r"^\d+\.\d+\.\d+$")


main()
