"""Rigs, scenarios, results, rides and environments in pickles, in copies and from process to process."""
import copy
import multiprocessing
import pickle
import unittest

import numpy

import mckibben
from common import FALLS, ROOT, SCENARIO, main

LAW = {"name": "cord", "sentence": "a cord", "adds": "force", "law": "-k * x",
       "parameters": {"k": {"unit": "N/m", "typical": 300, "range": [0, 5000], "value": 400}}}
RIGS = ["thesis", "thesis_pair", "festo_dmsp_20", "home_made", {"effects": {"hypotheses": [LAW]}},
        {"muscle": {"rest_radius": "7.5 mm ± 0.1 mm", "rest_length": "30 cm ± unknown"}},
        {"valve": {"zero_command": "0 V", "span_command": "10 V",
                   "zero_pressure": "0.5 bar", "span_pressure": "5 bar"}}]
CURRENTS = 9.0 - 4.0 * numpy.cos(0.03 * numpy.arange(100))


def again(thing):
    return pickle.loads(pickle.dumps(thing))


def copies(thing):
    return again(thing), copy.copy(thing), copy.deepcopy(thing)


def run_of(scenario):
    return scenario.run(threads=1)


class Pickles(unittest.TestCase):
    def assertSameRun(self, one, other):
        self.assertEqual(one.samples.tobytes(), other.samples.tobytes())
        for what in ("name", "controller", "load_kg", "failure", "units", "meanings", "metrics", "gaps", "findings", "solver"):
            self.assertEqual(getattr(one, what), getattr(other, what), what)
        numpy.testing.assert_array_equal(one.target, other.target)

    def assertSameResult(self, one, other):
        self.assertEqual(len(one), len(other))
        for run, same in zip(one.runs, other.runs):
            self.assertSameRun(run, same)
        self.assertEqual((one.warnings, one.unmet, str(one)), (other.warnings, other.unmet, str(other)))
        self.assertEqual(one.to_dict(), other.to_dict())
        self.assertEqual(one.report_html(), other.report_html())

    def test_of_rigs(self):
        for source in RIGS:
            rig = mckibben.Rig(source)
            for same in copies(rig):
                self.assertEqual(same, rig)
                self.assertEqual(same.to_dict(), rig.to_dict())

    def test_of_scenarios_go_on_from_any_folder(self):
        for scenario in (mckibben.Scenario(ROOT / "scenarios/five_loads.yaml"), mckibben.Scenario(SCENARIO)):
            for same in copies(scenario):
                self.assertEqual((same.name, same.to_dict(), same.warnings),
                                 (scenario.name, scenario.to_dict(), scenario.warnings))
        self.assertEqual(again(scenario).run().to_dict(), scenario.run().to_dict())

    def test_of_results(self):
        result = mckibben.Scenario({**SCENARIO, "controllers": SCENARIO["controllers"] + [
            {"kind": "static_inverse", "assumed_load": "14 kg"}]}).run()
        for same in copies(result):
            self.assertSameResult(result, same)
        self.assertSameResult(result, again(again(result)))
        run = result[0]
        data = mckibben.Dataset({"runs": [{"id": "a", "load": "11.138 kg", "data": {
            name: run[column] for name, column in (("time_s", "time_s"), ("current_mA", "current_mA"),
                                                   ("contraction_ratio", "encoder_contraction_ratio"))}}]})
        self.assertSameResult(data.replay(), again(data.replay()))

    def test_of_runs_hold_columns_by_name(self):
        pair = mckibben.Ride("thesis_pair").follow(CURRENTS, CURRENTS[::-1])
        for run in (mckibben.Scenario(SCENARIO).run()[0], pair):
            state = list(run.__getstate__())
            self.assertEqual([column[0] for column in state[7]], list(run.units))
            self.assertSameRun(again(run), run)
            state[7] = [("no_such_column", False, 0)]
            with self.assertRaisesRegex(ValueError, "no_such_column: this version has no such column"):
                type(run).__new__(type(run)).__setstate__(tuple(state))

    def test_from_process_to_process(self):
        scenarios = [mckibben.Scenario({**SCENARIO, "seed": seed, "noise": {"encoder_jitter": 1e-4}}) for seed in (1, 2)]
        with multiprocessing.get_context("fork").Pool(2) as pool:
            for scenario, result in zip(scenarios, pool.map(run_of, scenarios)):
                self.assertSameResult(scenario.run(), result)

    def test_of_rides_go_on_to_the_same_bits(self):
        late = {"effects": {"command_delay": {"time": "30 ms"}, "bladder_creep": {"stiffness": "400 N/m", "time": "2 s"}}}
        for rig, load_kg in (("thesis", 11.0), (late, 14.0), ({"integrator": {"method": "cvode"}}, 14.0)):
            ride = mckibben.Ride(rig, load_kg=load_kg)
            ride.follow(CURRENTS)
            others = [*copies(ride), mckibben.Ride(rig, load_kg=load_kg)]
            others[-1].restore(again(ride.save()))
            run = ride.follow(CURRENTS)
            for other in others:
                self.assertEqual(other.follow(CURRENTS).samples.tobytes(), run.samples.tobytes())
                self.assertEqual(other.reading.time_s, again(ride.reading).time_s)
        pair = mckibben.Ride("thesis_pair")
        pair.follow(CURRENTS, CURRENTS[::-1])
        self.assertEqual(again(pair).step(12.0).angle_rad, pair.step(12.0).angle_rad)

    def test_that_were_spoilt_are_refused(self):
        ride = mckibben.Ride(load_kg=11.0)
        rig, state = ride.save().__getstate__()
        spoilt = mckibben.SavedRide.__new__(mckibben.SavedRide)
        for bad in (state[:-1], state + b"x", b""):
            with self.assertRaises(ValueError):
                spoilt.__setstate__((rig, bad))

    def test_of_batches_go_on_to_the_same_bits(self):
        late = {"effects": {"command_delay": {"time": "30 ms"}, "bladder_creep": {"stiffness": "400 N/m", "time": "2 s"}}}
        rigs = [*["thesis"] * 18, late, {"friction": {"memory": "coulomb"}}, {"integrator": {"method": "cvode"}}, FALLS]
        loads_kg = [*numpy.linspace(8.0, 25.0, len(rigs) - 1), 45.0]
        currents = numpy.tile(CURRENTS[:, None], len(rigs)) + numpy.linspace(0.0, 3.0, len(rigs))
        batch = mckibben.Batch(rigs, loads_kg)
        self.assertEqual(again(batch).state.tobytes(), batch.state.tobytes())
        batch.follow(currents[:37])
        batch.restart([2, 5], loads_kg=[9.0, 19.0])
        batch.follow(currents[37:50])
        others = copies(batch)
        rows = batch.follow(currents[50:])
        batch.restart([1])
        batch.step(9.0)
        for other in others:
            same = other.follow(currents[50:])
            for key, values in rows.items():
                self.assertEqual(same[key].tobytes(), values.tobytes(), key)
            other.restart([1])
            other.step(9.0)
            self.assertEqual(other.state.tobytes(), batch.state.tobytes())
            self.assertEqual(other.contraction_ratio.tobytes(), batch.contraction_ratio.tobytes())
            self.assertEqual((other.time_s, other.failures), (batch.time_s, batch.failures))
        self.assertEqual(list(batch.failures), [len(rigs) - 1])

    def test_of_environments_go_on_alike(self):
        env = mckibben.Env(duration_s=1.2, jitter=1e-4)
        env.reset(seed=3)
        for _ in range(20):
            env.step([0.1])
        others = copies(env)
        for _ in range(20):
            observation, reward = env.step([0.2])[:2]
            for other in others:
                same, its_reward = other.step([0.2])[:2]
                self.assertEqual((observation.tolist(), reward), (same.tolist(), its_reward))
        for other in others:
            numpy.testing.assert_array_equal(env.reset(seed=4)[0], other.reset(seed=4)[0])

        pair = mckibben.Env("thesis_pair", duration_s=1.2)
        pair.reset(seed=3)
        pair.step([0.3, 0.1])
        self.assertEqual(again(pair).step([0.1, 0.2])[0].tobytes(), pair.step([0.1, 0.2])[0].tobytes())

    def test_of_vector_environments_go_on_alike(self):
        envs = mckibben.VectorEnv(3, duration_s=0.6, jitter=1e-4, rig=mckibben.env.drawn_rig)
        self.assertEqual(again(envs).num_envs, 3)
        envs.reset(seed=3)
        for _ in range(20):
            envs.step([0.1, 0.2, 0.3])
        others = copies(envs)
        for _ in range(60):  # into the next episodes
            rows = envs.step([0.2, 0.0, 0.1])
            for other in others:
                for one, same in zip(rows[:4], other.step([0.2, 0.0, 0.1])):
                    self.assertEqual(one.tobytes(), same.tobytes())


main()
