#!/usr/bin/env python3
"""Results that are never lost or stuck: one file operation of a verb after another goes wrong (faults.cpp), over an
older result.

    publish_test.py MCKIBBEN FAULTS_LIBRARY run|dataset|ensemble|diagnose|import|replay|map|calibrate|fmu [every]

Without `every` only the telling operations (letters.py). For each of them, n: killed at the n-th operation, and
the next run at another, the old or the new result is there, whole; the run after that ends well and leaves the same
bytes as an undisturbed one and nothing else; failing there, at this operation or as a full disk does, the program says so (74) and the old result is as it was,
or it ends well with the new one. A second process on the same --out, started before the operation, is refused at once
and spoils nothing. Where folders cannot be exchanged, the same holds.
"""

import errno
import os
import shlex
import shutil
import subprocess
import sys
import tempfile

from letters import telling

PROGRAM, LIBRARY, VERB = sys.argv[1:4]
EVERY = sys.argv[4:] == ["every"]

SCENARIO = """schema: mckibben-scenario/1
loads: [11.138 kg]
duration: 0.3 s
seed: {seed}
target: {{kind: sine, mean: 0.05, amplitude: 0.02, period: 1 s}}
controllers: [{{kind: sine_current, low: 5 mA, high: 9 mA, period: 1 s}}]
noise: {{encoder_jitter: 1e-4}}
"""
CAMPAIGN = """schema: mckibben-campaign/1
name: small
seed: {seed}
loads: [11.138 kg]
currents: [{{duration: 0.3 s, current: {{kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}}}]
noise: {{encoder_jitter: 1e-4}}
"""
LOADS_AND_SPEEDS = """schema: mckibben-campaign/1
loads: [5 kg, 9 kg, 13 kg, 17 kg]
currents:
""" + "".join(f"  - {{duration: {s} s, current: {{kind: sine_current, low: 4 mA, high: 20 mA, period: {s} s}}}}\n" for s in (2, 3, 4))
ENSEMBLE = CAMPAIGN + "repeats: 70\nvary: {{muscle.rest_radius: normal 7.5 mm ± 1 %}}\n"
# `diagnose` is stopped at once, and writes what it always writes.
DATASET = """schema: mckibben-dataset/1
runs: [{{id: r{seed}, file: r.csv, load: 11.138 kg}}, {{id: s, file: r.csv, load: 16.138 kg}}]
"""
RIG = "schema: mckibben-rig/1\nmuscle: {{rest_radius: 7.{seed} mm}}\n"
with open(os.path.join(os.path.dirname(__file__), "../../scenarios/thesis_calibration.yaml")) as shipped:
    CALIBRATION = shipped.read().replace("{", "{{").replace("}", "}}") + "# {seed}\n"
INPUT = {"run": SCENARIO, "dataset": CAMPAIGN, "ensemble": ENSEMBLE, "diagnose": DATASET,
         "replay": DATASET.replace("r{seed}", "r").replace("11.138", "11.{seed}"),
         "map": CALIBRATION, "fmu": RIG, "calibrate": "# {seed}\n",
         "import": "t [s],I (mA),x_mm\n" + "".join(f"{k}.0,{{seed}},{k}.5\n" for k in range(40))}[VERB]
COMMAND = "dataset" if VERB == "ensemble" else VERB
FILE = {"import": "input.csv", "calibrate": "measured/dataset.yaml"}.get(VERB, "input.yaml")
OPTIONS = {"import": [], "fmu": [], "map": ["--ratios", "2", "--speeds", "1", "--up", "--load", "16.138 kg"]}.get(
    VERB, ["--threads", "1"]) + (["--time-limit", "1 us"] if VERB == "diagnose" else [])
TABLE = "time_s,current_mA,contraction_ratio\n" + "".join(
    f"{0.012 * k:.3f},{4 + 0.2 * k:.1f},{0.002 * k:.3f}\n" for k in range(40))
ERRORS = [errno.ENOSPC, errno.EIO, errno.EDQUOT]


def contents(folder):
    """Every file and empty folder below a folder, with its bytes."""
    found = {}
    for path, folders, files in os.walk(folder):
        if not folders and not files:
            found[os.path.relpath(path, folder)] = None
        for name in files:
            with open(os.path.join(path, name), "rb") as file:
                found[os.path.relpath(file.name, folder)] = file.read()
    return found


class Place:
    """A folder with an input, `out` in it, and beside it the bytes of an old and a new result."""

    def __init__(self, root):
        self.root, self.out, self.log = root, os.path.join(root, "out"), os.path.join(root, "log")
        self.saved = os.path.join(root, "saved")
        with open(os.path.join(root, "r.csv"), "w") as file:
            file.write(TABLE)
        if VERB == "calibrate":
            with open(os.path.join(root, "campaign.yaml"), "w") as file:
                file.write(LOADS_AND_SPEEDS)
            subprocess.run([PROGRAM, "dataset", "campaign.yaml", "--out", "measured"], cwd=root, capture_output=True, check=True)
        self.results = []
        for seed in (1, 2):
            self.seed(seed)
            self.expect(self.run(), 0)
            self.results.append(contents(self.out))
            if seed == 1:
                shutil.copytree(self.out, self.saved)
        self.old, self.new = self.results
        assert self.old != self.new and self.old.keys() == self.new.keys()
        self.back()

    def seed(self, seed):
        with open(os.path.join(self.root, FILE), "a" if VERB == "calibrate" else "w") as file:
            file.write(INPUT.format(seed=seed))

    def back(self):
        """The old result, and nothing else."""
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.copytree(self.saved, self.out)

    def run(self, **faults):
        if os.path.exists(self.log):
            os.remove(self.log)
        settings = {"LD_PRELOAD": LIBRARY, "FAULT_BELOW": self.out, "FAULT_LOG": self.log} if faults else {}
        settings.update({f"FAULT_{key.upper()}": str(value) for key, value in faults.items()})
        return subprocess.run([PROGRAM, COMMAND, FILE, "--out", "out/o"] + OPTIONS, cwd=self.root,
                              env=os.environ | settings, capture_output=True, text=True, timeout=60)

    def operations(self):
        return os.path.getsize(self.log)

    def letters(self):
        with open(self.log) as file:
            return file.read()

    def expect(self, said, *statuses):
        if said.returncode not in statuses:
            raise AssertionError(f"exit status {said.returncode}, not {statuses}\n{said.stderr}{self.tree()}")

    def tree(self):
        return "\n".join(sorted(contents(self.out))) + "\n"

    def expect_only(self, *allowed):
        found = contents(self.out)
        if found not in allowed:
            raise AssertionError("not what was expected:\n" + self.tree())

    def visible(self, places=("o", "o-truth")):
        """Each result that stands in its place."""
        return [{name: data for name, data in contents(self.out).items() if name.split("/")[0] == place}
                for place in places]

    def expect_whole(self):
        """In each place stands the old or the new result, whole."""
        for folder, old, new in zip(self.visible(), parts(self.old), parts(self.new)):
            if folder not in (old, new):
                raise AssertionError("neither old nor new: " + self.tree())


def parts(result):
    return [{name: data for name, data in result.items() if name.split("/")[0] == place}
            for place in ("o", "o-truth")]


def killed(place, n, total):
    place.back()
    place.expect(place.run(do="kill", at=n), -9)
    place.expect_whole()
    place.run(do="kill", at=1 + 37 * n % total)  # the next one too, while it puts things right or later
    place.expect_whole()
    place.expect(place.run(), 0)
    place.expect_only(place.new)


def failing(place, n, _, **more):
    place.back()
    said = place.run(do=ERRORS[n % 3], at=n, **more)
    place.expect(said, 0, 74)
    if said.returncode == 74:
        assert "mckibben: cannot write" in said.stderr, said.stderr
    place.expect_whole()
    place.expect(place.run(), 0)
    place.expect_only(place.new)


def full(place, n, total):
    failing(place, n, total, on=1)


def with_a_second(place, n, _):
    place.back()
    second = os.path.join(place.root, "second")
    command = shlex.join([PROGRAM, COMMAND, FILE, "--out", "out/o"] + OPTIONS) + f" > '{second}' 2>&1; echo $? >> '{second}'"
    place.expect(place.run(do="run", at=n, run=command), 0)
    with open(second) as file:
        lines = file.read().splitlines()
    held = any("it is being written by " in line for line in lines)
    if lines[-1] != ("74" if held else "0"):
        raise AssertionError("\n".join(lines))
    place.expect_only(place.new)
    return held


def without_exchange(place):
    """Old file systems and some of the network know no RENAME_EXCHANGE."""
    place.back()
    place.expect(place.run(do=errno.EINVAL, at=0), 0)
    place.expect_only(place.new)


def kept_aside(place, n, _):
    """What somebody put into the old result is set aside, whenever the program is killed."""
    place.back()
    with open(os.path.join(place.out, "o", "notes.txt"), "w") as file:
        file.write("mine")
    place.run(do="kill", at=n)
    place.expect(place.run(), 0)
    notes = [name for name in contents(place.out) if name.endswith("notes.txt")]
    assert notes == ["o.old-1/notes.txt"], notes
    old = {name.replace("o/", "o.old-1/", 1): data for name, data in parts(place.old)[0].items()}
    place.expect_only(place.new | old | {"o.old-1/notes.txt": b"mine"})


def main():
    with tempfile.TemporaryDirectory() as root:
        place = Place(os.path.realpath(root))
        place.expect(place.run(do="0", at=0), 0)
        letters = place.letters()
        one_file = VERB == "fmu"  # which takes its place by a rename
        assert ("r" if one_file else "x") in letters and "s" in letters, letters
        place.expect_only(place.new)
        tests = (killed, failing, full) if one_file else (killed, failing, full, with_a_second, kept_aside)
        if not one_file:
            without_exchange(place)
        held = 0
        chosen = range(1, len(letters) + 1) if EVERY else telling(letters)
        for n in chosen:
            where = f"{VERB}, operation {n} of {len(letters)} ({letters[n - 1]})"
            for test in tests:
                try:
                    held += test(place, n, len(letters)) or 0
                except AssertionError as wrong:
                    raise SystemExit(f"{test.__name__}, {where}: {wrong}") from None
        assert one_file or held > len(chosen) / 2, held
        print(f"{VERB}: {len(chosen)} of {len(letters)} operations {letters}, the second process refused at {held}")


main()
