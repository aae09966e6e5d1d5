"""calibrate and diagnose: what the command line finds, from Python."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

import mckibben
from common import SCENARIO, main

PROGRAM = sys.argv[1]


class Calibrations(unittest.TestCase):
    CAMPAIGN = """schema: mckibben-campaign/1
loads: [11.138 kg, 16.138 kg, 23.406 kg]
currents:
  - {duration: 24 s, current: {kind: triangle_current, low: 4 mA, high: 14 mA, speed: 1 mA/s}}
  - {duration: 12 s, current: {kind: triangle_current, low: 4 mA, high: 14 mA, speed: 3 mA/s}}
"""

    def test_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "campaign.yaml").write_text(self.CAMPAIGN)
            subprocess.run([PROGRAM, "dataset", "campaign.yaml", "--out", "data"], cwd=folder, check=True, capture_output=True)
            subprocess.run([PROGRAM, "calibrate", "data", "--load-order", "2", "--speed-order", "1", "--out", "found"], cwd=folder, check=True, capture_output=True)
            found = mckibben.Dataset(f"{folder}/data").calibrate(load_order=2, speed_order=1)
            written = json.loads(pathlib.Path(folder, "found", "calibration.json").read_text())
            self.assertEqual(found.to_dict()["friction"], written["friction"])
            self.assertIn(found.to_yaml(), pathlib.Path(folder, "found", "calibration.yaml").read_text())
            with self.assertRaisesRegex(ValueError, "load_order is 0 to 3"):
                mckibben.Dataset(f"{folder}/data").calibrate(load_order=4)
            with self.assertRaisesRegex(ValueError, "'current' or 'gauge'"):
                mckibben.Dataset(f"{folder}/data").calibrate(pressure="guess")


class Diagnoses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        hidden = mckibben.Rig({"effects": {"viscous_damping": {"damping": "150 N.s/m"}}})
        controllers = [{"kind": "sine_current", "name": f"s{i}", "low": "4 mA", "high": "12 mA", "period": f"{period} s"}
                       for i, period in enumerate((2.4, 6.0))]
        result = hidden.run(**{**SCENARIO, "duration": "5 s", "controllers": controllers})
        cls.data = mckibben.Dataset({"runs": [
            {"id": f"r{i}", "load": f"{run.load_kg} kg",
             "data": {"time_s": numpy.round(run["time_s"], 9), "current_mA": run["current_mA"],
                      "contraction_ratio": run["encoder_contraction_ratio"]}} for i, run in enumerate(result.runs)]})

    def test_names_what_was_hidden(self):
        told = []
        found = self.data.diagnose(progress=lambda *news: told.append(news))
        self.assertEqual(found.verdict, "missing_effect", found.because)
        damping = found.rig.to_dict()["effects"]["viscous_damping"]["damping"]
        self.assertAlmostEqual(float(damping.split()[0]), 150.0, delta=10.0)
        self.assertEqual(found.to_dict()["verdict"], found.verdict)
        self.assertIn("viscous_damping", found.rig_yaml())
        self.assertIn("<html", found.report_html())
        self.assertGreater(len(told), 1)
        before, after = (data.gaps["contraction"]["rmse"] for data in (self.data.replay()[0], self.data.replay(rig=found.rig)[0]))
        self.assertLess(after, 0.5 * before)

    def test_ends_when_told_to(self):
        def enough(what, done, total):
            raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            self.data.diagnose(progress=enough)
        with self.assertRaises(ValueError):
            self.data.diagnose(time_limit_s=0.0)


main()
