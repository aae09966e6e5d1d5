"""The same measurements in every format that is read, written here or by scipy: replayed, they must all give
what the CSV gives, to the bit where the file holds every bit.

    input_test.py PROGRAM     works in a folder of its own
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy
import scipy.io

PROGRAM = sys.argv.pop(1)
CAMPAIGN = """schema: mckibben-campaign/1
rig: {gauge: {fitted: true}}
loads: [11.138 kg, 23.406 kg]
currents: [{duration: 1.8 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}]
noise: {encoder_jitter: 1e-4, gauge: 4 mbar}
"""
PER_COUNT = 2 * math.pi * 0.030 / (720 * 2) / 0.300
NAMES = ["current_mA", "contraction_ratio", "muscle_pressure_bar"]


def run(folder, *arguments, status=0):
    done = subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done


def numbers(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


class Formats(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        (cls.folder / "c.yaml").write_text(CAMPAIGN)
        run(cls.folder, "dataset", "c.yaml")
        cls.data = cls.folder / "out/c"
        cls.loads = {"m1_c01": "11.138 kg", "m2_c01": "23.406 kg"}
        cls.tables = {run_id: numbers(cls.data / f"{run_id}.csv") for run_id in cls.loads}
        cls.expected = cls.replay(cls.data)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def replay(cls, folder):
        said = run(cls.folder, "replay", str(folder), "--out", str(folder) + "-replay", "--json")
        return json.loads(said.stdout)["runs"]

    def results(self, ending, write, columns="", extra=""):
        """Replays the runs as `write(path, table)` writes them."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        (folder / "rig.yaml").write_text((self.data / "rig.yaml").read_text())
        text = f"schema: mckibben-dataset/1\nrig: rig.yaml\n{columns}\nruns:\n"
        for run_id, load in self.loads.items():
            write(folder / f"{run_id}{ending}", self.tables[run_id])
            text += f"  - {{id: {run_id}, file: {run_id}{ending}, load: {load}{extra}}}\n"
        (folder / "dataset.yaml").write_text(text)
        assert "ok" in run(folder, "check", "dataset.yaml").stdout
        return self.replay(folder)

    def same(self, *arguments, **more):
        self.assertEqual(self.results(*arguments, **more), self.expected)

    def near(self, *arguments, **more):
        for found, wanted in zip(self.results(*arguments, **more), self.expected):
            for key in ("rmse", "largest_error", "mean_error", "pressure_rmse_bar"):
                self.assertAlmostEqual(found[key], wanted[key], delta=1e-12, msg=key)

    # ---- LabVIEW

    def lvm(self, sign=".", separator="\t", x="One", segments=1, remark="", says_sign=True):
        """A writer of .lvm as LabVIEW writes it."""
        join = separator.join

        def write(path, table):
            text = lambda value: repr(value).replace(".", sign)
            named = {"\t": "Tab", ",": "Comma"}[separator]
            lines = ["LabVIEW Measurement", join(["Writer_Version", "2"]), join(["Reader_Version", "2"]),
                     join(["Separator", named]), *([join(["Decimal_Separator", sign])] if says_sign else []),
                     join(["Multi_Headings", "Yes"]), join(["X_Columns", x]), join(["Time_Pref", "Relative"]),
                     join(["Operator", "Müller"]), join(["Date", "2026/01/31"]), join(["Time", "12:00:00" + sign + "5"]),
                     "***End_of_Header***", separator]
            time, channels = table["time_s"], [table[name] for name in NAMES]
            count = len(channels)
            whole = len(time)
            for part in range(segments):
                begin, end = part * whole // segments, (part + 1) * whole // segments
                lines += [join(["Channels", str(count)]), join(["Samples", *["7"] * count]),
                          join(["X_Dimension", *["Time"] * count]),
                          join(["X0", *[text(time[begin])] * count]), join(["Delta_X", *[text(0.012)] * count]),
                          "***Start_Special***", "anything\tgoes", "***End_Special***", "***End_of_Header***"]
                if x == "Multi":
                    lines.append(join([cell for name in NAMES for cell in ("X_Value", name)] + ["Comment"]))
                else:
                    lines.append(join(["X_Value", *NAMES, "Comment"]))
                for k in range(begin, end):
                    at, row = text(time[k]), [text(column[k]) for column in channels]
                    if x == "Multi":
                        row = [cell for value in row for cell in (at, value)]
                    else:
                        row = ["" if x == "No" else at, *row]
                    lines.append(join(row + ([remark] if remark and k % 3 == 0 else [])))
                lines.append("")
            path.write_bytes("\r\n".join(lines).encode("latin-1"))

        return write

    def test_lvm(self):
        self.same(".lvm", self.lvm())

    def test_lvm_with_decimal_comma_remarks_and_the_ending_in_capitals(self):
        self.same(".LVM", self.lvm(sign=",", remark="ok, so far"))

    def test_lvm_of_version_1_with_decimal_comma(self):
        self.same(".lvm", self.lvm(sign=",", says_sign=False))
        self.same(".lvm", self.lvm(sign=",", says_sign=False, x="No"))

    def test_lvm_with_commas_between(self):
        self.same(".lvm", self.lvm(separator=","))

    def test_lvm_without_x_column(self):
        self.same(".lvm", self.lvm(x="No", sign=","))

    def test_lvm_with_many_x_columns(self):
        self.same(".lvm", self.lvm(x="Multi"))

    def test_lvm_in_segments(self):
        for x in ("One", "No", "Multi"):
            self.same(".lvm", self.lvm(x=x, segments=4))

    def test_lvm_by_columns_numbers(self):
        self.same(".lvm", self.lvm(), columns="columns: {current: {column: 2, unit: mA}, contraction: {column: 3, unit: 1}, "
                                              "time: {column: X_Value, unit: s}}")

    def test_one_segment_of_an_lvm(self):
        def twice(path, table):
            self.lvm()(path, {name: [0.0] * 5 for name in table})
            first = path.read_bytes()
            self.lvm()(path, table)
            path.write_bytes(first + path.read_bytes())

        self.same(".lvm", twice, extra=", segment: 2")

    # ---- numbers without headings

    def ascii(self, columns, separator=" ", sign=".", end="\n", head=""):
        def write(path, table):
            rows = zip(*[[scale(value) for value in table[name]] for name, scale in columns])
            path.write_text(head + "".join(separator.join(repr(v).replace(".", sign) for v in row) + end for row in rows))

        return write

    def test_the_thesis_files(self):
        def copy(path, table):
            path.write_text((self.data / "thesis" / path.name).read_text())

        gauge = [{**run, "pressure_rmse_bar": None, "gaps": run["gaps"][:1]} for run in self.expected]
        found = self.results(".txt", copy, columns="columns: {rows_are_ticks: true, current: {column: 1, unit: mA}, "
                                                   "contraction: {column: 2, unit: 1}}")
        self.assertEqual(found, gauge)

    def test_ascii_with_time_decimal_comma_and_other_units(self):
        columns = [("time_s", lambda v: v * 1000), ("contraction_ratio", lambda v: round(v / PER_COUNT)),
                   ("current_mA", lambda v: v), ("muscle_pressure_bar", lambda v: v)]
        yaml = ("columns:\n  time: {column: 1, unit: ms}\n  contraction: {column: 2, unit: count}\n"
                "  current: {column: 3, unit: mA}\n  muscle_pressure: {column: 4, unit: bar}\n")
        self.near(".dat", self.ascii(columns, separator="\t", sign=",", end=" \r\n"), columns=yaml)
        self.near(".asc", self.ascii(columns, separator=" ; ", head="% made by hand\n# so\n"), columns=yaml)

    def test_ascii_heights_of_every_kind(self):
        kinds = {"deg": lambda v: math.degrees(v * 0.300 / 0.030), "rad": lambda v: v * 0.300 / 0.030,
                 "mm": lambda v: v * 300, "%": lambda v: v * 100, "cm": lambda v: v * 30}
        for unit, scale in kinds.items():
            columns = [(name, lambda v: v) for name in ("time_s", "current_mA", "muscle_pressure_bar")]
            columns.append(("contraction_ratio", scale))
            self.near(".txt", self.ascii(columns),
                      columns="columns: {time: {column: 1, unit: s}, current: {column: 2, unit: mA}, muscle_pressure: "
                              f"{{column: 3, unit: bar}}, contraction: {{column: 4, unit: '{unit}'}}}}")

    def test_zero_and_factor(self):
        columns = [("time_s", lambda v: v), ("current_mA", lambda v: v / 1000), ("contraction_ratio", lambda v: 50 - 300 * v),
                   ("muscle_pressure_bar", lambda v: 0.5 + v / 2)]
        self.near(".txt", self.ascii(columns),
                  columns="columns:\n  time: {column: 1, unit: s}\n  current: {column: 2, unit: A}\n"
                          "  contraction: {column: 3, unit: mm, zero: 50, factor: -1}\n"
                          "  muscle_pressure: {column: 4, unit: bar, zero: 0.5, factor: 2}\n")

    # ---- MATLAB

    def mat(self, shape, **how):
        return lambda path, table: scipy.io.savemat(path, shape({k: numpy.array(v) for k, v in table.items()}), **how)

    def test_mat(self):
        for how in ({}, {"do_compression": True}, {"oned_as": "column"}):
            self.same(".mat", self.mat(lambda table: table, **how))

    def test_mat_struct_matrix_and_integers(self):
        columns = ("columns:\n  time: {column: run.t, unit: s}\n  current: {column: 'run.log(:,2)', unit: mA}\n"
                   "  contraction: {column: counts, unit: count}\n  muscle_pressure: {column: 'run.log(:,1)', unit: mbar}\n")

        def shape(table):
            log = numpy.column_stack([table["muscle_pressure_bar"] * 1000, table["current_mA"]])
            counts = numpy.round(table["contraction_ratio"] / PER_COUNT).astype(numpy.int16)
            return {"run": {"t": table["time_s"], "log": log, "who": "me"}, "counts": counts, "cell": [["a", 1]]}

        self.near(".mat", self.mat(shape), columns=columns)
        self.near(".mat", self.mat(shape, do_compression=True), columns=columns)

    def test_every_format_in_one_data_set(self):
        """What a run says of its columns goes before what the data set says."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        (folder / "rig.yaml").write_text((self.data / "rig.yaml").read_text())
        table = self.tables["m1_c01"]
        self.lvm()(folder / "a.lvm", table)
        self.mat(lambda t: {"t": t["time_s"] * 1000, "I": t["current_mA"], "e": t["contraction_ratio"]})(folder / "b.mat", table)
        (folder / "c.txt").write_text((self.data / "thesis/m1_c01.txt").read_text())
        (folder / "d.csv").write_text((self.data / "m1_c01.csv").read_text())
        (folder / "dataset.yaml").write_text("""schema: mckibben-dataset/1
rig: rig.yaml
columns:
  time: {column: t, unit: ms}
  current: {column: I, unit: mA}
  contraction: {column: e, unit: 1}
runs:
  - {id: b, file: b.mat, load: 11.138 kg}
  - {id: c, file: c.txt, load: 11.138 kg,
     columns: {rows_are_ticks: true, current: {column: 1, unit: mA}, contraction: {column: 2, unit: 1}}}
  - {id: a, file: a.lvm, load: 11.138 kg,
     columns: {time: {column: X_Value, unit: s}, current: {column: current_mA, unit: mA}, contraction: {column: contraction_ratio, unit: 1}}}
  - {id: d, file: d.csv, load: 11.138 kg,
     columns: {time: {column: time_s, unit: s}, current: {column: current_mA, unit: mA}, contraction: {column: contraction_ratio, unit: 1}}}
""")
        found = self.replay(folder)
        self.assertEqual([run["id"] for run in found], ["b", "c", "a", "d"])
        for run_ in found:
            self.assertEqual(run_["rmse"], self.expected[0]["rmse"])
            self.assertEqual(run_["solver"], self.expected[0]["solver"])

    def test_a_map_that_contradicts_the_file_or_itself_is_refused(self):
        (self.folder / "e.csv").write_text((self.data / "m1_c01.csv").read_text())
        for columns, message in [
                ("rows_are_ticks: true", "e.csv:2:1: error: rows_are_ticks is said, and yet the file holds time_s"),
                ('current: {column: "", unit: A}', "it must not be empty"),
                ("current: {column: current_mA, unit: mA}, contraction: {column: current_mA, unit: 1}",
                 "it stands in the same column as current")]:
            (self.folder / "e.yaml").write_text("schema: mckibben-dataset/1\n"
                f"runs: [{{id: r, file: e.csv, load: 11 kg, columns: {{{columns}}}}}]\n")
            self.assertIn(message, run(self.folder, "check", "e.yaml", status=65).stderr)

    def test_what_is_wrong_in_a_mat_is_named(self):
        def refused(message, **changes):
            table = {k: numpy.array(v[:5]) for k, v in self.tables["m1_c01"].items()}
            for name, value in changes.items():
                if callable(value):
                    value(table[name])
                else:
                    table[name] = value
            scipy.io.savemat(self.folder / "w.mat", {k: v for k, v in table.items() if v is not None})
            (self.folder / "w.yaml").write_text("schema: mckibben-dataset/1\nruns: [{id: r, file: w.mat, load: 11 kg}]\n")
            said = run(self.folder, "check", "w.yaml", status=65).stderr
            self.assertEqual(said, f"w.mat: error: {message}\n")

        def put(row, value):
            def change(array):
                array[row] = value
            return change

        refused("current_mA(3): nan is not a finite number", current_mA=put(2, numpy.nan))
        refused("current_mA(1): inf is not a finite number", current_mA=put(0, numpy.inf))
        refused("current_mA(4): current_mA = 20.5 is out of range: 0 to 20 (range of the rig's DAC)", current_mA=put(3, 20.5))
        refused("contraction_ratio(5): contraction_ratio = 1.5 is out of range: -0.2 to 1 (what a muscle can do)",
                contraction_ratio=put(4, 1.5))
        refused("time_s(3): time_s = 0.012 is repeated: expected is 0.024", time_s=put(2, 0.012))
        refused("time_s has 5 numbers and current_mA has 2; there must be as many", current_mA=numpy.array([4.0, 4.0]))
        refused("current_mA is empty", current_mA=numpy.array([]))
        refused("there is no variable current_mA (found: time_s, contraction_ratio, muscle_pressure_bar)", current_mA=None)
        refused("current_mA is complex; wanted is a vector of real numbers (found: time_s, contraction_ratio, "
                "muscle_pressure_bar)", current_mA=numpy.array([1j] * 5))
        refused("contraction_ratio has 2 rows and 3 columns; name one: contraction_ratio(:,1)",
                contraction_ratio=numpy.zeros((2, 3)))

    def test_mat_of_every_damage(self):
        """Cut off anywhere, or with any byte wrong, it is read or refused, and nothing else."""
        self.mat(lambda table: {k: v[:4] for k, v in table.items()}, do_compression=True)(self.folder / "whole.mat",
                                                                                          self.tables["m1_c01"])
        whole = (self.folder / "whole.mat").read_bytes()
        spoilt = [whole[:n] for n in (0, 1, 100, 127, 128, 130, 140, 200, len(whole) - 1)]
        spoilt += [whole[:n] + bytes([whole[n] ^ 255]) + whole[n + 1:] for n in range(124, len(whole), 29)]
        text = "schema: mckibben-dataset/1\nruns:\n"
        for i, data in enumerate(spoilt):
            (self.folder / f"spoilt{i}.mat").write_bytes(data)
            text += f"  - {{id: r{i}, file: spoilt{i}.mat, load: 11 kg}}\n"
        (self.folder / "spoilt.yaml").write_text(text)
        said = run(self.folder, "check", "spoilt.yaml", status=65).stderr
        for i in range(9):
            self.assertIn(f"spoilt{i}.mat: error: ", said)
        for line in said.splitlines():
            self.assertRegex(line, r"^spoilt\d+\.mat: error: ")


if __name__ == "__main__":
    unittest.main()
