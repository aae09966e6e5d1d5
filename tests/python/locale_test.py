"""A decimal comma, as programs with windows set it at their start, changes nothing."""
import os
import subprocess
import sys
import tempfile
import unittest

from common import main

SCRIPT = """
import locale, sys
if sys.argv[1]: print(locale.setlocale(locale.LC_ALL, sys.argv[1]), locale.str(1.5), file=sys.stderr)
import mckibben, numpy
rig = mckibben.Rig({"valve": {"volume": "20.5 cm3"}, "tick": "12.5 ms", "muscle": {"rest_radius": "7.5 mm ± 1.5 %"},
                    "effects": {"hypotheses": [{"name": "h", "sentence": "s", "adds": "force", "law": "-k * 1.5 * x / 2.5 [mm]",
                        "parameters": {"k": {"unit": "N", "typical": 1.5, "range": [0, 10.5], "value": 2.5}}}]}})
print(rig, rig.to_dict())
result = rig.run(loads=["11.5 kg"], duration="1.25 s", target={"kind": "sine", "mean": 0.05, "amplitude": 0.02, "period": "1.5 s"},
                 controllers=[{"kind": "sine_current", "low": "4.5 mA", "high": "9 mA", "period": "1 s"}])
print(result, result.to_dict(), result.report_html())
t = numpy.arange(200) * 0.012
data = mckibben.Dataset({"runs": [{"id": "a", "load": "11.5 kg", "data": {
    "time_s": t.round(9), "current_mA": numpy.full(200, 8.25), "contraction_ratio": numpy.linspace(0, .1, 200)}}]})
replayed = data.replay()
print(replayed, replayed.report_html(), replayed[0].gaps)
ride = mckibben.Ride(rig, 11.138)
print(ride.step(9.3), ride.state)
for bad in ({"valve": {"volume": "2.5 kg"}}, {"tick": "1,5 s"}):
    try: mckibben.Rig(bad)
    except mckibben.InputError as error: print(error)
try: ride.step(400.5)
except ValueError as error: print(error)
"""


class ADecimalComma(unittest.TestCase):
    def said(self, folder, locale):
        done = subprocess.run([sys.executable, "-c", SCRIPT, locale], capture_output=True, text=True,
                              env={**os.environ, "LOCPATH": folder, "PYTHONIOENCODING": "utf-8"})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", f"{folder}/de_DE.UTF-8"], check=True)
            comma = self.said(folder, "de_DE.UTF-8")
            self.assertIn("1,5", comma.stderr)
            self.assertEqual(comma.stdout, self.said(folder, "").stdout)


main()
