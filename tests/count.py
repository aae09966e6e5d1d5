#!/usr/bin/env python3
"""Prints how large the program is. Nothing fails by it.

count.py              lines of C++ by room, and of tests; C++ files over 400 lines
count.py RANGE...     of each commit or range of git: files touched, split into sources, docs and tests
"""
import collections
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ("plant", "controllers", "sim")
LONG = 400


def room(path):
    """The folder that a C++ file is counted with: plant/effects with plant, sim/fmu/model with sim/fmu."""
    top, *rest = path.parts
    return f"{top}/{rest[0]}" if top in ("sim", "tests") and len(rest) > 1 else top


def print_size():
    files = {path.relative_to(ROOT): path.read_text().count("\n")
             for top in (*PROGRAM, "tests") for path in sorted((ROOT / top).rglob("*.[ch]pp"))}
    rooms = collections.defaultdict(list)
    for path, lines in files.items():
        rooms[room(path)].append(lines)
    print("lines  files  longest")
    for name, lines in rooms.items():
        print(f"{sum(lines):5}  {len(lines):5}  {max(lines):7}  {name}")
    for title, tops in ((" + ".join(PROGRAM), PROGRAM), ("tests", ("tests",))):
        lines = sorted(lines for path, lines in files.items() if path.parts[0] in tops)
        print(f"{sum(lines):5}  {len(lines):5}  {lines[-1]:7}  {title}; {lines[len(lines) // 2]} lines in the middle")
    over = [f"{path} ({lines})" for path, lines in files.items() if lines > LONG]
    print(f"over {LONG} lines:", ", ".join(over) or "none")


def kind(path):
    if path.startswith("tests/"):
        return "tests"
    return "docs" if path.startswith("docs/") or path.endswith(".md") or path == "mkdocs.yml" else "sources"


def print_touched(what):
    """What a range changes as a whole; of a single commit, what it changes of its parent."""
    revisions = [what] if ".." in what else [f"{what}^", what]
    names = subprocess.run(["git", "-C", ROOT, "diff", "--name-only", *revisions, "--"],
                           check=True, text=True, capture_output=True).stdout.splitlines()
    touched = {"sources": [], "docs": [], "tests": []}
    for name in names:
        touched[kind(name)].append(name)
    print(f"{what}: " + ", ".join(f"{len(paths)} {group}" for group, paths in touched.items()))
    for group, paths in touched.items():
        for path in paths:
            print(f"  {group:7}  {path}")


if sys.argv[1:2] in (["-h"], ["--help"]):
    print(__doc__.strip())
elif len(sys.argv) > 1:
    for argument in sys.argv[1:]:
        print_touched(argument)
else:
    print_size()
