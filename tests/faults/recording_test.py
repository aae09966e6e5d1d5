#!/usr/bin/env python3
"""Recordings that are never lost: one file operation of `control` or `live` after another goes wrong (faults.cpp),
over the result of an earlier session.

    recording_test.py MCKIBBEN FAULTS_LIBRARY control|live [every]

At each operation (without `every` at the telling ones) the program is killed, or the disk is full from there on; with
`every` also as that operation alone fails. Then the earlier result or a new one is there, whole; every row that was seen on disk is in a data
set; what could not be written was said (74). The same command then ends well and takes nothing from what was there.
"""
import errno
import http.client
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from letters import telling

PROGRAM, LIBRARY, VERB = sys.argv[1:4]
EVERY = sys.argv[4:] == ["every"]
SCENARIO = """schema: mckibben-scenario/1
rig: {base: thesis, settling_time: 0.06 s}
loads: [16.138 kg]
duration: 0.12 s
target: {kind: minimum_jerk, start: 0.06, moves: []}
controllers: [{kind: sine_current, low: 5 mA, high: 6 mA, period: 1 s}]
"""
INPUT, OPTIONS, LEAST_ROWS = {"control": (SCENARIO, ["--most-missed", "1000"], 10),
                              "live": ("schema: mckibben-rig/1\ntick: 1 ms\n", [], 100)}[VERB]
ERRORS = [errno.ENOSPC, errno.EIO, errno.EDQUOT]


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def table(folder):
    """The rows of a data set that can be read; b"" of what is none."""
    try:
        rows, = [path.read_bytes() for path in folder.glob("*.csv")]
        return rows[rows.index(b"\n") + 1:rows.rindex(b"\n") + 1] if (folder / "dataset.yaml").exists() else b""
    except (OSError, ValueError):  # none yet, or it goes away just now
        return b""


def record_in_page(live, until):
    """What somebody does in the page: records, and stops."""
    port, token = re.fullmatch(r"http://127.0.0.1:(\d+)/(\w+)/", live.stdout.readline().strip()).groups()

    def do(what, **more):
        page = http.client.HTTPConnection("127.0.0.1", int(port), timeout=20)
        page.request("POST", f"/{token}/do", json.dumps({"do": what} | more), {"Content-Type": "application/json"})
        assert json.loads(page.getresponse().read())["refused"] == ""

    do("record", from_rest=True)
    do("command", to=5 + time.monotonic() % 10)  # no two sessions are alike
    until()
    do("stop")
    live.send_signal(signal.SIGINT)


class Place:
    def __init__(self, root):
        self.root, self.out, self.log = root, root / "out", root / "log"
        (root / "input.yaml").write_text(INPUT)
        self.old = b""
        assert self.run()[0] == 0
        self.old = table(self.out / "o")
        shutil.copytree(self.out, root / "saved")

    def back(self):
        shutil.rmtree(self.out)
        shutil.copytree(self.root / "saved", self.out)

    def tables(self):
        """Name of each data set of what was measured, and its rows."""
        return {path.name: table(path) for path in self.out.glob("o*") if "-truth" not in path.name}

    def rows(self):
        """Of the longest recording beside the old one."""
        return max((rows.count(b"\n") for rows in self.tables().values() if rows != self.old), default=0)

    def run(self, **faults):
        """Exit status, what was said, the most rows that were seen on disk."""
        self.log.unlink(missing_ok=True)
        settings = {"LD_PRELOAD": LIBRARY, "FAULT_BELOW": str(self.out), "FAULT_LOG": str(self.log)} if faults else {}
        settings |= {f"FAULT_{key.upper()}": str(value) for key, value in faults.items()}
        seen = 0
        with subprocess.Popen([PROGRAM, VERB, "input.yaml", "--out", "out/o", *OPTIONS], cwd=self.root, text=True,
                              env=os.environ | settings, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
            def until_recorded():
                nonlocal seen
                begin = time.monotonic()
                while program.poll() is None and (VERB == "control" or time.monotonic() < begin + 3e-3 * LEAST_ROWS):
                    seen = max(seen, self.rows())
                    time.sleep(0.005)
            try:
                record_in_page(program, until_recorded) if VERB == "live" else until_recorded()
            except (OSError, AttributeError, http.client.HTTPException):
                pass  # it was killed, or could not begin
            said = program.communicate(timeout=60)[1]
        self.said = f"{program.returncode}, {self.log.read_text() if faults else None}\n{said}"
        return program.returncode, said, max(seen, self.rows())

    def expect_whole(self):
        """A result stands there, with all of its files."""
        assert contents(self.out / "o").keys() == contents(self.root / "saved/o").keys(), "no whole result is there"

    def expect_old(self):
        """What an earlier session left: in its place or set aside or, of `control`, replaced."""
        saved = contents(self.root / "saved/o")
        assert VERB == "control" or saved in [contents(path) for path in self.out.glob("o*")], "the earlier result is lost"

    def expect_the_next_goes_well(self):
        """The same command again. What `control` leaves takes the place of what it left before."""
        before = {rows for name, rows in self.tables().items() if not (VERB == "control" and name == "o")}
        status, said, _ = self.run()
        assert status == 0, f"again: {status}\n{said}"
        after = self.tables()
        assert before <= set(after.values()), "the next run takes rows of an earlier one"
        assert after["o"].count(b"\n") >= LEAST_ROWS, "the next run's rows are not there"
        strangers = [path.name for path in self.out.iterdir()
                     if not re.fullmatch(r"o(-truth)?(\.old-\d|\.unfinished(-\d)?)?", path.name)]
        assert not strangers, strangers
        self.expect_whole()
        self.expect_old()


def killed(place, n):
    status, said, seen = place.run(do="kill", at=n)
    assert status in ((-9,) if VERB == "control" else (-9, 0)), f"{status}\n{said}"  # of `live` the number varies
    place.expect_whole()
    assert place.rows() >= seen, f"{place.rows()} of {seen} rows"


def failing(place, n, **more):
    status, said, seen = place.run(do=ERRORS[n % 3], at=n, **more)
    assert status in (0, 74), f"{status}\n{said}"
    assert status == 0 or "cannot write" in said, said
    place.expect_whole()
    assert place.rows() >= (LEAST_ROWS if status == 0 else seen), f"{place.rows()} of {seen} rows, {status}\n{said}"


def full(place, n):
    failing(place, n, on=1)


def main():
    with tempfile.TemporaryDirectory() as root:
        place = Place(Path(root).resolve())
        status, said, _ = place.run(do=0, at=0)
        assert status == 0, said
        letters = place.log.read_text()
        chosen = range(1, len(letters) + 1) if EVERY else telling(letters)
        for n in chosen:
            for test in (killed, full, failing) if EVERY else (killed, full):
                place.back()
                try:
                    test(place, n)
                    place.expect_the_next_goes_well()
                except AssertionError as wrong:
                    there = "\n".join(sorted(contents(place.out)))
                    raise SystemExit(f"{test.__name__}, {VERB}, operation {n} of {len(letters)} ({letters}): {wrong}\n"
                                     f"{place.said}\n{there}") from None
        print(f"{VERB}: {len(chosen)} of {len(letters)} operations {letters}")


main()
