"""What we write, read by others: scipy for MAT-files, ncdump for NetCDF, Octave for both where it is installed.
Every number must be that of the CSV, to the bit; names and units must be the same in all of them.

    output_test.py PROGRAM     works in a folder of its own
"""

import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import scipy.io

PROGRAM = sys.argv.pop(1)
SCENARIO = """schema: mckibben-scenario/1
rig: {gauge: {fitted: true}}
loads: [11.138 kg, 16.138 kg]
duration: 1 s
target: {kind: sine, mean: 0.05, amplitude: 0.02, period: 1 s}
controllers: [{kind: sine_current, low: 5 mA, high: 9 mA, period: 1 s}]
seed: 18446744073709551615
"""
CAMPAIGN = """schema: mckibben-campaign/1
loads: [11.138 kg, 23.406 kg]
currents: [{duration: 1.2 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}]
"""
FORMATS = ("--format", "mat,netcdf")


def run(folder, *arguments, status=0):
    done = subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done


def read_csv(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def read_netcdf(path):
    """Values, attributes of each variable, global attributes: from ncdump's text."""
    text = subprocess.run(["ncdump", "-p", "9,17", path], capture_output=True, text=True, check=True).stdout
    head, data = text.split("\ndata:\n")
    values = {name: [float(v) for v in row.split(",")] for name, row in re.findall(r"^ (\w+) = ([^;]*) ;", data, re.M)}
    attributes = {}
    for variable, name, value in re.findall(r"^\t\t(\w*):(\w+) = (.*) ;$", head, re.M):
        attributes.setdefault(variable, {})[name] = json.loads(value + "0" if value.endswith(".") else value)
    return text, values, attributes


class Written(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        (cls.folder / "s.yaml").write_text(SCENARIO)
        (cls.folder / "c.yaml").write_text(CAMPAIGN)
        run(cls.folder, "run", "s.yaml", *FORMATS)
        run(cls.folder, "dataset", "c.yaml", *FORMATS)
        run(cls.folder, "replay", "out/c", "--format", "netcdf,csv,mat")
        cls.folders = [cls.folder / "out" / name for name in ("s", "c", "c-truth", "c-replay")]

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def packages(self):
        for folder in self.folders:
            package = json.loads((folder / "datapackage.json").read_text())
            self.assertEqual(len(package["resources"]), 2)
            for resource in package["resources"]:
                yield folder / resource["path"], resource

    def test_datapackage_says_what_the_columns_are(self):
        for path, resource in self.packages():
            fields = resource["schema"]["fields"]
            self.assertEqual([field["name"] for field in fields], list(read_csv(path)))
            self.assertTrue(all(field["unit"] and field["description"] and field["type"] == "number" for field in fields))
            self.assertRegex(resource["name"], r"^[-a-z0-9._/]+$")

    def test_scipy_reads_the_mat_files(self):
        for path, resource in self.packages():
            read = scipy.io.loadmat(path.with_name(path.stem + ".mat"), simplify_cells=True)
            for name, values in read_csv(path).items():
                self.assertEqual(read[name].tolist(), values, (path, name))
            for field in resource["schema"]["fields"]:
                self.assertEqual(read["units"][field["name"]], field["unit"])
                self.assertEqual(read["descriptions"][field["name"]], field["description"])
            self.assertRegex(read["source"], r"^mckibben \d")
        self.assertEqual(scipy.io.loadmat(self.folders[0] / "16.138kg_sine_current.mat")["load_kg"].tolist(), [[16.138]])

    def test_ncdump_reads_the_netcdf_files(self):
        for path, resource in self.packages():
            text, values, attributes = read_netcdf(path.with_name(path.stem + ".nc"))
            table = read_csv(path)
            self.assertIn(f"\ttime_s = {len(table['time_s'])} ;", text)
            self.assertEqual(values, table, path)
            for field in resource["schema"]["fields"]:
                self.assertIn(f"\tdouble {field['name']}(time_s) ;", text)
                self.assertEqual(attributes[field["name"]],
                                 {"units": field["unit"], "long_name": field["description"]})
            self.assertEqual(attributes[""]["Conventions"], "CF-1.8")
        self.assertEqual(attributes[""]["controller"], "recorded current")
        about = read_netcdf(self.folders[0] / "11.138kg_sine_current.nc")[2][""]
        self.assertEqual((about["load_kg"], about["seed"], about["controller"]),
                         (11.138, "18446744073709551615", "sine_current"))

    def test_what_a_data_set_holds_tells_nothing_true(self):
        for path in (self.folder / "out/c").glob("m1*"):
            self.assertNotIn(b"contraction_speed", path.read_bytes())

    def test_our_own_mat_files_are_a_data_set(self):
        """Under our names, so no map is needed; and as a truth, whose encoder is what was measured."""
        for name in ("c", "c-truth"):
            shutil.copytree(self.folder / "out" / name, self.folder / "copy" / name)
        own = self.folder / "copy/c/from_mat.yaml"
        own.write_text((self.folder / "out/c/dataset.yaml").read_text().replace(".csv", ".mat"))
        wanted = json.loads(run(self.folder, "replay", "out/c", "--out", "a", "--json").stdout)["runs"]
        self.assertEqual(json.loads(run(self.folder, "replay", own, "--out", "b", "--json").stdout)["runs"], wanted)
        truth = self.folder / "copy/c-truth/as_data.yaml"
        truth.write_text(own.read_text().replace("runs:", "columns: {contraction: {column: encoder_contraction_ratio, "
                                                          "unit: 1}}\nruns:"))
        found = json.loads(run(self.folder, "replay", truth, "--out", "d", "--json").stdout)["runs"]
        self.assertEqual([one["rmse"] for one in found], [one["rmse"] for one in wanted])

    def test_same_bytes_again(self):
        def contents(folder):
            return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}

        before = [contents(folder) for folder in self.folders]
        run(self.folder, "run", "s.yaml", *FORMATS, "--threads", "1")
        run(self.folder, "dataset", "c.yaml", "--format", "netcdf", "--format", "mat", "--threads", "1")
        self.assertTrue([contents(folder) for folder in self.folders] == before)
        self.assertEqual([p for p in (self.folder / "out").iterdir() if ".old" in p.name], [])

    def test_csv_alone_unless_more_is_asked_for(self):
        run(self.folder, "run", "s.yaml", "--out", "plain")
        endings = {path.suffix for path in (self.folder / "plain").iterdir()}
        self.assertFalse(endings & {".mat", ".nc"})
        self.assertTrue((self.folder / "plain/datapackage.json").exists())

    def test_formats_that_do_not_exist(self):
        said = run(self.folder, "run", "s.yaml", "--format", "mat,netcfd", "--out", "no", status=64)
        self.assertIn("unknown format netcfd; did you mean netcdf?", said.stderr)
        self.assertFalse((self.folder / "no").exists())

    @unittest.skipUnless(shutil.which("octave-cli"), "Octave is not installed")
    def test_octave_reads_the_mat_files(self):
        path = self.folders[0] / "11.138kg_sine_current.mat"
        script = (f"load('{path}'); fprintf('%.17g\\n', muscle_pressure_bar); fprintf('%s\\n', units.current_mA);"
                  "save('-v6', 'six.mat', 'time_s', 'current_mA', 'contraction_ratio');"
                  "save('-v7', 'seven.mat', 'time_s', 'current_mA', 'contraction_ratio');"
                  "save('-text', 'text.mat', 'time_s', 'current_mA', 'contraction_ratio');")
        done = subprocess.run(["octave-cli", "--quiet", "--no-init-file", "--eval", script], cwd=self.folder,
                              capture_output=True, text=True)
        lines = done.stdout.split()
        self.assertEqual([float(line) for line in lines[:-1]], read_csv(path.with_suffix(".csv"))["muscle_pressure_bar"])
        self.assertEqual(lines[-1], "mA")
        text = "schema: mckibben-dataset/1\nruns:\n  - {id: six, file: six.mat, load: 11 kg}\n  - {id: seven, file: "
        (self.folder / "octave.yaml").write_text(text + "seven.mat, load: 11 kg}\n")
        run(self.folder, "check", "octave.yaml")
        (self.folder / "text.yaml").write_text(text + "text.mat, load: 11 kg}\n")
        said = run(self.folder, "check", "text.yaml", status=65)
        self.assertIn("text.mat: error: this is Octave's own format; in MATLAB or Octave, save it with -v7", said.stderr)


if __name__ == "__main__":
    unittest.main()
