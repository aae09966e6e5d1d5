"""Rigs, scenarios and data sets from files and dicts: the same readers, the same words."""
import enum
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy

import mckibben
from common import ROOT, SCENARIO, main

PROGRAM = sys.argv[1]


class Rigs(unittest.TestCase):
    def test_the_text_of_a_file_is_no_path(self):
        text = "schema: mckibben-rig/1\nbase: thesis\n"
        with self.assertRaisesRegex(ValueError, "^rig: this looks like the text of a file: give the file's path"):
            mckibben.Rig(text)

    def test_by_name_path_and_dict(self):
        thesis = mckibben.Rig()
        self.assertEqual(thesis, mckibben.Rig("thesis"))
        self.assertEqual(thesis, mckibben.Rig(ROOT / "scenarios/rigs/thesis.yaml"))
        self.assertEqual(thesis, mckibben.Rig(thesis.to_dict()))
        other = mckibben.Rig({"base": "thesis", "tick": "10 ms"})
        self.assertEqual(other.tick_s, 0.01)
        self.assertNotEqual(thesis, other)
        self.assertTrue(mckibben.Rig("thesis_pair").pair)
        self.assertEqual(mckibben.Rig("thesis_pair"), mckibben.Rig(mckibben.Rig("thesis_pair").to_dict()))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rig.yaml"
            for name in ("thesis", "thesis_pair"):
                path.write_text(mckibben.Rig(name).to_yaml())
                self.assertEqual(mckibben.Rig(name), mckibben.Rig(path))

    def test_what_is_wrong_in_a_dict_is_told_with_its_path_value_and_rule(self):
        with self.assertRaises(mckibben.InputError) as caught:
            mckibben.Rig({"hose": {"length": 2}, "muscle": {"rest_length": "30 s"}, "tick": "12 ms"})
        problems = {problem.path: problem for problem in caught.exception.problems}
        self.assertEqual(set(problems), {"hose.length", "muscle.rest_length"})
        self.assertIn("30 s", problems["muscle.rest_length"].message)
        self.assertIn("muscle.rest_length", str(caught.exception))
        self.assertIsNone(problems["muscle.rest_length"].line)
        self.assertIsInstance(caught.exception, ValueError)

    def test_what_is_wrong_in_a_file_is_told_as_the_command_line_tells_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rig.yaml"
            path.write_text("schema: mckibben-rig/1\nbase: thesis\ntick: 12\n")
            said = subprocess.run([PROGRAM, "check", path], capture_output=True, text=True).stderr
            with self.assertRaises(mckibben.InputError) as caught:
                mckibben.Rig(path)
        problem, = caught.exception.problems
        self.assertEqual((problem.file, problem.line, problem.column), (str(path), 3, 7))
        self.assertIn(str(caught.exception), said)

    def test_what_is_missing(self):
        for name in ("thesiss", "no/such.yaml"):
            with self.assertRaises(mckibben.MissingInput):
                mckibben.Rig(name)
        with self.assertRaisesRegex(mckibben.MissingInput, "gone.yaml"):
            mckibben.Scenario({**SCENARIO, "rig": "gone.yaml"})
        with self.assertRaises(FileNotFoundError):
            mckibben.Dataset("no/such/folder")

    def test_nonsense_is_refused(self):
        for nonsense in (5, None, [1], {"tick": {1: 2}}, {"tick": object()}):
            with self.assertRaises(TypeError):
                mckibben.Rig(nonsense)
        with self.assertRaisesRegex(TypeError, r"rig = \[1\]: must be a name, a path or a dict"):
            mckibben.Rig([1])
        with self.assertRaisesRegex(ValueError, r"targets must be a list: \[\{angle: ..., stiffness: ...\}\]"):
            mckibben.Rig("thesis_pair").run(duration="1 s", targets={"angle": {}, "stiffness": {}}, controllers=[{"kind": "pid"}])
        with self.assertRaises(mckibben.InputError):
            mckibben.Rig({"tick": float("nan")})
        with self.assertRaises(mckibben.InputError):
            mckibben.Rig({"a: b\n\"c": "x\ty"})


    def test_dicts_without_an_end_are_refused(self):
        def nested(kind, levels=100_000):
            made = "12 ms"
            for _ in range(levels):
                made = {"tick": made} if kind is dict else [made]
            return made

        class Again:
            def tolist(self):
                return self

        in_itself, in_its_list = {}, []
        in_itself["muscle"], in_its_list[:] = in_itself, [in_its_list]
        for endless in (in_itself, {"loads": in_its_list}, nested(dict), {"loads": nested(list)}, {"tick": Again()}):
            for reader in (mckibben.Rig, mckibben.Scenario, mckibben.Dataset):
                with self.assertRaisesRegex(mckibben.InputError, "nested deeper than 32 levels"):
                    reader(endless)

    def test_texts_that_no_file_can_hold_are_refused(self):
        for nonsense in ({"name": "\ud800"}, {"\ud800": 1}, "the\0sis", "\ud800"):
            with self.assertRaises(ValueError):
                mckibben.Rig(nonsense)

    def test_numbers_are_numbers_whatever_they_print(self):
        class Seed(enum.IntEnum):
            SEVEN = 7

        self.assertEqual(mckibben.Scenario({**SCENARIO, "seed": Seed.SEVEN}).to_dict()["seed"], 7)


class Scenarios(unittest.TestCase):
    def test_by_path_and_dict(self):
        path = ROOT / "scenarios/five_loads.yaml"
        scenario = mckibben.Scenario(path)
        self.assertEqual(scenario.name, "five_loads")
        again = mckibben.Scenario(scenario.to_dict(), folder=ROOT / "scenarios")
        self.assertEqual(again.to_dict(), scenario.to_dict())
        self.assertEqual(repr(mckibben.Scenario({**SCENARIO, "name": "swing"})),
                         "<mckibben.Scenario swing: one muscle, rest length 0.300000 m; loads 11.138, 16.138 kg; "
                         "controller sine_current; 1.2 s>")

    def test_numpy_paths_and_rigs_stand_in_dicts(self):
        rig = mckibben.Rig({"tick": "10 ms"})
        scenario = mckibben.Scenario({**SCENARIO, "rig": rig, "seed": numpy.int64(7)})
        self.assertEqual(scenario.rig, rig)
        self.assertEqual(scenario.to_dict()["seed"], 7)
        self.assertEqual(scenario.target.shape, (120,))

    def test_currents_make_it_one_of_a_pair(self):
        current = {"kind": "sine_current", "low": "5 mA", "high": "9 mA", "period": "1 s"}
        scenario = mckibben.Scenario({"duration": "1 s", "currents": [{"current_1": current, "current_2": current}]})
        self.assertTrue(scenario.rig.pair)
        self.assertIsNone(scenario.target)
        self.assertRegex(repr(scenario), r": two muscles, .*; load 0 kg; current c01; 1 s>$")

    def test_warnings_are_warnings(self):
        with self.assertWarnsRegex(mckibben.InputWarning, "noise.gauge has no effect"):
            scenario = mckibben.Scenario({**SCENARIO, "noise": {"gauge": "1 mbar"}})
        self.assertEqual(len(scenario.warnings), 1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(mckibben.InputWarning):
                mckibben.Scenario({**SCENARIO, "noise": {"gauge": "1 mbar"}})

    def test_warnings_point_at_who_wrote_it(self):
        env = mckibben.Env(duration_s=0.6, loads_kg=11.0)
        env.reset(seed=1)
        for warned in (lambda: mckibben.Scenario({**SCENARIO, "noise": {"gauge": "1 mbar"}}),
                       lambda: env.scenario([{"kind": "pid"}], noise={"gauge": "1 mbar"}),
                       lambda: mckibben.Rig().run(**{**SCENARIO, "noise": {"gauge": "1 mbar"}})):
            with self.assertWarns(mckibben.InputWarning) as caught:
                warned()
            self.assertEqual(caught.filename, __file__)


class Datasets(unittest.TestCase):
    def test_tables_may_be_arrays(self):
        k = numpy.arange(300)
        columns = {"time_s": k * 0.012, "current_mA": 8.0 - 3.0 * numpy.cos(0.02 * k),
                   "contraction_ratio": numpy.full(300, 0.05)}
        data = mckibben.Dataset({"runs": [{"id": "a", "load": "11.138 kg", "data": columns}]})
        self.assertEqual(data.ids, ["a"])
        with self.assertRaises(mckibben.InputError) as caught:
            spoilt = {**columns, "current_mA": numpy.where(k == 2, 99.0, columns["current_mA"])}
            mckibben.Dataset({"runs": [{"id": "a", "load": "11.138 kg", "data": columns},
                                       {"id": "b", "load": "11.138 kg", "data": spoilt}]})
        self.assertIn("runs[1].data['current_mA'][2]", [problem.path for problem in caught.exception.problems])
        self.assertRegex(str(caught.exception), r"^dataset: runs\[1\].data\['current_mA'\]\[2\]: .*99")
        self.assertNotIn("csv", str(caught.exception))
        with self.assertRaisesRegex(mckibben.InputError, r"^dataset: runs\[0\].data: "):
            mckibben.Dataset({"runs": [{"id": "a", "load": "11.138 kg", "data": {"time_s": [0.0, 0.012]}}]})
        for bad, where in ((5, r"runs\[0\].data: "), ({"time_s": ["x"]}, r"runs\[0\].data\['time_s'\]: ")):
            with self.assertRaisesRegex((TypeError, ValueError), where):
                mckibben.Dataset({"runs": [{"id": "a", "load": "11.138 kg", "data": bad}]})
        with self.assertRaisesRegex(ValueError, "one length"):
            mckibben.Dataset({"runs": [{"id": "a", "load": "1 kg", "data": {"time_s": [0, 1], "current_mA": [1]}}]})

    def test_what_is_wrong_is_told_with_its_path(self):
        with self.assertRaises(mckibben.InputError) as caught:
            mckibben.Dataset({"runs": [{"id": "a", "file": "a.csv", "load": "5 m"}]})
        self.assertEqual(caught.exception.problems[0].path, "runs[0].load")


main()
