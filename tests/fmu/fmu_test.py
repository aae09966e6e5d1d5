#!/usr/bin/env python3
"""FMUs, from outside: what `fmu` writes is taken apart, its description read as the standard says (FMI 2.0
section 2.2, 3.0 section 2.4), and its program run by an importer that knows nothing of ours.

usage: fmu_test.py PROGRAM IMPORTER
"""
import csv
import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

PROGRAM, IMPORTER = sys.argv[1:3]
RIG = """schema: mckibben-rig/1
gauge: {fitted: true, resolution: 1 mbar}
load_cell: {fitted: true, resolution: 0.1 N}
effects: {muscle_leak: {conductance: 2e-12 m3/(s.Pa)}, valve_hysteresis: {half_width: 0.05 bar}}
integrator: {tolerance: 1e-12}
"""
SCENARIO = """schema: mckibben-scenario/1
rig: {rig}
loads: [16.138 kg]
duration: 2.4 s
target: {{kind: minimum_jerk, start: 0.05, moves: []}}
controllers: [{{kind: sine_current, name: sine, low: 5 mA, high: 13 mA, period: 1.2 s}}]
"""


def run(*arguments, folder, status=0):
    done = subprocess.run([PROGRAM, *arguments], cwd=folder, text=True, capture_output=True)
    assert done.returncode == status, done.stderr
    return done


class Fmu:
    """One that was written and unpacked."""

    def __init__(self, folder, rig, version, *options):
        self.path, self.version = folder / f"{version}.fmu", version
        run("fmu", str(rig), "--fmi", version, "--out", str(self.path), *options, folder=folder)
        self.folder = folder / f"unpacked {version}"
        with zipfile.ZipFile(self.path) as archive:
            assert archive.testzip() is None
            archive.extractall(self.folder)
        self.description = ET.parse(self.folder / "modelDescription.xml").getroot()
        self.token = self.description.get("guid" if version == "2.0" else "instantiationToken")
        platform = "linux64" if version == "2.0" else "x86_64-linux"
        identifier = self.description.find("CoSimulation").get("modelIdentifier")
        self.library = self.folder / "binaries" / platform / f"{identifier}.so"
        self.variables = list(self.description.find("ModelVariables"))
        self.reference = {each.get("name"): int(each.get("valueReference")) for each in self.variables}

    def typed(self, variable):
        """The element that has unit, start, min and max, and its type."""
        return variable[0] if self.version == "2.0" else variable

    def answers(self, commands, token=None):
        resources = self.folder / "resources"
        resources = resources.as_uri() if self.version == "2.0" else f"{resources}/"
        done = subprocess.run([IMPORTER, self.library, self.version[0], token or self.token, resources], text=True,
                              input="\n".join(commands), capture_output=True, timeout=300)
        assert done.returncode == 0, done.stderr
        return done.stdout.splitlines()

    def ride(self, currents, outputs, before=(), instance=0, tick=0.012):
        """Commands of a ride under these currents; outputs are asked for at each tick."""
        def look():
            return [f"{instance} {'count' if name == 'counts' else 'get'} {self.reference[name]}" for name in outputs]
        commands = [f"{instance} {line}" for line in before]
        commands += [f"{instance} set {self.reference['current']} {currents[0]}", f"{instance} init 0",
                     f"{instance} start", *look()]
        for k, current in enumerate(currents[:-1]):
            commands += [f"{instance} set {self.reference['current']} {current}",
                         f"{instance} step {k * tick!r} {tick}", *look()]
        return commands


def table(folder, rig):
    (folder / "s.yaml").write_text(SCENARIO.format(rig=rig))
    run("run", "s.yaml", folder=folder)
    document = json.loads((folder / "out/s/run.json").read_text())
    with open(folder / "out/s" / document["runs"][0]["file"], newline="") as rows:
        return list(csv.DictReader(rows))


# As `run` calls them, and the factor from the FMU's SI.
COLUMNS = {"true_contraction_ratio": ("contraction_ratio", 1), "true_contraction_speed": ("contraction_speed_per_s", 1),
           "true_valve_pressure": ("valve_pressure_bar", 1e-5), "true_muscle_pressure": ("muscle_pressure_bar", 1e-5),
           "contraction_ratio_read": ("encoder_contraction_ratio", 1), "gauge_pressure": ("gauge_pressure_bar", 1e-5),
           "true_braid_force": ("braid_force_N", 1)}


class AnFmu(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="an fmu ")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.rig = self.folder / "rig.yaml"
        self.rig.write_text(RIG)

    def each(self, *options):
        return [Fmu(self.folder, self.rig, version, *options) for version in ("2.0", "3.0")]

    def test_is_as_the_standard_says(self):
        for fmu in self.each("--true-states"):
            two = fmu.version == "2.0"
            self.assertEqual(fmu.description.get("fmiVersion"), fmu.version)
            self.assertEqual([child.tag for child in fmu.description],
                             ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables",
                              "ModelStructure"])
            self.assertEqual(len(fmu.reference), len(fmu.variables), "names differ")
            self.assertEqual(len(set(fmu.reference.values())), len(fmu.variables), "references differ")
            units = {unit.get("name") for unit in fmu.description.find("UnitDefinitions")}
            outputs = []
            for index, variable in enumerate(fmu.variables, 1):
                typed, causality = fmu.typed(variable), variable.get("causality")
                self.assertIn(typed.tag, ("Real", "Integer") if two else ("Float64", "Int64"))
                if typed.get("unit"):
                    self.assertIn(typed.get("unit"), units)
                self.assertEqual(typed.get("start") is not None, causality in ("input", "parameter"))
                if causality in ("input", "parameter"):
                    self.assertLessEqual(float(typed.get("min")), float(typed.get("start")), variable.get("name"))
                    self.assertGreaterEqual(float(typed.get("max")), float(typed.get("start")), variable.get("name"))
                self.assertEqual(variable.get("initial"), {"parameter": "exact", "output": "calculated"}.get(causality))
                if causality == "output":
                    outputs.append(str(index) if two else variable.get("valueReference"))
                if typed.tag in ("Integer", "Int64"):
                    self.assertEqual(variable.get("variability"), "discrete")
            structure = fmu.description.find("ModelStructure")
            if two:
                self.assertEqual([child.tag for child in structure], ["Outputs", "InitialUnknowns"])
                for part in structure:
                    self.assertEqual([unknown.get("index") for unknown in part], outputs)
            else:
                for tag in ("Output", "InitialUnknown"):
                    self.assertEqual([unknown.get("valueReference") for unknown in structure.findall(tag)], outputs)

    def test_needs_nothing_but_libc_and_libm_and_shows_nothing_but_the_interface(self):
        for fmu in self.each():
            needed = subprocess.run(["readelf", "-d", fmu.library], text=True, capture_output=True, check=True).stdout
            self.assertEqual({line.split("[")[1].rstrip("]").split(".")[0] for line in needed.splitlines() if "NEEDED" in line}
                             - {"ld-linux-x86-64"}, {"libc", "libm"})
            shown = subprocess.run(["nm", "-D", "--defined-only", fmu.library], text=True, capture_output=True, check=True)
            self.assertEqual([line for line in shown.stdout.splitlines() if not line.split()[-1].startswith("fmi")], [])
            for source in ("CMakeLists.txt", "fmu.cmake", "LICENSE", "plant/plant.cpp", "sim/fmu/model/fmi2.cpp"):
                self.assertTrue((fmu.folder / "sources" / source).is_file(), source)

    def test_gives_the_numbers_of_run(self):
        rows = table(self.folder, "rig.yaml")
        currents = [float(row["current_mA"]) for row in rows]
        for fmu in self.each("--true-states"):
            load = f"set {fmu.reference['load']} 16.138"
            answers = iter(fmu.answers(fmu.ride(currents, COLUMNS, [load])))
            for k, row in enumerate(rows):
                for name, (column, factor) in COLUMNS.items():
                    expected, is_now = float(row[column]), float(next(answers)) * factor
                    self.assertAlmostEqual(is_now, expected, delta=1e-9 * max(1.0, abs(expected)), msg=f"{name} in row {k}")
            self.assertGreater(max(float(row["contraction_ratio"]) for row in rows), 0.1)

    def test_of_another_parameter_is_that_rig(self):
        (self.folder / "thick.yaml").write_text(RIG + "muscle: {rest_radius: 7.9 mm}\n")
        rows = table(self.folder, "thick.yaml")
        currents = [float(row["current_mA"]) for row in rows]
        for fmu in self.each("--true-states"):
            before = [f"set {fmu.reference['load']} 16.138", f"set {fmu.reference['muscle.rest_radius']} 0.0079"]
            last = fmu.answers(fmu.ride(currents, ["true_contraction_ratio"], before))[-1]
            self.assertAlmostEqual(float(last), float(rows[-1]["contraction_ratio"]), delta=1e-9)

    def test_goes_on_from_a_saved_state_to_the_same_bits_and_beside_others(self):
        for fmu in self.each("--true-states"):
            outputs = ["true_contraction_ratio", "true_muscle_pressure", "counts"]
            first = fmu.ride([5 + 0.1 * k for k in range(60)], outputs)
            on = [f"0 set {fmu.reference['current']} 12"]
            for k in range(59, 120):
                on += [f"0 step {k * 0.012!r} 0.012", *(f"0 {'count' if name == 'counts' else 'get'} {fmu.reference[name]}"
                                                      for name in outputs)]
            answers = fmu.answers([*first, "0 save", *on, "0 restore", *on])
            length = 61 * len(outputs)
            self.assertEqual(len(answers), 60 * len(outputs) + 2 * length)
            self.assertEqual(answers[-length:], answers[-2 * length:-length])
            other = fmu.ride([14 - 0.1 * k for k in range(60)], outputs, instance=1)
            both = fmu.answers([line for lines in zip(first, other) for line in lines])
            self.assertEqual(both, [line for lines in zip(fmu.answers(first), fmu.answers(other)) for line in lines])

    def test_again_from_the_start_is_the_same(self):
        for fmu in self.each():
            ride = fmu.ride([5, 9, 12, 12, 12], ["counts", "gauge_pressure"])
            answers = fmu.answers([*ride, "0 reset", *ride])
            self.assertEqual(answers[:10], answers[10:])

    def test_another_load_hangs_from_the_next_step_on(self):
        for fmu in self.each("--true-states"):
            ride = fmu.ride([10] * 200, ["true_contraction_ratio"])
            heavier = [line for k, line in enumerate(ride)]
            heavier[-201] = heavier[-201] + f"\n0 set {fmu.reference['load']} 20"
            self.assertLess(float(fmu.answers(heavier)[-1]), float(fmu.answers(ride)[-1]) - 0.01)

    def test_says_what_is_wrong(self):
        for fmu in self.each():
            radius = fmu.reference["muscle.rest_radius"]
            self.assertEqual(fmu.answers([f"0 set {radius} 7.5"])[-1], "failed")
            self.assertIn("muscle.rest_radius = 7.5", fmu.answers([f"0 set {radius} 7.5"])[0])
            late = fmu.answers(["0 init 0", "0 start", f"0 set {radius} 0.0076"])
            self.assertEqual(late, ["muscle.rest_radius: parameters are set before the start", "failed"])
            self.assertEqual(fmu.answers(["0 init 0", "0 start", "0 step 0.5 0.012"])[-1], "failed")
            self.assertEqual(fmu.answers(["0 step 0 0.012"])[-1], "failed")
            self.assertEqual(fmu.answers(["0 set 999999 1"])[-1], "failed")
            self.assertEqual(fmu.answers(["0 init 0"], token="{another}")[-1], "failed")
            zero, span = fmu.reference["valve.zero_current"], fmu.reference["valve.span_current"]
            broken = fmu.answers([f"0 set {zero} 12", f"0 set {span} 8", "0 init 0", "0 start"])
            self.assertEqual(broken, ["valve.span_current: must be above zero_current", "failed"])

    def test_of_a_pair_has_two_currents(self):
        fmu = Fmu(self.folder, "thesis_pair", "2.0", "--true-states")
        self.assertNotIn("load", fmu.reference)
        one, two, angle = (fmu.reference[name] for name in ("current_1", "current_2", "angle_read"))
        steps = [f"0 step {k * 0.012!r} 0.012" for k in range(100)]
        answers = fmu.answers([f"0 set {one} 12", f"0 set {two} 8", "0 init 0", "0 start", f"0 set {one} 16", *steps,
                               f"0 get {angle}", f"0 set {one} 6", f"0 set {two} 14",
                               *(line.replace("step", "step") for line in
                                 (f"0 step {k * 0.012!r} 0.012" for k in range(100, 250))), f"0 get {angle}"])
        self.assertGreater(float(answers[0]), 0.1)
        self.assertLess(float(answers[1]), 0.0)

    def test_of_a_rig_that_cannot_be_one_is_refused(self):
        (self.folder / "held.yaml").write_text("schema: mckibben-rig/1\nmechanics: {kind: held_length}\n")
        self.assertIn("held_length", run("fmu", "held.yaml", folder=self.folder, status=65).stderr)
        self.assertFalse((self.folder / "held.fmu").exists())

    def test_is_the_same_file_each_time(self):
        one = Fmu(self.folder, self.rig, "2.0").path.read_bytes()
        (self.folder / "2.0.fmu").unlink()
        self.assertEqual(one, Fmu(self.folder, self.rig, "2.0").path.read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
