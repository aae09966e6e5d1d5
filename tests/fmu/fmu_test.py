#!/usr/bin/env python3
"""FMUs, from outside: what `fmu` writes is taken apart, its description read as the standard says (FMI 2.0
section 2.2, 3.0 section 2.4), and its program run by an importer that knows nothing of ours.

usage: fmu_test.py PROGRAM IMPORTER
"""
import copy
import csv
import json
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

import standard
from unpacked import Fmu, run

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
LAW = """effects:
  hypotheses:
    - name: cord_creep
      sentence: the cord stretches slowly under the load
      adds: force
      law: "-k * (x - q)"
      memories: {q: "(x - q) / tau"}
      parameters:
        k: {unit: N/m, typical: 300, range: [0, 5000], value: 400}
        tau: {unit: s, typical: 3, range: [0.2, 60], value: 0.5}
"""
FALLS = """schema: mckibben-rig/1
muscle: {stop_stiffness: 1e5 N/m}
effects: {residual_law: {terms: [{of: m g, coefficient: -800 N}]}}
"""  # the threads bear a load of 48 kg, but not with what the effect adds
HELD = """schema: mckibben-rig/1
mechanics: {kind: held_length}
integrator: {tolerance: 1e-12}
"""


def table(folder, rig):
    (folder / "s.yaml").write_text(SCENARIO.format(rig=rig))
    run("run", "s.yaml", folder=folder)
    document = json.loads((folder / "out/s/run.json").read_text())
    with open(folder / "out/s" / document["runs"][0]["file"], newline="") as rows:
        return list(csv.DictReader(rows))


# As `run` calls them: with the unit.
COLUMNS = {"contraction_ratio": "contraction_ratio", "contraction_speed": "contraction_speed_per_s",
           "valve_pressure": "valve_pressure_bar", "muscle_pressure": "muscle_pressure_bar",
           "encoder_contraction_ratio": "encoder_contraction_ratio", "gauge_pressure": "gauge_pressure_bar",
           "braid_force": "braid_force_N"}


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
        terms = "effects: {residual_law: {terms: [{of: '1', coefficient: 5 N}, {of: sgn v, coefficient: 1 N}]}}\n"
        for text in (RIG, "schema: mckibben-rig/1\n" + LAW, HELD, "schema: mckibben-rig/1\nbase: thesis_pair\n", "schema: mckibben-rig/1\n" + terms):
            self.rig.write_text(text)
            for fmu in self.each("--true-states"):
                self.assertEqual(standard.complaints(fmu.description), [])
        build = ET.parse(fmu.folder / "sources/buildDescription.xml").getroot()
        self.assertEqual(standard.shape(build, standard.BUILD), [])
        for name in build.iter("SourceFile"):
            self.assertTrue((fmu.folder / "sources" / name.get("name")).is_file(), name.get("name"))

    def test_what_the_standard_forbids_would_be_seen(self):
        for fmu in self.each():
            two = fmu.version == "2.0"
            def spoilt(spoil):
                root = copy.deepcopy(fmu.description)
                spoil(root)
                return " ".join(standard.complaints(root))
            def variable(root, name):
                return next(one for one in root.find("ModelVariables") if one.get("name") == name)
            structure = "ModelStructure/Outputs" if two else "ModelStructure"
            for spoil, said in (
                    (lambda root: root.set("guide", "x"), "unknown attribute guide"),
                    (lambda root: root.attrib.pop("modelName"), "modelName is missing"),
                    (lambda root: root.remove(root.find("ModelStructure")), "are not ["),
                    (lambda root: variable(root, "load").set("valueReference", "-1"), "valueReference = -1"),
                    (lambda root: variable(root, "load").set("valueReference", "1"), "valueReference 1 is there twice"),
                    (lambda root: variable(root, "load").set("name", "current"), "name current is there twice"),
                    (lambda root: variable(root, "load").set("name", "1.load"), "structured convention"),
                    (lambda root: variable(root, "load").set("causality", "parameter"), "parameter cannot be continuous"),
                    (lambda root: variable(root, "counts").set("variability", "continuous"), "only what is real"),
                    (lambda root: fmu.typed(variable(root, "load")).attrib.pop("start"), "start is missing"),
                    (lambda root: fmu.typed(variable(root, "load")).set("max", "1"), "do not ascend"),
                    (lambda root: fmu.typed(variable(root, "load")).set("unit", "stone"), "stone is not defined"),
                    (lambda root: root.find(structure).remove(root.find(structure)[0]), "are not all outputs")):
                self.assertIn(said, spoilt(spoil))

    def test_needs_nothing_but_libc_and_libm_and_shows_nothing_but_the_interface(self):
        for fmu in self.each():
            needed = subprocess.run(["readelf", "-d", fmu.library], text=True, capture_output=True, check=True).stdout
            self.assertEqual({line.split("[")[1].rstrip("]").split(".")[0] for line in needed.splitlines() if "NEEDED" in line}
                             - {"ld-linux-x86-64", "libasan", "libubsan"}, {"libc", "libm"})
            shown = subprocess.run(["nm", "-D", "--defined-only", fmu.library], text=True, capture_output=True, check=True)
            self.assertEqual([line for line in shown.stdout.splitlines() if not line.split()[-1].startswith("fmi")], [])
            for source in ("CMakeLists.txt", "LICENSE"):
                self.assertTrue((fmu.folder / "sources" / source).is_file(), source)

    def ridden(self, rows, fmu, before=(), columns=COLUMNS):
        """What an FMU with the thesis's load shows under the currents of these rows of `run`, and what they have."""
        ride = fmu.ride([float(row["current_mA"]) for row in rows], columns,
                        [f"set {fmu.reference['load']} 16.138", *before])
        expected = [float(row[column]) for row in rows for column in columns.values()]
        return list(zip(map(float, fmu.answers(ride)), expected, strict=True))

    def agrees(self, *ride, **options):
        for k, (is_now, expected) in enumerate(self.ridden(*ride, **options)):
            self.assertAlmostEqual(is_now, expected, delta=1e-9 * max(1.0, abs(expected)), msg=k)

    def test_gives_the_numbers_of_run_and_of_another_parameter_of_that_rig(self):
        (self.folder / "thick.yaml").write_text(RIG + "muscle: {rest_radius: 7.9 mm}\n")
        rows, of_thick = table(self.folder, "rig.yaml"), table(self.folder, "thick.yaml")
        self.assertGreater(max(float(row["contraction_ratio"]) for row in rows), 0.1)
        for fmu in self.each("--true-states"):
            self.agrees(rows, fmu)
            self.agrees(of_thick, fmu, [f"set {fmu.reference['muscle.rest_radius']} 0.0079"])

    def test_is_the_same_beside_others(self):
        for fmu in self.each("--true-states"):
            outputs = ["contraction_ratio", "muscle_pressure", "counts"]
            first = fmu.ride([5 + 0.1 * k for k in range(60)], outputs)
            other = fmu.ride([14 - 0.1 * k for k in range(60)], outputs, instance=1)
            both = fmu.answers([line for lines in zip(first, other) for line in lines])
            self.assertEqual(both, [line for lines in zip(fmu.answers(first), fmu.answers(other)) for line in lines])

    def test_another_load_hangs_from_the_next_step_on(self):
        for fmu in self.each("--true-states"):
            ride = fmu.ride([10] * 200, ["contraction_ratio"])
            heavier = list(ride)
            heavier[-201] = heavier[-201] + f"\n0 set {fmu.reference['load']} 20"
            self.assertLess(float(fmu.answers(heavier)[-1]), float(fmu.answers(ride)[-1]) - 0.01)

    def test_a_force_from_outside_acts_as_a_load_does(self):
        for fmu in self.each("--true-states"):
            alone, pulled, heavier = (
                fmu.moved("contraction_ratio", ({"load": kg, "current": 10, "joint_force": force}, 300))[-1]
                for kg, force in ((16, 0), (16, 2 * 9.80665), (18, 0)))
            self.assertLess(pulled, alone - 0.005)
            self.assertAlmostEqual(pulled, heavier, delta=0.2 * (alone - pulled))  # another mass swings in differently

    def test_says_what_is_wrong(self):
        for fmu in self.each():
            radius = fmu.reference["muscle.rest_radius"]
            said, failed = fmu.answers([f"0 set {radius} 7.5"])
            self.assertIn("muscle.rest_radius = 7.5", said)
            self.assertEqual(failed, "failed")
            late = fmu.answers(["0 init 0", "0 start", f"0 set {radius} 0.0076"])
            self.assertEqual(late, ["muscle.rest_radius: parameters are set before the start", "failed"])
            self.assertEqual(fmu.answers(["0 init 0", "0 start", "0 step 0.5 0.012"])[-1], "failed")
            self.assertEqual(fmu.answers(["0 set 999999 1"])[-1], "failed")
            self.assertEqual(fmu.answers(["0 init 0"], token="{another}")[-1], "failed")
            zero, span = fmu.reference["valve.zero_command"], fmu.reference["valve.span_command"]
            broken = fmu.answers([f"0 set {zero} 12", f"0 set {span} 8", "0 init 0", "0 start"])
            self.assertEqual(broken, ["valve.span_command: must be above zero_command", "failed"])

    def test_refuses_loads_that_the_threads_cannot_bear(self):
        heavy = "load = 200 kg: the taut threads of this muscle bear 147 kg"
        for fmu in self.each("--true-states"):
            load, height = fmu.reference["load"], fmu.reference["contraction_ratio"]
            for early in ("0 start", f"0 get {height}"):
                said, failed = fmu.answers([f"0 set {load} 200", "0 init 0", early])
                self.assertTrue(said.startswith(heavy) and failed == "failed", said)
            stop = fmu.reference["muscle.stop_stiffness"]  # that bears more
            self.assertEqual(fmu.answers([f"0 set {load} 200", f"0 set {stop} 1e7", "0 init 0", "0 start"]), [])
            ride = fmu.ride([10] * 20, ["contraction_ratio"])
            said = fmu.answers([*ride[:34], f"0 set {load} 200", *ride[34:]])
            self.assertTrue(said[11].startswith(heavy), said)
            self.assertEqual(said[:11] + said[13:], fmu.answers(ride), "the last load goes on to hang")
            no_mass = fmu.answers([f"0 set {load} 0", f"0 set {fmu.reference['joint.load_offset']} -1", "0 init 0", "0 start"])
            self.assertEqual(no_mass, ["load = 0 kg: there must be some mass", "failed"])

    def test_begins_with_a_load_of_its_muscle(self):
        fmu = Fmu(self.folder, "festo_dmsp_5", "2.0", "--true-states")
        load = next(each for each in fmu.variables if each.get("name") == "load")
        self.assertLess(float(fmu.typed(load).get("start")), 5.0)
        low, high = fmu.moved("contraction_ratio", ({}, 0), ({"command" if "command" in fmu.reference else "current": 20}, 200))
        self.assertGreater(high - low, 0.05)

    def test_refuses_calls_out_of_order_and_they_change_nothing(self):
        currents = [5 + 0.1 * k for k in range(40)]
        self.rig.write_text(FALLS)
        for fmu in self.each("--true-states"):
            load, height = fmu.reference["load"], fmu.reference["contraction_ratio"]
            ride = fmu.ride(currents, ["contraction_ratio"])
            alone = fmu.answers(ride)
            step, late = "0 step 0 0.012", f"0 step {39 * 0.012!r} 0.012"
            for early in ("0 start", "0 end", step, f"0 get {height}"):
                self.assertEqual(fmu.answers([early])[-1], "failed", early)
            self.assertEqual(fmu.answers(["0 init 0", "0 end"])[-1], "failed")
            self.assertEqual(fmu.answers(["0 init nan"])[-1], "failed")
            for early in ("0 restore", "0 write state"):
                self.assertEqual(fmu.answers([early]), ["no state was saved", "failed"])
            # In mid-run.
            again = fmu.answers([*ride[:60], "0 init 100", "0 start", *ride[60:]])
            self.assertEqual(again.count("failed"), 2)
            self.assertEqual([said for said in again if said in alone], alone)
            # After an initialisation that failed, there is nothing but a reset.
            stuck = [f"0 set {load} 1e6", "0 init 0", "0 start"]
            for then in ("0 start", step, f"0 get {height}", f"0 set {load} 10", "0 init 0"):
                self.assertEqual(fmu.answers([*stuck, then]).count("failed"), 2, then)
            self.assertEqual(fmu.answers([*stuck, "0 reset", *ride])[-len(alone):], alone)
            # After a step that failed there is a state that was saved, too. A fall ends at the braid's end.
            cut = 4 + 3 * 20
            torn = [*ride[:cut], "0 save", f"0 set {load} 48", *fmu.on(range(20, 100))]
            said = fmu.answers([*torn, f"0 set {load} 10", "0 init 0", "0 start", f"0 get {height}", "0 restore", *ride[cut:]])
            fallen = [answer for answer in said[21:] if answer not in alone]
            self.assertIn("a step before the initialisation has ended, or after a failure or the end", fallen)
            self.assertEqual(fallen[-7:-1:2], ["nothing is set after a failure or the end",
                                               "the experiment is set up before the initialisation",
                                               "it is not being initialised"])
            self.assertLess(float(fallen[-1]), 0.0)
            self.assertEqual(said[:21] + said[-19:], alone)
            # After the end.
            for then in (late, f"0 set {load} 10", "0 init 0", "0 start", "0 end"):
                self.assertEqual(fmu.answers([*ride, "0 end", then])[-1], "failed", then)
            self.assertEqual(fmu.answers([*ride, "0 end", f"0 get {height}"])[-1], alone[-1])
            self.assertEqual(fmu.answers([*ride, "0 end", "0 reset", *ride]), alone + alone)

    def test_says_no_number_with_a_comma_whatever_the_locale(self):
        locales = self.folder / "locales"
        locales.mkdir()
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", locales / "de_DE.UTF-8"], check=True)
        comma = {"LOCPATH": str(locales), "LC_ALL": "de_DE.UTF-8"}
        for fmu in self.each("--true-states"):
            ride = fmu.ride([5 + 0.1 * k for k in range(20)], ["contraction_ratio"])
            bad = f"0 set {fmu.reference['muscle.rest_radius']} 7.5"
            self.assertEqual(fmu.answers([*ride, bad], locale=comma), fmu.answers([*ride, bad]))

    def test_of_a_rig_in_volts_takes_volts(self):
        self.rig.write_text("schema: mckibben-rig/1\nvalve: {zero_command: -5 V, span_command: 5 V, zero_pressure: 0.5 bar, span_pressure: 5 bar}\n")
        for fmu in self.each():
            command = next(each for each in fmu.variables if each.get("name") == "command")
            said = fmu.typed(command)
            self.assertEqual([said.get(key) for key in ("unit", "start", "min", "max")], ["V", "-5", "-5", "5"])
            self.assertNotIn("current", fmu.reference)
            zero = next(each for each in fmu.variables if each.get("name") == "valve.zero_command")
            self.assertEqual(fmu.typed(zero).get("unit"), "V")
            self.assertGreater(fmu.moved("encoder_contraction_ratio", ({}, 0), ({"command": 3}, 100))[-1], 0.05)

    def test_of_a_pair_has_two_currents(self):
        fmu = Fmu(self.folder, "thesis_pair", "2.0", "--true-states")
        self.assertNotIn("load", fmu.reference)
        _, up, down = fmu.moved("encoder_angle", ({"current_1": 12, "current_2": 8}, 0), ({"current_1": 16}, 100),
                                ({"current_1": 6, "current_2": 14}, 150))
        self.assertGreater(up, 0.1)
        self.assertLess(down, 0.0)
        still, turned = fmu.moved("encoder_angle", ({"current_1": 12, "current_2": 12}, 0), ({"joint_torque": 4}, 200))
        self.assertGreater(turned, still + 0.01)

    def test_of_a_lever_has_an_angle_and_a_load(self):
        self.rig.write_text("schema: mckibben-rig/1\nmechanics:\n  kind: lever\n"
                            "  arms: [{angle: -10 deg, arm: 40 mm}, {angle: 130 deg, arm: 45 mm}]\n")
        for fmu in self.each("--true-states"):
            self.assertNotIn("encoder_contraction_ratio", fmu.reference)
            self.assertIn("mechanics.arms[1].arm", fmu.reference)
            light, heavy = (fmu.moved("encoder_angle", ({"load": kg, "current": 8}, 0), ({"current": 15}, 200))[-1]
                            for kg in (0.5, 3.0))
            self.assertGreater(heavy, 0.2)
            self.assertGreater(light, heavy)

    def test_goes_on_from_a_saved_state_to_the_same_bits_here_and_as_bytes_in_another_program(self):
        late = "  reading_delay: {time: 20 ms}\n  command_delay: {time: 30 ms}\n"
        plays = "  muscle_leak: {conductance: 2e-12 m3/(s.Pa)}\n  valve_hysteresis: {half_width: 0.05 bar}\n"
        self.rig.write_text("schema: mckibben-rig/1\n" + LAW + late + plays)
        outputs = ["contraction_ratio", "muscle_pressure", "counts"]
        for fmu in self.each("--true-states"):
            thick = f"set {fmu.reference['muscle.rest_radius']} 0.0079"
            begin = fmu.ride([5 + 0.1 * k for k in range(60)], outputs, [thick])
            on = [f"0 set {fmu.reference['current']} 12", *fmu.on(range(59, 90), outputs)]
            answers = fmu.answers([*begin, "0 save", "0 write state", *on, "0 restore", *on])[60 * len(outputs):]
            first = answers[:len(answers) // 2]
            self.assertEqual(answers, first + first)
            self.assertEqual(fmu.answers(["0 read state", "0 restore", *on]), first)
            self.assertEqual(fmu.answers(["0 read state", "0 restore", "0 save", "0 write again", "0 read again", "0 restore",
                                          *on]), first)
            state = (fmu.folder / "state").read_bytes()
            spoilt = bytearray(state)
            spoilt[len(state) // 2] ^= 1
            for wrong in (spoilt, state[:-8], state + b"x", b""):
                (fmu.folder / "wrong").write_bytes(wrong)
                self.assertEqual(fmu.answers(["0 read wrong"]), ["these bytes are not those that were written", "failed"])
        other = Fmu(self.folder, "thesis", fmu.version)
        (other.folder / "state").write_bytes(state)
        self.assertIn("another FMU", other.answers(["0 read state"])[0])

    def test_carries_laws_of_its_users(self):
        self.rig.write_text("schema: mckibben-rig/1\nintegrator: {tolerance: 1e-12}\n" + LAW)
        rows = table(self.folder, "rig.yaml")
        for fmu in self.each("--true-states"):
            size = fmu.reference["effects.hypotheses.cord_creep.k"]
            height = {"contraction_ratio": "contraction_ratio"}
            self.agrees(rows, fmu, columns=height)
            without = self.ridden(rows, fmu, [f"set {size} 0"], height)
            self.assertGreater(max(abs(is_now - with_it) for is_now, with_it in without), 1e-3)
            self.assertIn("outside its range", fmu.answers([f"0 set {size} 6000"])[0])

    def test_of_a_held_muscle_takes_a_length_and_gives_a_force(self):
        self.rig.write_text(HELD)
        # Up, held, and down, under currents that the DAC has; the current jumps while the length is held.
        ticks = range(150)
        lengths = [0.28 - 5e-4 * min(k, 60) + 4e-4 * max(k - 100, 0) for k in ticks]
        currents = [10.0 if k < 80 else 15.0 for k in ticks]
        (self.folder / "moving.csv").write_text("time_s,mA,m,N\n" + "".join(
            f"{k * 0.012!r},{current!r},{1 - length / 0.3!r},1\n" for k, current, length in zip(ticks, currents, lengths)))
        (self.folder / "dataset.yaml").write_text(
            "schema: mckibben-dataset/1\nrig: rig.yaml\ncolumns:\n  time: {column: time_s, unit: s}\n"
            "  command: {column: mA, unit: mA}\n  contraction: {column: m, unit: 1, as: input}\n"
            "  force: {column: N, unit: N}\nruns: [{id: moving, file: moving.csv}]\n")
        run("replay", ".", "--out", "replayed", folder=self.folder)
        with open(self.folder / "replayed/moving.csv", newline="") as rows:
            rows = list(csv.DictReader(rows))
        for fmu in self.each():
            self.assertNotIn("load", fmu.reference)
            current, length, force = (fmu.reference[name] for name in ("current", "length", "cell_force"))
            commands = [f"0 set {current} {currents[0]}", f"0 set {length} {lengths[0]}", "0 init 0", "0 start",
                        f"0 get {force}"]
            for k in ticks[:-1]:
                commands += [f"0 set {current} {currents[k]!r}", f"0 set {length} {lengths[k + 1]!r}",
                             f"0 step {k * 0.012!r} 0.012", f"0 get {force}"]
            answers = [float(answer) for answer in fmu.answers(commands)]
            # A row has the friction of the way that follows; an FMU shows what has been. Where both are alike:
            for k, (row, is_now) in enumerate(zip(rows, answers, strict=True)):
                if k not in (0, 60, 80, 81, 100):
                    self.assertAlmostEqual(is_now, float(row["force_N"]), delta=1e-6, msg=k)
            self.assertGreater(max(answers) - min(answers), 100)
            self.assertIn("length = 0.9", fmu.answers([f"0 set {length} 0.9", "0 init 0", "0 start"])[0])
            self.assertEqual(fmu.answers([f"0 set {length} 0.9", "0 init 0", "0 start", "0 start"]).count("failed"), 2)

    def test_its_sources_are_all_that_their_cmakelists_needs(self):
        """All of them take minutes: one file is compiled, which includes most others, and the list is looked over."""
        fmu, build = self.each()[1], self.folder / "built"
        one = "CMakeFiles/mckibben_fmu.dir/sim/fmu/model/slave.cpp.o"
        for command in (["cmake", "-S", fmu.folder / "sources", "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                         "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"], ["ninja", "-C", build, one]):
            done = subprocess.run(command, text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        compiled = {Path(each["file"]).relative_to(fmu.folder / "sources")
                    for each in json.loads((build / "compile_commands.json").read_text())}
        listed = ET.parse(fmu.folder / "sources/buildDescription.xml").getroot().iter("SourceFile")
        self.assertEqual(compiled, {Path(each.get("name")) for each in listed})
        for file in (fmu.folder / "sources").rglob("*.?pp"):
            for needed in re.findall(r"#include <((?:plant|sim)/[^>]+)>", file.read_text()):
                self.assertTrue((fmu.folder / "sources" / needed).is_file(), f"{file} includes {needed}")

    def test_is_the_same_file_each_time(self):
        one = Fmu(self.folder, self.rig, "2.0").path.read_bytes()
        (self.folder / "2.0.fmu").unlink()
        self.assertEqual(one, Fmu(self.folder, self.rig, "2.0").path.read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
