"""Generated tables over format x clock x units x layout, the truth known: `import` and `replay` read each right, or
ask (FILL_IN, or a refusal). None is misread in silence: on the rig that made it, it comes near itself.

    corpus_test.py PROGRAM [COUNT]     COUNT of texts drawn (default 90); works in a folder of its own
"""

import csv
import datetime
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy
import scipy.io

COUNT = int(sys.argv.pop(2)) if len(sys.argv) > 2 and sys.argv[2].isdigit() else 90
PROGRAM = sys.argv.pop(1)
RIG = """schema: mckibben-rig/1
base: thesis
valve: {zero_command: 0 V, span_command: 10 V, zero_pressure: 0 bar, span_pressure: 5 bar}
gauge: {fitted: true}
"""
CAMPAIGN = """schema: mckibben-campaign/1
rig: rig.yaml
loads: [11 kg]
currents: [{name: s, duration: 4.2 s, current: {kind: sine_current, low: 0 V, high: 8 V, period: 4.8 s}}]
"""
EPOCH = datetime.datetime(2026, 3, 1, 12, 0, 0)
# Of V, bar and a contraction ratio; a laser falls.
COMMANDS = {"V": lambda v: v, "mV": lambda v: 1000 * v}
PRESSURES = {"bar": lambda p: p, "kPa": lambda p: 100 * p, "psi": lambda p: p * 14.503773773, "MPa": lambda p: p / 10,
             "mbar": lambda p: 1000 * p, "kgf/cm2": lambda p: p * 1.0197162, "inHg": lambda p: p * 29.529983,
             "mmHg": lambda p: p * 750.06158, "Pa": lambda p: 1e5 * p, "PSI": lambda p: p * 14.503773773,
             "psia": lambda p: (p + 1.01325) * 14.503773773, "kPa(a)": lambda p: 100 * p + 101.325,
             "kPa, absolute": lambda p: 100 * p + 101.325}
LENGTHS = {"mm": lambda e: 412 - 300 * e, "cm": lambda e: 41.2 - 30 * e, "in": lambda e: (412 - 300 * e) / 25.4,
           "m": lambda e: 0.412 - 0.3 * e, "%": lambda e: 100 * e}
# How a clock shows the row at t seconds: name, unit, text.
CLOCKS = {
    "s": ("t", "s", lambda t, k: f"{t:.3f}"), "ms": ("Time", "ms", lambda t, k: f"{1000 * t:.0f}"),
    "us": ("micros", "us", lambda t, k: f"{1e6 * t:.0f}"), "millis": ("millis", "", lambda t, k: f"{7000 + 1000 * t:.0f}"),
    "epoch s": ("timestamp", "s", lambda t, k: f"{1772366400 + t:.3f}"),
    "epoch ms": ("timestamp", "ms", lambda t, k: f"{1772366400000 + 1000 * t:.0f}"),
    "epoch us": ("timestamp", "us", lambda t, k: f"{1772366400000000 + 1e6 * t:.0f}"),
    "epoch ns": ("timestamp", "ns", lambda t, k: f"{1772366400 * 10**9 + round(t * 1000) * 10**6}"),
    "date": ("Zeit", "", lambda t, k: (EPOCH + datetime.timedelta(seconds=t)).isoformat(" ", "milliseconds")),
    "midnight": ("Time", "", lambda t, k: (EPOCH + datetime.timedelta(hours=11, minutes=59, seconds=58 + t))
                 .time().isoformat("milliseconds")),
    "interval": ("dt", "ms", lambda t, k: "12" if k else "0"),
    "counter": ("Sample", "", lambda t, k: str(k)), "none": None}
RATED = ("counter", "none")  # want a rate above the table
LAYOUTS = ("brackets", "parentheses", "suffix", "unit line", "hash", "settings", "trailing", "bare names", "no headings",
           "more columns", "long", "two runs")
# Separator, decimal sign, line end, encoding, ending.
DIALECTS = ((",", ".", "\n", "utf-8", ".csv"), (";", ",", "\r\n", "latin-1", ".csv"), ("\t", ".", "\n", "utf-8", ".txt"),
            ("\t", ",", "\r\n", "utf-16", ".txt"), (" ", ".", "\n", "utf-8", ".dat"), (",", ".", "\r", "utf-8", ".csv"),
            (";", ".", "\n", "utf-8-sig", ".asc"), (",", ".", "\n", "utf-8", ".txt"), (",", ".", "\n", "utf-8", ""))


def table_of(truth, clock, units):
    """Columns: name, unit, cells as text with a point."""
    command, pressure, length = units
    columns = []
    if CLOCKS[clock]:
        name, unit, text = CLOCKS[clock]
        columns.append((name, unit, [text(t, k) for k, t in enumerate(truth["time_s"])]))
    columns.append(("Soll", command, [f"{COMMANDS[command](v):.6g}" for v in truth["command_V"]]))
    columns.append(("Druck", pressure.split(",")[0], [f"{PRESSURES[pressure](p):.6g}" for p in truth["muscle_pressure_bar"]]))
    columns.append(("contraction" if length == "%" else "Laser", length,
                    [f"{LENGTHS[length](e):.6g}" for e in truth["contraction_ratio"]]))
    return columns


def in_text(columns, layout, dialect, rate):
    separator, sign, end, encoding, _ = dialect
    number = lambda cell: cell if ":" in cell else cell.replace(".", sign)
    if separator == " ":
        number = lambda cell: cell.replace(" ", "T")
    head, names = [], [name for name, _, _ in columns]
    units = [unit for _, unit, _ in columns]
    if rate or layout == "settings":
        head += ["Operator: somebody", "KP 0.72", f"Sample rate = {number('83.3333333')} Hz", ""]
    if layout == "more columns":
        names += ["Temperatur", "Nr"]
        units += ["degC", ""]
        columns = columns + [("", "", [f"{21 + k % 3 / 10:.1f}" for k in range(len(columns[0][2]))]),
                             ("", "", [str(k + 1) for k in range(len(columns[0][2]))])]
    rows = [[number(cell) for cell in row] for row in zip(*[cells for _, _, cells in columns])]
    if layout == "two runs":
        names, units = names + ["trial"], units + [""]
        rows = [row + [str(trial)] for trial in (1, 2) for row in rows]
    if layout == "long":
        names, units = [names[0], "signal", "value", "unit"], [units[0], "", "", ""]
        rows = [[row[0], column[0], cell, column[1]]
                for row in rows for column, cell in zip(columns[1:], row[1:])]
    if layout == "suffix":
        names = [f"{name}_{unit}" if unit and "/" not in unit and unit != "%" else f"{name} [{unit}]" for name, unit in zip(names, units)]
    elif layout in ("parentheses", "hash"):
        names = [f"{name}({unit})" if unit else name for name, unit in zip(names, units)]
    elif layout not in ("unit line", "bare names", "no headings"):
        names = [f"{name} [{unit}]" if unit else name for name, unit in zip(names, units)]
    if separator == " ":
        names = [name.replace(" ", "") for name in names]
    lines = head + ([] if layout == "no headings" else [("# " if layout == "hash" else "") + separator.join(names)])
    if layout == "unit line":
        lines.append(separator.join(unit or "-" for unit in units))
    tail = separator if layout == "trailing" else ""
    lines += [separator.join(row) + tail for row in rows]
    return end.join(lines + [""]).encode(encoding, "replace")


def in_messages(columns, flow=False, cut=0):
    """As `ros2 topic echo` prints a message with its stamp and an array; `flow`: as `rostopic echo` does."""
    seconds, rest = ("secs", "nsecs") if flow else ("sec", "nanosec")
    (_, _, stamps), (_, _, command), *arrays = columns
    text = ""
    for k, stamp in enumerate(stamps):
        whole, part = divmod(int(stamp), 10**9)
        values = [cells[k] for _, _, cells in arrays]
        text += (f"header:\n  stamp:\n    {seconds}: {whole}\n    {rest}: {part}\n  frame_id: 'base, link'\n"
                 f"command_V: {command[k]}\nreadings:" +
                 (f" [{', '.join(values)}]\n" if flow else "\n" + "".join(f"- {value}\n" for value in values)) + "---\n")
    return text[:len(text) - cut]


def in_xlsx(path, columns, words=()):
    def cell(text):
        try:
            return f"<c><v>{float(text)!r}</v></c>"
        except ValueError:
            return f'<c t="inlineStr"><is><t>{text}</t></is></c>'

    rows = [[word] for word in words] + [[f"{name} [{unit}]" if unit else name for name, unit, _ in columns]]
    rows += [list(row) for row in zip(*[cells for _, _, cells in columns])]
    sheet = "".join("<row>" + "".join(map(cell, row)) + "</row>" for row in rows)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("xl/workbook.xml", '<workbook xmlns:r="r"><sheets><sheet name="A" sheetId="1" r:id="i"/></sheets></workbook>')
        file.writestr("xl/_rels/workbook.xml.rels",
                      '<Relationships><Relationship Id="i" Target="worksheets/sheet1.xml"/></Relationships>')
        file.writestr("xl/worksheets/sheet1.xml", f"<worksheet><sheetData>{sheet}</sheetData></worksheet>")


class Corpus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        (cls.folder / "rig.yaml").write_text(RIG)
        (cls.folder / "c.yaml").write_text(CAMPAIGN)
        cls.run_program("dataset", "c.yaml", "--out", "made")
        with open(cls.folder / "made/m1_s.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        cls.truth = {name: [float(row[name]) for row in rows] for name in rows[0]}

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def run_program(cls, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=cls.folder, capture_output=True, text=True)

    def judged(self, file, runs=1):
        """`right`, `asked`, or what was read in its place."""
        said = self.run_program("import", file, "--rig", "rig.yaml", "--out", "read")
        self.assertIn(said.returncode, (0, 65), said.stderr)
        lines = (self.folder / "read/dataset.yaml").read_text().splitlines() if said.returncode == 0 else []
        if said.returncode or any("FILL_IN" in line.split("#")[0] for line in lines):
            return "asked"
        said = self.run_program("replay", "read", "--json", "--out", "replayed")
        self.assertIn(said.returncode, (0, 65), said.stderr)
        if said.returncode:
            return "asked"
        found = json.loads(said.stdout)["runs"]
        gaps = [(gap["reading"], gap["rows"], gap["rmse"]) for run in found for gap in run["gaps"]]
        rows, largest = len(self.truth["time_s"]), {"contraction": 0.004, "muscle_pressure": 0.02}
        near = all(count == rows and rmse < largest.get(name, 0) for name, count, rmse in gaps)
        return "right" if near and len(found) == runs and len(gaps) == 2 * runs else gaps

    def hold(self, cases):
        """Cases: what it is, how its file is written, runs in it, whether something must be asked."""
        count = {"right": 0, "asked": 0}
        for what, write, runs, open_ in cases:
            with self.subTest(what):
                found = self.judged(write(), runs)
                self.assertIn(found, count)
                count[found] += 1
                self.assertFalse(open_ and found == "right", "nothing tells what was read")
        return count

    def test_texts(self):
        draw = random.Random(3)

        def case(number):
            layout, dialect, clock = LAYOUTS[number % len(LAYOUTS)], DIALECTS[number % len(DIALECTS)], draw.choice(list(CLOCKS))
            units = draw.choice(list(COMMANDS)), draw.choice(list(PRESSURES)), draw.choice(list(LENGTHS))
            if layout in ("long", "two runs") and clock in ("interval", *RATED):
                clock = "ms"
            if layout in ("bare names", "no headings"):
                clock = "s"
            file = f"t{number}_11kg{dialect[4]}"

            def write():
                columns = table_of(self.truth, clock, units)
                (self.folder / file).write_bytes(in_text(columns, layout, dialect, clock in RATED))
                return file

            return ((file, layout, dialect, clock, *units), write, 2 if layout == "two runs" else 1,
                    layout in ("bare names", "no headings") or "absolute" in units[1])

        count = self.hold([case(number) for number in range(COUNT)])
        self.assertGreater(count["right"], COUNT * 2 // 3, count)

    def test_ros_messages(self):
        columns = table_of(self.truth, "epoch ns", ("V", "bar", "%"))
        for flow in (False, True):
            (self.folder / "ros_11kg.txt").write_text(in_messages(columns, flow, 20 if flow else 0))
            said = self.run_program("import", "ros_11kg.txt", "--rig", "rig.yaml", "--out", "read")
            self.assertEqual(said.returncode, 0, said.stderr)
            told = (self.folder / "read/dataset.yaml").read_text()
            self.assertRegex(told, r'time: \{column: "header.stamp", unit: s')
            told = told[:told.index("columns:")] + """columns:
  time: {column: header.stamp, unit: s}
  command: {column: command_V, unit: V}
  muscle_pressure: {column: readings.0, unit: bar}
  contraction: {column: readings.1, unit: "%"}
""" + told[told.index("runs:"):]
            (self.folder / "read/dataset.yaml").write_text(told)
            said = self.run_program("replay", "read", "--json", "--out", "replayed")
            self.assertEqual(said.returncode, 0, said.stderr)
            gaps = json.loads(said.stdout)["runs"][0]["gaps"]
            rows = len(self.truth["time_s"]) - (1 if flow else 0)  # the last one is cut
            self.assertEqual([gap["rows"] for gap in gaps], [rows, rows])
            self.assertLess(max(gap["rmse"] for gap in gaps), 0.02)

    def test_sheets_and_mat_files(self):
        def sheet(clock, units, words):
            def write():
                in_xlsx(self.folder / "s_11kg.xlsx", table_of(self.truth, clock, units), words)
                return "s_11kg.xlsx"

            return (("xlsx", clock, *units), write, 1, False)

        def mat(clock, units, shape):
            def write():
                columns = {f"{name}_{unit}" if unit.isalpha() else name: numpy.array([float(cell) for cell in cells])
                           for name, unit, cells in table_of(self.truth, clock, units)}
                scipy.io.savemat(self.folder / "m_11kg.mat", {"log": columns} if shape == "struct" else columns)
                return "m_11kg.mat"

            return ((f"mat {shape}", clock, *units), write, 1, False)

        all_units = [("V", "bar", "mm"), ("mV", "kPa", "cm"), ("V", "psi", "in"), ("V", "MPa", "m")]
        cases = [sheet(clock, units, words) for clock in ("s", "ms", "epoch s", "date") for units in all_units[:3]
                 for words in ((), ("A bench of ours", "KP 0.72"))]
        cases += [mat(clock, units, shape) for clock in ("s", "ms") for units in all_units for shape in ("struct", "vectors")]
        count = self.hold(cases)
        self.assertGreater(count["right"], len(cases) * 2 // 3, count)


if __name__ == "__main__":
    unittest.main()
