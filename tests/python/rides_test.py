"""Ride, batch and slopes: where they go, to the bit, whatever runs beside them."""
import os
import signal
import threading
import unittest

import numpy

import mckibben
from common import FALLS, SCENARIO, main

CURRENTS = 9.0 - 4.0 * numpy.cos(0.03 * numpy.arange(200))


def reached(ride, currents):
    """All states on the way."""
    return numpy.array([(ride.step(current), ride.state.copy())[1] for current in currents])


class Rides(unittest.TestCase):
    def test_go_where_a_run_goes(self):
        for effects in ({}, {"reading_delay": {"time": "24 ms"}}):  # of whole ticks
            rig = mckibben.Rig({"integrator": {"tolerance": 1e-9}, "effects": effects})
            run, = mckibben.Scenario({**SCENARIO, "loads": ["11.138 kg"], "rig": rig}).run().runs
            ride = mckibben.Ride(rig, load_kg=11.138)
            self.assertEqual(rig, ride.rig)
            ride.start(float(run["current_mA"][0]))
            for k in range(len(run)):
                self.assertEqual(ride.reading.counts, run["counts"][k], k)
                self.assertAlmostEqual(ride.state[0], run["contraction_ratio"][k], delta=1e-7)
                self.assertAlmostEqual(ride.time_s, run["time_s"][k], delta=1e-12)
                ride.step(run["current_mA"][k])

    def test_go_on_from_what_was_saved_and_as_a_copy_to_the_same_bits(self):
        ride = mckibben.Ride(load_kg=14.0)
        reached(ride, CURRENTS[:50])
        saved, copy = ride.save(), ride.copy()
        first = reached(ride, CURRENTS[50:])
        ride.restore(saved)
        self.assertEqual(first.tobytes(), reached(ride, CURRENTS[50:]).tobytes())
        self.assertEqual(first.tobytes(), reached(copy, CURRENTS[50:]).tobytes())

    def test_follow_is_step_after_step(self):
        one, other = mckibben.Ride(load_kg=14.0), mckibben.Ride(load_kg=14.0)
        run = one.follow(CURRENTS)
        states = reached(other, CURRENTS)
        self.assertEqual(run["contraction_ratio"][1:].tobytes(), states[:-1, 0].tobytes())
        self.assertEqual(one.state.tobytes(), other.state.tobytes())
        self.assertEqual(one.reading.counts, other.reading.counts)

    def test_state_is_the_simulators_own(self):
        ride = mckibben.Ride(load_kg=11.138)
        state = ride.state
        before = state.copy()
        ride.step(9.0)
        self.assertGreater(state[2], before[2])
        with self.assertRaises(ValueError):
            state[0] = 0.1
        self.assertEqual(mckibben.Ride("thesis_pair").state.shape, (8,))

    def test_two_threads_give_the_same_bytes_as_one(self):
        def go(into, i):
            into[i] = reached(mckibben.Ride(load_kg=10.0 + i), numpy.tile(CURRENTS, 5)).tobytes()
        alone, beside = {}, {}
        for i in range(4):
            go(alone, i)
        threads = [threading.Thread(target=go, args=(beside, i)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(alone, beside)

    def test_python_goes_on_meanwhile(self):
        ride, seen = mckibben.Ride(load_kg=11.138), []

        def tried(job):
            try:
                job()
            except RuntimeError as error:
                seen.append(str(error))

        worker = threading.Thread(target=tried, args=(lambda: ride.follow(numpy.tile(CURRENTS, 500)),))
        worker.start()
        while worker.is_alive():
            tried(lambda: ride.step(9.0))  # whichever comes second is refused
        self.assertIn("it is at work in another thread", seen)

    def test_pressures_and_lengths_may_be_given(self):
        ride = mckibben.Ride(load_kg=11.138)
        ride.start(muscle_pressure_Pa=1e5)
        ride.step(muscle_pressure_Pa=2e5)
        self.assertEqual(ride.state[3], 2e5)
        bench = mckibben.Ride(load_kg=11.138)
        bench.start(8.0, contraction_ratio=0.05)
        bench.step(contraction_ratio=0.06)
        self.assertEqual(bench.state[0], 0.06)
        self.assertGreater(bench.moment["force_N"], 0.0)

    def test_a_lever_is_read_by_its_angle(self):
        ride = mckibben.Ride({"joint": {"highest_angle": "100 deg"}, "mechanics": {"kind": "lever"}}, load_kg=3.0)
        ride.start(8.0)
        for _ in range(150):
            ride.step(15.0)
        self.assertTrue(numpy.isnan(ride.reading.contraction_ratio))
        self.assertAlmostEqual(ride.reading.angle_rad, numpy.radians(0.25 * ride.reading.counts), delta=1e-12)
        # points 30 cm and 5 cm from the pivot, 150 deg apart at angle 0
        apart = lambda angle: numpy.sqrt(0.0925 - 0.03 * numpy.cos(numpy.radians(150.0) - angle))
        angle = ride.reading.angle_rad + numpy.radians(0.125)
        self.assertGreater(angle, 0.3)
        self.assertAlmostEqual(ride.state[0], (apart(0.0) - apart(angle)) / 0.3, delta=5e-4)
        run = ride.follow([15.0, 15.0])
        self.assertAlmostEqual(run["encoder_angle_rad"][0], run["angle_rad"][0], delta=numpy.radians(0.5))
        with self.assertRaisesRegex(ValueError, "not the angle of a lever"):
            mckibben.Batch({"mechanics": {"kind": "lever"}}, [1.0])

    def test_nonsense_is_refused(self):
        ride = mckibben.Ride(load_kg=11.138)
        for bad in (lambda: mckibben.Ride("thesis"), lambda: mckibben.Ride("thesis", load_kg=-1.0),
                    lambda: mckibben.Ride("thesis_pair", load_kg=1.0), lambda: ride.step(float("nan")),
                    lambda: ride.step(9.0, dt_s=0.0), lambda: ride.step(9.0, opposite_command=9.0),
                    lambda: ride.follow(numpy.ones((2, 2))), lambda: ride.follow([numpy.inf])):
            with self.assertRaises(ValueError):
                bad()
        with self.assertRaises(TypeError):
            ride.step("9 mA")
        for words, bad in (("load_kg = '8 kg': must be a number, in kg", lambda: mckibben.Ride(load_kg="8 kg")),
                           (r"loads_kg = \['8 kg', 9.0\]: must be numbers, in kg", lambda: mckibben.Batch("thesis", ["8 kg", 9.0])),
                           ("command = '9 mA': must be a number, in mA", lambda: ride.step("9 mA")),
                           ("dt_s = '1 s': must be a number, in s", lambda: ride.step(9.0, "1 s")),
                           (r"command = \['9 mA'\]: must be numbers, in mA", lambda: ride.follow(["9 mA"])),
                           ("command = '9 mA': must be numbers, in mA", lambda: mckibben.Batch("thesis", 8.0).step("9 mA")),
                           (r"command = \['9'\]: must be numbers, in mA", lambda: mckibben.Batch("thesis", 8.0).step(["9"])),
                           (r"command = array\(\[9\], .*: must be numbers", lambda: ride.follow(numpy.array([9], "m8[s]"))),
                           (r"command = \[None\]: must be numbers, in mA", lambda: ride.follow([None])),
                           (r"which = \[True, False\]: must be indices of rigs", lambda: mckibben.Batch("thesis", [8.0, 9.0]).restart([True, False])),
                           (r"which = 0: must be indices", lambda: mckibben.Batch("thesis", 8.0).restart(0)),
                           ("rig = 3: must be a name", lambda: mckibben.Batch(["thesis", 3], 8.0)),
                           ("^Ride: load is no argument; did you mean load_kg[?] There are rig, load_kg, jitter$", lambda: mckibben.Ride(load=8.0)),
                           ("^Ride.step: until_s is no argument; did you mean dt_s[?] There are command, dt_s, opposite_command", lambda: ride.step(9.0, until_s=1.0)),
                           ("^Dataset: path is no argument; there are source, folder$", lambda: mckibben.Dataset(path="x")),
                           ("^Ride.save: into is no argument; there are none$", lambda: ride.save(into="x"))):
            with self.assertRaisesRegex(TypeError, words):
                bad()

    def test_what_contradicts_itself_or_leaves_its_range_is_refused_and_changes_nothing(self):
        ride, pair = mckibben.Ride(load_kg=11.138), mckibben.Ride("thesis_pair")
        before = ride.copy()
        for words, bad in (
                ("command = 400: must be from 0 to 20 mA", lambda: ride.step(400)),
                ("command and muscle_pressure_Pa: give one", lambda: ride.step(9.0, muscle_pressure_Pa=2e5)),
                ("opposite_command and opposite_muscle_pressure_Pa: give one",
                 lambda: pair.step(9.0, opposite_command=9.0, opposite_muscle_pressure_Pa=2e5)),
                ("muscle_pressure_Pa = 1e\\+12: must be from -100000 to 1e\\+07 Pa", lambda: ride.step(muscle_pressure_Pa=1e12)),
                ("contraction_ratio = 0.99", lambda: ride.step(contraction_ratio=0.99)),
                ("no opposite one", lambda: ride.step(9.0, opposite_command=0.0)),
                ("no opposite one", lambda: ride.follow([9.0], [9.0])),
                (r"dt_s = 100000: must be above 0 and at most 60 s", lambda: ride.step(9.0, dt_s=1e5)),
                ("load_kg is missing", lambda: mckibben.Ride()), ("load_kg = nan: must be", lambda: mckibben.Ride(load_kg=numpy.nan)),
                ("load_kg = 0 kg: without a load nothing moves", lambda: mckibben.Ride({"joint": {"wheel_inertia": "0 kg.m2"}}, 0.0)),
                (r"loads_kg\[1\] = nan: must be from 0 to 500 kg", lambda: mckibben.Batch("thesis", [8.0, numpy.nan])),
                ("loads_kg has 3 masses for 2 rigs", lambda: mckibben.Batch(["thesis", "thesis"], [8.0, 9.0, 10.0])),
                (r"loads_kg\[0\] = -1", lambda: mckibben.Batch("thesis", [8.0]).restart([0], loads_kg=[-1.0])),
                ("load_kg = 300 kg: the taut threads of this muscle bear 147 kg", lambda: mckibben.Ride(load_kg=300.0)),
                (r"loads_kg\[1\] = 300 kg: the taut threads", lambda: mckibben.Batch("thesis", [8.0, 300.0])),
                (r"loads_kg\[0\] = 300 kg: the taut threads", lambda: mckibben.Batch("thesis", [8.0]).restart([0], loads_kg=[300.0])),
                (r"loads_kg has the shape \(n,\)", lambda: mckibben.Batch("thesis", [[8.0, 9.0], [8.0, 9.0]])),
                ("at_s", lambda: ride.start(12.0, at_s=float("nan"))),
                (r"command\[1\] = 21", lambda: ride.follow([9.0, 21.0])),
                (r"command\[1\] = nan", lambda: mckibben.Batch("thesis", [8.0, 9.0]).step([9.0, numpy.nan])),
                (r"command\[2, 1\] = -1", lambda: mckibben.Batch("thesis", [8.0, 9.0]).follow([[9, 9], [9, 9], [9, -1]]))):
            with self.assertRaisesRegex(ValueError, words):
                bad()
        self.assertEqual(ride.step(9.0).counts, before.step(9.0).counts)
        self.assertEqual(ride.state.tobytes(), before.state.tobytes())

    def test_follow_ends_at_a_valves_command_what_was_given_in_its_place(self):
        ride, same = mckibben.Ride(load_kg=11.138), mckibben.Ride(load_kg=11.138)
        for each in (ride, same):
            each.step(muscle_pressure_Pa=1e5)
        ride.follow(CURRENTS)
        reached(same, CURRENTS)
        self.assertEqual(ride.state.tobytes(), same.state.tobytes())

    def test_what_was_saved_of_another_rig_is_refused(self):
        creep = mckibben.Rig({"effects": {"bladder_creep": {"stiffness": "400 N/m", "time": "2 s"}}})
        rides = [mckibben.Ride("thesis_pair"), mckibben.Ride(load_kg=20.0), mckibben.Ride(creep, load_kg=20.0)]
        for one in rides:
            for other in rides:
                if one is not other:
                    with self.assertRaisesRegex(ValueError, "another rig"):
                        one.restore(other.save())
        rides[1].restore(mckibben.Ride("thesis", load_kg=20.0).save())

    def test_follow_is_ended_by_ctrl_c(self):
        long = numpy.tile(CURRENTS, 5_000)
        ride, batch = mckibben.Ride(load_kg=11.138), mckibben.Batch("thesis", [11.0])
        for follow in (lambda: ride.follow(long), lambda: batch.follow(long[:, None])):
            threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            with self.assertRaises(KeyboardInterrupt):
                follow()
        came_to = ride.time_s
        self.assertTrue(0.0 < came_to < 0.012 * len(long))
        self.assertAlmostEqual(ride.step(9.0).time_s, came_to + 0.012, places=9)
        with self.assertRaisesRegex(RuntimeError, "start it again"):
            batch.step(9.0)
        batch.start(9.0)
        batch.step(9.0)
        self.assertFalse(batch.failures)

    def test_commands_are_in_what_the_valve_takes(self):
        rig = mckibben.Rig({"valve": {"zero_command": "0 V", "span_command": "10 V",
                                      "zero_pressure": "0.5 bar", "span_pressure": "5 bar"}})
        self.assertEqual((rig.command_unit, rig.command_range), ("V", (0.0, 10.0)))
        volts, current = mckibben.Ride(rig, load_kg=14.0), mckibben.Ride(load_kg=14.0)
        run = volts.follow((CURRENTS - 4.0) / 1.6)
        self.assertEqual(run.units["command_V"], "V")
        same = current.follow(current_mA=CURRENTS)
        numpy.testing.assert_allclose(run["contraction_ratio"], same["contraction_ratio"], rtol=0, atol=1e-9)
        self.assertIn(("command_V", "V"), volts.linearise().inputs)
        batch = mckibben.Batch(rig, [14.0, 15.0])
        for refused in (lambda: volts.step(current_mA=9.0), lambda: batch.step(current_mA=9.0),
                        lambda: rig.dac_output_mA(9.0), lambda: mckibben.Batch([rig, mckibben.Rig()], [14.0, 15.0])):
            with self.assertRaises(ValueError):
                refused()
        with self.assertRaises(TypeError):
            current.step(9.0, current_mA=9.0)
        env = mckibben.Env(rig, duration_s=0.6)
        env.reset(seed=1)
        self.assertIn("command_V", env.step([0.0])[4])

    def test_a_failure_says_why(self):
        with self.assertRaises(mckibben.NumericalFailure) as caught:
            mckibben.Ride(FALLS, load_kg=45.0).step(9.0)
        self.assertIsInstance(caught.exception, ArithmeticError)


class Batches(unittest.TestCase):
    LOADS = numpy.linspace(8.0, 26.0, 40)

    def test_each_goes_where_it_goes_alone_on_any_threads(self):
        rig = mckibben.Rig({"integrator": {"tolerance": 1e-9}})
        currents = numpy.tile(CURRENTS[:, None], 40)
        rows = mckibben.Batch(rig, self.LOADS).follow(currents)
        on_two = mckibben.Batch(rig, self.LOADS, threads=2).follow(currents)
        self.assertEqual(rows["state"].tobytes(), on_two["state"].tobytes())
        for i in (0, 17, 39):
            alone = mckibben.Ride(rig, load_kg=self.LOADS[i]).follow(CURRENTS)
            numpy.testing.assert_allclose(rows["state"][:, i, 0], alone["contraction_ratio"], rtol=0, atol=1e-7)
        self.assertEqual(rows["contraction_ratio"].shape, (200, 40))
        self.assertFalse(rows["state"].flags.owndata)

    def test_step_is_a_row_of_follow(self):
        rigs = [mckibben.Rig(), mckibben.Rig({"friction": {"memory": "coulomb"}}), mckibben.Rig()]
        one, other = mckibben.Batch(rigs, [11.0, 12.0, 13.0]), mckibben.Batch(rigs, [11.0, 12.0, 13.0])
        rows = one.follow(numpy.tile(CURRENTS[:50, None], 3))
        for k in range(50):
            self.assertEqual(other.state.tobytes(), rows["state"][k].tobytes())
            other.step(CURRENTS[k])
        self.assertEqual(other.time_s, one.time_s)
        self.assertEqual(other.contraction_ratio.tolist(), one.contraction_ratio.tolist())

    def test_says_what_it_is(self):
        batch, ride = mckibben.Batch("thesis", self.LOADS), mckibben.Ride(load_kg=9.5)
        for each in (batch, ride):
            each.step(9.0)
        self.assertEqual((repr(batch), repr(ride)),
                         ("<mckibben.Batch at 0.012000 s: 40 rigs>", "<mckibben.Ride at 0.012000 s: 9.5 kg>"))

    def test_one_that_fails_fails_alone(self):
        batch = mckibben.Batch(["thesis", FALLS, "thesis"], [11.0, 45.0, 11.0])
        batch.step(9.0)
        self.assertEqual(list(batch.failures), [1])
        self.assertEqual(batch.state[0].tolist(), batch.state[2].tolist())

    def test_some_begin_again_and_the_others_go_on(self):
        rig, other = mckibben.Rig(), mckibben.Rig({"friction": {"scale": 2.0}})
        batch, without = mckibben.Batch(rig, self.LOADS), mckibben.Batch(rig, self.LOADS)
        for k in range(30):
            batch.step(CURRENTS[k])
            without.step(CURRENTS[k])
        batch.restart([3, 20], [rig, other], [9.0, 15.0])
        anew = mckibben.Batch([rig, other], [9.0, 15.0])
        for k in range(30):
            apart = abs(batch.state[[3, 20]] - anew.state).max(axis=0)  # their clocks differ, so do last digits
            self.assertTrue((apart < [1e-6, 1e-4, 1.0, 1.0, 1e-7]).all(), apart)
            batch.step(CURRENTS[k])
            without.step(CURRENTS[k])
            anew.step(CURRENTS[k])
        going = [i for i in range(40) if i not in (3, 20)]
        self.assertEqual(batch.state[going].tobytes(), without.state[going].tobytes())
        batch.restart(list(range(40)))  # all leave their places
        batch.step(9.0)
        self.assertEqual(batch.follow(numpy.full((5, 40), 9.0))["state"].shape, (5, 40, 5))
        for bad in (lambda: batch.restart([40]), lambda: batch.restart([1, 1]), lambda: batch.restart([1], None, [1.0, 2.0]),
                    lambda: batch.restart([1], [{"tick": "10 ms"}]), lambda: batch.restart([1], ["thesis_pair"])):
            with self.assertRaises((ValueError, IndexError)):
                bad()

    def test_nonsense_is_refused(self):
        batch = mckibben.Batch("thesis", [11.0, 12.0])
        for bad in (lambda: mckibben.Batch([], [11.0]), lambda: mckibben.Batch("thesis", [-1.0]),
                    lambda: mckibben.Batch("thesis_pair", [1.0]), lambda: batch.step([1.0, 2.0, 3.0]),
                    lambda: batch.step([numpy.nan, 1.0]), lambda: batch.follow(numpy.ones(4)),
                    lambda: mckibben.Batch(["thesis", {"tick": "10 ms"}], [11.0, 11.0])):
            with self.assertRaises(ValueError):
                bad()


class Slopes(unittest.TestCase):
    def test_are_those_of_a_ride_after_a_small_step(self):
        ride = mckibben.Ride({"integrator": {"tolerance": 1e-12}}, load_kg=11.138)
        for _ in range(60):
            ride.step(9.0)
        linear = ride.linearise()
        self.assertEqual([name for name, _ in linear.states],
                         ["contraction_ratio", "contraction_speed_per_s", "valve_pressure_Pa", "muscle_pressure_Pa", "bristle_m"])
        self.assertEqual([name for name, _ in linear.inputs], ["current_mA", "current_speed_mA_per_s", "load_force_N"])
        self.assertEqual((linear.A.shape, linear.B.shape, linear.C.shape, linear.D.shape), ((5, 5), (5, 3), (3, 5), (3, 3)))
        numpy.testing.assert_array_equal(linear.state, ride.state)
        dt_s, step_mA = 1e-3, 1e-3
        up, down = ride.copy(), ride.copy()
        up.step(9.0 + step_mA, dt_s)
        down.step(9.0 - step_mA, dt_s)
        term = expected = linear.B[:, 0] * 2.0 * step_mA * dt_s
        for k in range(2, 20):
            term = linear.A @ term * dt_s / k
            expected = expected + term
        moved = up.state - down.state
        numpy.testing.assert_allclose(moved[2:4], expected[2:4], rtol=0.02)

    def test_where_there_are_none_it_says_so(self):
        ride = mckibben.Ride(load_kg=11.138)
        ride.step(muscle_pressure_Pa=1e5)
        with self.assertRaisesRegex(ValueError, "linearise"):
            ride.linearise()


main()
