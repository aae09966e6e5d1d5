"""run and replay: what the command line calculates, as arrays that nobody copied."""
import csv
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import xml.dom.minidom
from unittest import mock

import numpy

import mckibben
from common import SCENARIO, main

PROGRAM = sys.argv[1]


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = mckibben.Scenario(SCENARIO).run()

    def test_an_unknown_column_is_answered(self):
        run = mckibben.Scenario(SCENARIO).run().runs[0]
        for name, said in (("contraction_rato", "contraction_rato: no such column; did you mean contraction_ratio"),
                           ("target", "it is run.target"), ("qqqqqqqqqqqq", "there are time_s, ")):
            with self.assertRaisesRegex(KeyError, said):
                run[name]
        for index in (0, slice(3), ["time_s"]):
            with self.assertRaisesRegex(TypeError, r"^run\[.*\]: must be the name of a column, such as run\['time_s'\]"):
                run[index]

    def test_warn_of_contractions_beyond_what_a_muscle_can(self):
        self.assertEqual(self.result.warnings, [])
        full = {"kind": "stair_current", "low": "4 mA", "high": "20 mA", "steps": 1, "dwell": "1 s"}
        result = mckibben.Scenario({**SCENARIO, "loads": ["1 kg", "11 kg"], "controllers": [full], "duration": "2 s"}).run()
        self.assertRegex(result.warnings[0], r"^11kg_\S+: contraction ratio 0\.\d+ is above e_max = 0\.\d+: impossible for a "
                                             r"real muscle \(T 2\.3\)$")
        self.assertEqual(len(result.warnings), 1, "the light load stays below")

    def test_runs_are_a_sequence(self):
        self.assertEqual([run.name for run in self.result[1:]], [self.result[1].name])
        self.assertEqual([run.name for run in self.result], [run.name for run in self.result.runs])
        with self.assertRaisesRegex(TypeError, r"^result\['pid'\]: must be a run's place"):
            self.result["pid"]

    def test_are_those_of_the_command_line_to_the_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scenario.yaml"
            path.write_text(json.dumps({"schema": "mckibben-scenario/1", **SCENARIO}))
            subprocess.run([PROGRAM, "run", path, "--out", f"{folder}/out"], check=True, capture_output=True)
            for run in self.result.runs:
                rows = list(csv.DictReader(io.StringIO(pathlib.Path(folder, "out", run.name + ".csv").read_text())))
                self.assertIn("muscle_pressure_bar", rows[0])
                for name in rows[0]:
                    column = run.target if name == "target_contraction_ratio" else run[name]
                    self.assertEqual([float(row[name]) for row in rows], column.tolist(), name)
            written = json.loads(pathlib.Path(folder, "out", "run.json").read_text())
            self.assertEqual(self.result.to_dict()["runs"], written["runs"])
            self.assertEqual(str(self.result), pathlib.Path(folder, "out", "table.txt").read_text())

    def test_notebooks_show_a_table_with_each_motion(self):
        page = self.result._repr_html_()
        self.assertEqual(page.count("<tr>"), 1 + len(self.result))
        self.assertEqual(page.count("<polyline"), len(self.result))
        run = self.result[0]
        self.assertIn(f"<td>{run.name}</td>", page)
        self.assertIn(f"{run.metrics['rmse']:.5f}", run._repr_html_())
        self.assertIn(f"{run['contraction_ratio'].min():.4g} to {run['contraction_ratio'].max():.4g}", page)
        xml.dom.minidom.parseString(f"<div>{page}</div>")

    def test_arrays_are_copies(self):
        run = mckibben.Scenario(SCENARIO).run()[0]
        column = run["muscle_pressure_bar"]
        self.assertEqual(column.tolist(), run.samples["muscle_pressure_bar"].tolist())
        self.assertEqual(run["counts"].dtype, numpy.int64)
        column[0] = -1.0
        self.assertNotEqual(run["muscle_pressure_bar"][0], -1.0)
        self.assertEqual(len(column), 100)

    def test_tell_what_there_is(self):
        self.assertEqual(len(self.result), 2)
        run = self.result[-1]
        self.assertEqual(run.load_kg, 16.138)
        self.assertIsNone(run.failure)
        self.assertGreater(run.metrics["rmse"], 0.0)
        self.assertEqual(set(run.units), set(run.samples.dtype.names))
        self.assertIn("<html", self.result.report_html())
        with self.assertRaises(KeyError):
            run["no_such"]
        with self.assertRaises(IndexError):
            self.result[2]

    def test_frames_have_units(self):
        frame = self.result[0].frame()
        self.assertEqual(frame.index.name, "time_s")
        self.assertEqual(frame.attrs["units"]["muscle_pressure_bar"], "bar")
        self.assertEqual(frame["contraction_ratio"].tolist(), self.result[0]["contraction_ratio"].tolist())
        with mock.patch.dict(sys.modules, {"pandas": None}), self.assertRaisesRegex(ImportError, "python3-pandas"):
            self.result[0].frame()

    def test_a_rig_runs_by_itself(self):
        result = mckibben.Rig("thesis").run(**SCENARIO, seed=1)
        numpy.testing.assert_array_equal(result[1].samples, self.result[1].samples)

    def test_a_pair(self):
        current = {"kind": "sine_current", "low": "5 mA", "high": "9 mA", "period": "1 s"}
        run, = mckibben.Scenario({"duration": "1.2 s", "currents": [{"current_1": current, "current_2": current}]}).run().runs
        self.assertEqual(run["muscle_pressure_2_bar"].shape, (100,))
        self.assertIsNone(run.target)
        run, = mckibben.Rig("thesis_pair").run(
            duration="1.2 s", targets=[{"name": "swing", "angle": {"kind": "sine", "mean": "0 deg", "amplitude": "10 deg", "period": "1.2 s"}}],
            controllers=[{"kind": "pid", "proportional": "30 mA/rad", "integral_time": "0.1 s", "derivative_time": "0.08 s"}]).runs
        self.assertEqual((run.name, run.controller, run.failure), ("swing_0kg_pid", "pid", None))
        self.assertLess(run.metrics["rmse_rad"], 0.1)
        error = run["angle_rad"] - run.target
        self.assertAlmostEqual(run.metrics["largest_error_rad"], abs(error).max(), delta=1e-3)
        self.assertIn(f"<td>{run.metrics['rmse_rad']:.5f} rad</td>", run._repr_html_())

    def test_threads_make_no_difference(self):
        def run(into):
            into.append([one.samples.tobytes() for one in mckibben.Scenario({**SCENARIO, "duration": "12 s"}).run(threads=1).runs])
        alone, beside = [], []
        run(alone)
        threads = [threading.Thread(target=run, args=(beside,)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(beside, alone * 3)


class Stops(unittest.TestCase):
    LONG = {**SCENARIO, "duration": "300 s", "loads": [f"{8 + 0.1 * i} kg" for i in range(100)]}

    def test_ctrl_c_ends_it_cleanly(self):
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            mckibben.Scenario(self.LONG).run(threads=1)
        self.test_what_progress_raises_ends_it()  # what follows goes on

    def test_what_progress_raises_ends_it(self):
        def progress(what, done, total):
            self.assertEqual((what, total), ("simulating", 100))
            raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            mckibben.Scenario(self.LONG).run(threads=1, progress=progress)

    def test_progress_is_told(self):
        told = []
        mckibben.Scenario(SCENARIO).run(progress=lambda *news: told.append(news))
        self.assertEqual(told[-1], ("simulating", 2, 2))


class Replays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.truth = mckibben.Scenario({**SCENARIO, "duration": "6 s"}).run()
        runs = [{"id": f"r{i}", "load": f"{run.load_kg} kg",
                 "data": {"time_s": numpy.round(run["time_s"], 9), "current_mA": run["current_mA"],
                          "contraction_ratio": run["encoder_contraction_ratio"]}} for i, run in enumerate(cls.truth.runs)]
        cls.data = mckibben.Dataset({"runs": runs})

    def test_come_back_to_a_count(self):
        result = self.data.replay()
        self.assertEqual([run.name for run in result.runs], ["r0", "r1"])
        for run in result.runs:
            self.assertLessEqual(run.gaps["contraction"]["largest"], 1.001 * self.data.rig.contraction_per_count)

    def test_on_another_rig_they_do_not(self):
        leaking = mckibben.Rig({"effects": {"viscous_damping": {"damping": "300 N.s/m"}}})
        gap = self.data.replay(rig=leaking)[0].gaps["contraction"]
        self.assertGreater(gap["rmse"], 3.0 * self.data.replay()[0].gaps["contraction"]["rmse"])
        with self.assertRaisesRegex(mckibben.InputError, "two muscles"):
            self.data.replay(rig="thesis_pair")


main()
