#!/usr/bin/env python3
"""Does a page of the documentation tell the truth? Does what the page tells to do, in order, in an empty folder.

usage: pages.py PROGRAM PAGE... [--write]

    ```yaml title="NAME"     a file, written into the folder
    ```python                a cell, run by Python where the cells before left off; the ```text below is what it prints,
                             and what its last line is worth, as in a notebook
    ```console               of a line "$ COMMAND", run by bash, the lines below are what it prints, errors too
    <!-- picture: PICTURE is "LABEL" of REPORT -->    a picture of a report that was made, as a file beside the page;
                             with "at 2 s" behind REPORT as a browser shows it with the report's cursor there

must be as they are on the page and beside it, but for the last digit of numbers, in which machines differ, and 1 % of
those with a decimal point, where fits end.
--write puts into page and pictures what they are now: read what has changed, and check it in.
"""
import ast
import contextlib
import difflib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SHOWN_AS = "/home/me/mckibben"  # where the reader's checkout is thought to be
PART = re.compile(r'^```(?P<kind>console|\w+ title="(?P<name>[^"]+)")\n(?P<body>.*?)^```$'
                  r'|^```python\n(?P<cell>.*?)^```$(?:\n\n```text\n.*?^```$)?'
                  r'|^<!-- picture: (?P<picture>\S+) is "(?P<label>[^"]+)" of (?P<report>\S+)(?: at (?P<time>\S+) s)? -->$', re.S | re.M)
PROGRESS = re.compile(r"^.*, step \d+, .* so far\n", re.M)  # a line for each minute: how many is a matter of the machine
NUMBER = re.compile(r"[0-9]+(?:\.[0-9]+)?(?:e[+-]?[0-9]+)?")


def checkout(program, folder):
    """A folder that looks like a checkout to whoever types commands there."""
    shutil.copytree(Path(__file__).resolve().parents[2] / "scenarios", folder / "scenarios")
    script = folder / "mckibben"
    script.write_text(f'#!/bin/sh\nexec "{program}" "$@"\n')
    script.chmod(0o755)


def play(session, folder):
    """The session as it is: each command of a console with what it prints here."""
    text = ""
    for command in re.findall(r"^\$ (.*(?:\\\n.*)*)$", session, re.M):
        done = subprocess.run(["bash", "-c", command], cwd=folder, text=True, timeout=1500,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        said = PROGRESS.sub("", done.stdout.replace(str(folder), SHOWN_AS))
        text += f"$ {command}\n" + re.sub(r"([^\n])\Z", "\\1\n", said)
    return text


def cell(code, names):
    """What a cell of a notebook prints."""
    tree = ast.parse(code)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
        if value is not None:
            print(repr(value))
    return printed.getvalue()


def rules(style):
    """The rules of a style sheet, those inside @media with it."""
    rule, depth = "", 0
    for piece in re.findall(r"[^{}]+|[{}]", re.sub(r"/\*.*?\*/", "", style, flags=re.S)):
        rule += piece
        depth += {"{": 1, "}": -1}.get(piece, 0)
        if depth == 0 and piece == "}":
            yield " ".join(rule.split())
            rule = ""


def as_a_browser_shows(report, time):
    """The report's page after its script has run, the cursor at a time."""
    moved = report.with_name("moved.html")
    moved.write_text(report.read_text() + f"<script>const cursor = document.getElementById('time');"
                     f"cursor.value = {time}; cursor.dispatchEvent(new Event('input'));</script>")
    sandbox = ["--no-sandbox"] if os.getuid() == 0 else []  # Chromium's sandbox refuses root
    done = subprocess.run([os.environ.get("CHROMIUM", "chromium"), "--headless", "--disable-gpu", *sandbox,
                           "--virtual-time-budget=2000", "--dump-dom", moved.as_uri()], capture_output=True, text=True, timeout=120, check=True)
    return done.stdout


def drawing(page, label):
    """A picture of a page, with those rules of the page's style that concern it, as a file of its own."""
    svg = re.search(rf"<svg [^>]*aria-label=['\"]{re.escape(label)}['\"][^>]*>.*?</svg>", page, re.S)[0]
    classes = {name for names in re.findall(r"class=['\"]([^'\"]*)", svg) for name in names.split()}
    own = re.search(r"id=['\"](\w+)", svg.split(">")[0])
    concern = re.compile(rf":root|@media.*dark|svg (?!>)|\.(?:{'|'.join(sorted(classes))})\b(?! \.)"
                         + (f"|#{own[1]} " if own else ""))
    style = [rule for rule in rules(re.findall(r"<style>(.*?)</style>", page, re.S)[-1]) if concern.match(rule)]
    style.append("svg { background: var(--ground); font: 13px sans-serif; }")
    width, height = re.search(r"viewBox=['\"]\S+ \S+ (\S+) (\S+)['\"]", svg).groups()
    head = f"<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}' "
    return svg.replace("<svg ", head, 1).replace(">", "><style>\n" + "\n".join(style) + "\n</style>", 1) + "\n"


def as_it_is(page, folder):
    """What the page, and each picture, should be."""
    drawn, names = [], {}

    def truth(part):
        if part["cell"]:
            printed = cell(part["cell"], names)
            return f"```python\n{part['cell']}```" + (f"\n\n```text\n{printed}```" if printed else "")
        if part["picture"]:
            drawn.append(part)
        elif part["name"]:
            (folder / part["name"]).write_text(part["body"])
        else:
            return f"```console\n{play(part['body'], folder)}```"
        return part[0]

    made = {page: PART.sub(truth, page.read_text())}
    for part in drawn:  # at the end: a page may open with a picture of what it does
        report, time = folder / part["report"], part["time"]
        shown = as_a_browser_shows(report, time) if time else report.read_text()
        made[page.parent / part["picture"]] = drawing(shown, part["label"])
    return made


def last_place(number):
    mantissa, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def fitted(number):
    """Whether it may come from a fit, which ends a little elsewhere on another machine; counts do not."""
    return "." in number


def agree(a, b):
    if NUMBER.split(a) != NUMBER.split(b):
        return False
    return all(x == y or abs(float(x) - float(y)) < max(1.5 * last_place(x), 1.5 * last_place(y), fitted(x) and 0.01 * float(x))
               for x, y in zip(NUMBER.findall(a), NUMBER.findall(b)))


def main():
    write = "--write" in sys.argv
    program, *pages = [a for a in sys.argv[1:] if a != "--write"]
    wrong = False
    for page in map(Path.resolve, map(Path, pages)):
        with tempfile.TemporaryDirectory() as folder:
            checkout(Path(program).resolve(), Path(folder))
            with contextlib.chdir(folder):
                now = as_it_is(page, Path(folder))
        for path, made in now.items():
            kept = path.read_text() if path.exists() else ""
            if agree(kept, made):
                continue
            if write:
                path.parent.mkdir(exist_ok=True)
                path.write_text(made)
                continue
            wrong = True
            sys.stdout.writelines(difflib.unified_diff(kept.splitlines(True), made.splitlines(True), str(path), "now"))
            print(f"{path} is no longer what the program makes: docs/testing.md, Pages")
    sys.exit(wrong)


if __name__ == "__main__":
    main()
