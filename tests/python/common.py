"""What the tests of Python's module share; each file is run by ctest, with the built package on its path."""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = {"loads": ["11.138 kg", "16.138 kg"], "duration": "1.2 s",
            "target": {"kind": "sine", "mean": 0.05, "amplitude": 0.02, "period": "1 s"},
            "controllers": [{"kind": "sine_current", "low": "5 mA", "high": "9 mA", "period": "1 s"}]}
FALLS = {"muscle": {"stop_stiffness": "1e5 N/m"},  # the threads bear the load, but not with what the effect adds
         "effects": {"residual_law": {"terms": [{"of": "m g", "coefficient": "-800 N"}]}}}


def main():
    unittest.main(argv=sys.argv[:1])
