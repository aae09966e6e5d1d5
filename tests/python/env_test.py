"""The environment for learning controllers: its contract, with and without Gymnasium."""
import enum
import importlib
import inspect
import sys
import types
import unittest
from unittest import mock

import numpy

import mckibben
import mckibben.env
from common import main


def episode(env, seed):
    observation, info = env.reset(seed=seed)
    rows, ended = [observation], False
    while not ended:
        observation, reward, terminated, truncated, info = env.step([0.1])
        assert env.observation_space.contains(observation), observation
        rows.append(numpy.append(observation, reward))
        ended = terminated or truncated
    return rows, info


class Env(unittest.TestCase):
    def test_the_same_seed_gives_the_same_episode(self):
        env = mckibben.Env(duration_s=2.4, jitter=1e-3)
        (first, info), (again, _), (other, _) = episode(env, 5), episode(env, 5), episode(env, 6)
        self.assertEqual(len(first), 200)
        self.assertEqual([row.tobytes() for row in first], [row.tobytes() for row in again])
        self.assertNotEqual([row.tobytes() for row in first], [row.tobytes() for row in other])
        self.assertGreater(info["true_contraction_ratio"], 0.01)

    def test_loads_are_drawn_or_asked_for(self):
        self.assertEqual(mckibben.Env(loads_kg=(10, 9)).loads_kg, (9.0, 10.0))
        self.assertIsNone(mckibben.Env("thesis_pair").loads_kg)
        env = mckibben.Env(loads_kg=(9.0, 10.0), duration_s=1.0)
        loads = {env.reset(seed=seed)[1]["load_kg"] for seed in range(5)}
        self.assertEqual(len(loads), 5)
        self.assertTrue(all(9.0 <= load <= 10.0 for load in loads))
        self.assertEqual(env.reset(options={"load_kg": 15.0})[1]["load_kg"], 15.0)

    def test_loads_are_of_the_rig_if_left_out(self):
        for rig in ("thesis", "festo_dmsp_5", "festo_dmsp_40"):
            env = mckibben.Env(rig, duration_s=3.0)
            self.assertEqual(env.loads_kg, (0.75 * mckibben.Rig(rig).usual_load_kg, 1.5 * mckibben.Rig(rig).usual_load_kg))
            env.reset(seed=1, options={"load_kg": env.loads_kg[1]})
            for _ in range(240):
                info = env.step([1.0])[4]
            self.assertGreater(info["true_contraction_ratio"], 0.05, rig)

    def test_loads_are_of_the_rig_that_is_drawn_if_left_out(self):
        def light_or_heavy(random):
            return "festo_dmsp_5" if random.random() < 0.5 else "festo_dmsp_40"

        for rig in (light_or_heavy, ["festo_dmsp_5", "festo_dmsp_40"]):
            env = mckibben.Env(rig, duration_s=0.1)
            drawn = set()
            for seed in range(6):
                load_kg = env.reset(seed=seed)[1]["load_kg"]
                self.assertEqual(env.loads_kg, (0.75 * env.rig.usual_load_kg, 1.5 * env.rig.usual_load_kg))
                self.assertTrue(env.loads_kg[0] <= load_kg <= env.loads_kg[1])
                drawn.add(env.rig.usual_load_kg)
            self.assertEqual(len(drawn), 2)

    def test_all_rigs_of_one_muscle_have_one_space(self):
        spaces = [mckibben.Env(rig, duration_s=1.0).observation_space for rig in ("thesis", "festo_dmsp_20", mckibben.env.drawn_rig)]
        self.assertEqual(spaces[0], spaces[1])
        self.assertEqual(spaces[0], spaces[2])
        self.assertNotEqual(spaces[0], mckibben.Env().action_space)
        with mckibben.Env(duration_s=1.0) as env:
            self.assertEqual(env.observation_space, spaces[0])

    def test_a_member_of_many_leaves_the_recording_of_one(self):
        many, one = mckibben.VectorEnv(2, duration_s=1.2), mckibben.Env(duration_s=1.2)
        many.reset(seed=4)
        one.reset(seed=5)
        for _ in range(20):
            many.step([[0.3], [0.2]])
            one.step([0.2])
        member, alone = many.episodes[1].recording(), one.recording()
        self.assertEqual(member["load"], alone["load"])
        for key, values in alone["data"].items():
            numpy.testing.assert_allclose(member["data"][key], values, atol=1e-9)
        numpy.testing.assert_allclose(many.episodes[1].history["reward"], one.history["reward"], atol=1e-9)

    def test_its_history_is_there_to_be_plotted(self):
        env = mckibben.Env(duration_s=0.6)
        env.reset(seed=1)
        rewards = [env.step([0.2])[1] for _ in range(10)]
        history = env.history
        self.assertEqual(history["reward"].tolist(), rewards)
        self.assertEqual(history["target"].tolist(), list(env.target[1:11]))
        numpy.testing.assert_allclose(history["reward"],
                                      -100.0 * abs(history["contraction_ratio"] - history["target"]), atol=1e-12)
        env.reset(seed=1)
        self.assertEqual(len(env.history["time_s"]), 0)

    def test_rigs_that_lift_no_load_are_refused(self):
        for kind in ("lever", "held_length"):
            with self.assertRaisesRegex(ValueError, f"a pair of muscles; this rig's mechanics are {kind}"):
                mckibben.Env(rig={"joint": {"highest_angle": "100 deg"} if kind == "lever" else {},
                                  "mechanics": {"kind": kind}})

    def test_two_muscles_turn_a_joint(self):
        env = mckibben.Env("thesis_pair", duration_s=2.4)
        self.keeps_gymnasiums_conventions(mckibben.Env("thesis_pair", duration_s=2.4, jitter=1e-4))
        env.reset(seed=1)
        for _ in range(100):
            observation, reward, _, _, info = env.step([0.3, -0.3])
        angle, _, target, *action = observation
        self.assertAlmostEqual(angle, 0.227, delta=0.02)  # what a Ride comes to
        ride = mckibben.Ride("thesis_pair")
        for _ in range(100):
            ride.step(info["current_1_mA"], opposite_command=info["current_2_mA"])
        self.assertEqual(numpy.float32(ride.reading.angle_rad), angle)
        self.assertAlmostEqual(info["true_angle_rad"], angle, delta=0.005)  # a count
        self.assertNotIn("true_contraction_ratio", info)
        self.assertAlmostEqual(target, numpy.radians(15.0) * numpy.sin(2.0 * numpy.pi * 1.2 / 4.0), places=6)
        self.assertEqual(action, [numpy.float32(0.3), numpy.float32(-0.3)])
        self.assertAlmostEqual(reward, -100.0 * abs(float(angle) - float(target)), places=3)
        self.assertEqual((env.history["angle_rad"][-1], env.history["opposite_command"][-1]),
                         (ride.reading.angle_rad, info["current_2_mA"]))
        for said, bad in (("loads_kg = .*: must be left out", lambda: mckibben.Env("thesis_pair", loads_kg=(1.0, 2.0))),
                          (r"of shape \(2,\)", lambda: env.step([0.1])), ("load_kg: must be left out; no load hangs on a pair", lambda: env.reset(options={"load_kg": 9.0})),
                          ("all rigs of an environment", lambda: mckibben.Env(["thesis", "thesis_pair"])),
                          ("drawn_target draws contraction ratios", lambda: mckibben.Env("thesis_pair", target=mckibben.env.drawn_target)),
                          ("VectorEnv is of rigs with one muscle", lambda: mckibben.VectorEnv(2, "thesis_pair")),
                          ("must have two muscles here; Track-v0 is of one", lambda: mckibben.env.PairEnv(mckibben.env.drawn_rig))):
            with self.assertRaisesRegex(ValueError, said):
                bad()
        drawn = mckibben.env.PairEnv(lambda random: {**mckibben.env.drawn_rig(random), "base": "thesis_pair"})  # as it says
        drawn.reset(seed=1)
        side = drawn.rig.to_dict()["mechanics"]["opposite"]
        self.assertEqual(side["muscle"]["rest_radius"], drawn.rig.to_dict()["muscle"]["rest_radius"])

    def test_nothing_is_done_out_of_order(self):
        env = mckibben.Env(duration_s=0.036)
        with self.assertRaises(RuntimeError):
            env.step([0.0])
        env.reset(seed=1)
        for no_action in ([float("nan")], [], [0.1, 0.2], "a", None, "0.1", ["0.1"], [True], [b"1"], numpy.array([1], "m8[s]")):
            with self.assertRaisesRegex(ValueError, r"must be numbers of shape \(1,\) or one number$|^action\[0\] = nan: must be finite$"):
                env.step(no_action)
        with self.assertRaisesRegex(TypeError, "rig = 3: must be a name, a path or a dict"):
            mckibben.Env(rig=3)
        for key, value, said in (
                ("rig", [], "rig: a list of one at least"), ("target", [], "target: a list of one at least"),
                ("loads_kg", (5.0,), r"loads_kg = \(5.0,\): one mass, or the lightest and the heaviest"),
                ("loads_kg", -11.0, "loads_kg.*-11"), ("target", numpy.zeros(5), r"target: numbers need their times: {'kind': 'points', 'points': numpy.c_\["), ("loads_kg", ("8 kg", 9.0), r"loads_kg\[0\] = '8 kg': must be a number"),
                ("loads_kg", (8.0, numpy.nan), r"loads_kg\[1\] = nan: must be a number from 0 to 500 kg"),
                ("jitter", -1, "jitter = -1: must be a number from 0 to 1"), ("jitter", "1e-3", "jitter = '1e-3'"),
                ("duration_s", "6 s", "duration_s = '6 s': must be a number from 0.0001 to 3600 s")):
            for make in (mckibben.Env, mckibben.VectorEnv):
                with self.assertRaisesRegex(ValueError, said):
                    make(**{key: value})
        for make in (mckibben.Env, mckibben.VectorEnv):
            make(render_mode=None)
            with self.assertRaisesRegex(ValueError, "render_mode = 'human': must be None"):
                make(render_mode="human")
            refused, other = make(), make()
            for each in (refused, other):
                each.reset(seed=3)
            there = "is load_kg" if make is mckibben.Env else "are load_kg and reset_mask"
            with self.assertRaisesRegex(ValueError, f"'loadkg' is unknown; there {there}$"):
                refused.reset(seed=9, options={"loadkg": 1.0})
            for load_kg in ("8 kg", numpy.nan):
                with self.assertRaisesRegex(ValueError, f"options: load_kg = {load_kg!r}: must be a number from 0 to 500"):
                    refused.reset(seed=9, options={"load_kg": load_kg})
            with self.assertRaisesRegex(ValueError, r"^options = \[1\]: must be a dict"):
                refused.reset(options=[1])
            with self.assertRaisesRegex(ValueError, "^options: load_kg = 300 kg: the taut threads of this muscle bear 147 kg"):
                refused.reset(seed=9, options={"load_kg": 300})
            with self.assertRaisesRegex(ValueError, r"^loads_kg\[1\] = 300 kg: the taut threads of this muscle bear 147 kg"):
                make(loads_kg=(8.0, 300.0))
            with self.assertRaisesRegex(ValueError, r"^loads?_kg.* = 300 kg: the taut threads of this muscle bear"):
                make(rig=lambda random: "thesis").reset(options={"load_kg": 300.0})
            for seed in ("a", -1, 1.5):
                with self.assertRaisesRegex(ValueError, f"seed = {seed!r}: must be a whole number"):
                    refused.reset(seed=seed)
            self.assertEqual(refused.reset()[1]["load_kg"], other.reset()[1]["load_kg"], "its seed is not taken")
        self.assertFalse(env.step(env.action_space.sample())[3])
        self.assertTrue(env.step([5.0])[3])
        with self.assertRaises(RuntimeError):
            env.step([0.0])
        with self.assertRaises(mckibben.InputError):
            mckibben.Env(target={"kind": "sine"})
        for short in (0.012, 0.0001):
            with self.assertRaisesRegex(ValueError, f"duration_s = {short}: must be two ticks at least, of 0.012 s"):
                mckibben.Env(duration_s=short)
        with self.assertRaisesRegex(ValueError, "target: the function that draws it failed.*KeyError: 'speed'"):
            mckibben.Env(target=lambda random: {}["speed"])
        self.assertEqual(env.reset(seed=numpy.int64(3))[1], env.reset(seed=3)[1])

        def fails(**commands):
            raise mckibben.NumericalFailure("too stiff")
        env.ride = types.SimpleNamespace(step=fails, reading=env.ride.reading, state=[0.0], time_s=0.0)
        self.assertEqual(env.step([0.0])[2:4], (True, False))
        with self.assertRaisesRegex(RuntimeError, "the episode has ended"):
            env.step([0.0])

    def test_rigs_and_targets_are_drawn_from_the_seed(self):
        env = mckibben.Env(rig=mckibben.env.drawn_rig, target=mckibben.env.drawn_target, duration_s=1.2)
        drawn = []
        for seed in (1, 1, 2):
            env.reset(seed=seed)
            drawn.append((env.rig.to_dict()["muscle"]["rest_radius"], env.target.tobytes()))
        self.assertEqual(drawn[0], drawn[1])
        self.assertNotEqual(drawn[0][0], drawn[2][0])
        self.assertNotEqual(drawn[0][1], drawn[2][1])
        several = mckibben.Env(rig=["thesis", {"friction": {"scale": 2.0}}], duration_s=1.2,
                               target=[{"kind": "sine", "mean": mean, "amplitude": 0.01, "period": "2 s"} for mean in (0.05, 0.1)])
        seen = {(several.reset(seed=seed), several.rig is several.task.rig[1], round(several.target.mean(), 2))[1:]
                for seed in range(20)}
        self.assertEqual(len(seen), 4)
        with self.assertRaisesRegex(ValueError, "read-only"):
            several.target[:] = 0.0

    def test_a_target_of_an_array(self):
        times, ratios = numpy.arange(0.0, 3.0, 0.1), 0.1 + 0.02 * numpy.sin(numpy.arange(30))
        env = mckibben.Env(target={"kind": "points", "points": numpy.c_[times, ratios]}, duration_s=2.4)
        numpy.testing.assert_allclose(env.target, numpy.interp(0.012 * numpy.arange(200), times, ratios), atol=1e-12)
        for points in (list(zip(times, ratios)), [[0, numpy.float32(0.1)], (numpy.int64(1), "30 mm"), {"at": "2 s", "to": 0.1}]):
            self.assertAlmostEqual(mckibben.Env(target={"kind": "points", "points": points}, duration_s=2.4).target[0], 0.1, 7)
        pair = mckibben.Env(rig="thesis_pair", target={"kind": "points", "points": [[0.0, 0.1], [3.0, 0.4]]}, duration_s=2.4)
        numpy.testing.assert_allclose(pair.target[[0, 125]], [0.1, 0.25], atol=1e-9)
        with self.assertRaisesRegex(mckibben.InputError, r"^scenario: target\.points\[0\]: .*not a list") as raised:
            mckibben.Env(target={"kind": "points", "points": numpy.zeros((331, 3))})
        self.assertEqual(len(raised.exception.problems), 20)
        self.assertTrue(str(raised.exception).endswith("; and 311 more like it"))

    def keeps_gymnasiums_conventions(self, env):
        """What Gymnasium's own checker of environments (1.x: check_env and its passive checks) wants to see."""
        for space, box in ((env.action_space, True), (env.observation_space, False)):
            self.assertTrue((space.low.shape, space.high.shape) == (space.shape, space.shape))
            self.assertTrue((space.low < space.high).all() and numpy.isfinite([space.low, space.high]).all())
            if box:
                self.assertTrue((space.low == -space.high).all() and (abs(space.high) <= 1.0).all())
        parameters = inspect.signature(env.reset).parameters
        self.assertIsNone(parameters["seed"].default)
        self.assertIn("options", parameters)
        self.assertNotIn("return_info", parameters)
        self.assertFalse(callable(getattr(env, "seed", None)))
        self.assertIs(env.unwrapped, env)
        self.assertIsNone(env.spec)
        env.reset(options={})
        again = [env.reset(seed=123)[0].tobytes() for _ in range(2)]
        self.assertEqual(*again)
        states = []
        for seed in (123, 123, 456):
            observation, info = env.reset(seed=seed)
            self.assertIn(observation, env.observation_space)
            self.assertEqual(observation.dtype, env.observation_space.dtype)
            self.assertIsInstance(info, dict)
            states.append(repr(env.unwrapped._np_random.bit_generator.state))
        self.assertEqual(states[0], states[1])
        self.assertNotEqual(states[0], states[2])
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
        self.assertIn(observation, env.observation_space)
        self.assertIsInstance(observation, numpy.ndarray)
        self.assertTrue(numpy.isfinite(reward))
        self.assertEqual([type(one) for one in (reward, terminated, truncated, info)], [float, bool, bool, dict])
        before = repr(env.np_random.bit_generator.state)
        env.reset()  # goes on with chance where it was
        self.assertNotEqual(repr(env.np_random.bit_generator.state), before)
        self.assertEqual((env.metadata["render_modes"], env.render_mode), ([], None))
        env.close()
        env.close()

    def test_is_one_of_gymnasiums_where_that_is_installed(self):
        self.keeps_gymnasiums_conventions(mckibben.Env())
        gymnasium = types.ModuleType("gymnasium")
        here = mckibben.env.Base
        gymnasium.Env = type("Env", (), {"_np_random": None, "np_random": here.np_random, "unwrapped": here.unwrapped,
                                         "reset": here.reset, "spec": None})
        gymnasium.spaces = types.SimpleNamespace(Box=mckibben.env.Box)
        gymnasium.registry = {}
        gymnasium.register = lambda id, **spec: gymnasium.registry.update({id: spec})
        vector = types.ModuleType("gymnasium.vector")
        vector.VectorEnv = type("VectorEnv", (), {"reset": here.reset, "np_random": here.np_random})
        vector.AutoresetMode = enum.Enum("AutoresetMode", {"NEXT_STEP": "NextStep", "SAME_STEP": "SameStep",
                                                           "DISABLED": "Disabled"})
        try:
            with mock.patch.dict(sys.modules, {"gymnasium": gymnasium, "gymnasium.vector": vector}):
                module = importlib.reload(importlib.reload(mckibben.env))
            self.assertTrue(issubclass(module.Env, gymnasium.Env))
            self.keeps_gymnasiums_conventions(module.Env())
            self.assertEqual(set(gymnasium.registry), {f"mckibben/Track{which}-v0" for which in ("", "Drawn", "Pair")})
            for spec in gymnasium.registry.values():
                for entry, wanted, extra in (("entry_point", gymnasium.Env, {}),
                                             ("vector_entry_point", vector.VectorEnv, {"num_envs": 2})):
                    if entry not in spec:
                        continue
                    name, made = spec[entry].split(":")
                    env = getattr(sys.modules[name], made)(**extra, **spec.get("kwargs", {}))
                    self.assertIsInstance(env, wanted)
                    env.reset(seed=1)
            self.assertIs(module.VectorEnv().metadata["autoreset_mode"], vector.AutoresetMode.NEXT_STEP)
        finally:
            importlib.reload(mckibben.env)
        self.assertFalse(issubclass(mckibben.env.Env, gymnasium.Env))


class VectorEnv(unittest.TestCase):
    def test_members_are_episodes_of_env(self):
        keys = {"duration_s": 0.6, "jitter": 1e-3, "rig": ["thesis", {"friction": {"scale": 2.0}}]}
        many = mckibben.VectorEnv(3, **keys)
        observations, infos = many.reset(seed=5)
        alone = [mckibben.Env(**keys) for _ in range(3)]
        rows = [env.reset(seed=5 + i) for i, env in enumerate(alone)]
        self.assertEqual(infos["load_kg"].tolist(), [info["load_kg"] for _, info in rows])
        self.assertTrue(infos["_load_kg"].all())
        for _ in range(49):
            numpy.testing.assert_allclose(observations, [row[0] for row in rows], atol=1e-3)
            observations, rewards, terminations, truncations, infos = many.step([[0.2], [0.1], [-0.1]])
            rows = [env.step([a]) for env, a in zip(alone, (0.2, 0.1, -0.1))]
            numpy.testing.assert_allclose(rewards, [row[1] for row in rows], atol=0.1)
            for key, value in rows[0][4].items():
                self.assertTrue(infos["_" + key].all())
                numpy.testing.assert_allclose(infos[key], [row[4][key] for row in rows], rtol=0, atol=1e-5, err_msg=key)
        self.assertTrue(truncations.all())
        self.assertEqual((observations.dtype, observations.shape), (numpy.float32, (3, 4)))
        self.assertIn(observations, many.observation_space)

    def test_autoreset_modes(self):
        mode = mckibben.AutoresetMode
        def until_ended(envs):
            envs.reset(seed=1)
            for _ in range(9):
                result = envs.step([0.0, 0.0])
            self.assertTrue(result[3].all())
            return result
        next_step = mckibben.VectorEnv(2, duration_s=0.12)
        self.assertEqual(next_step.metadata["autoreset_mode"].value, "NextStep")
        last = until_ended(next_step)[0]
        first, rewards, terminations, truncations, infos = next_step.step([0.0, 0.0])
        self.assertEqual((rewards.tolist(), terminations.any(), truncations.any()), ([0.0, 0.0], False, False))
        self.assertFalse(numpy.array_equal(first, last))
        self.assertTrue(infos["_load_kg"].all())
        self.assertLess(next_step.step([0.0, 0.0])[1].max(), 0.0)
        same_step = mckibben.VectorEnv(2, duration_s=0.12, autoreset_mode=mode.SAME_STEP)
        begun, _, _, _, infos = until_ended(same_step)
        self.assertTrue(infos["_final_obs"].all() and infos["_final_info"].all())
        self.assertEqual({key for key in infos["final_info"] if key[0] != "_"}, {"current_mA", "true_contraction_ratio", "beyond_e_max", "time_s"})
        self.assertEqual(infos["final_info"]["time_s"].tolist(), [0.108, 0.108])
        self.assertEqual((infos["time_s"].tolist(), infos["_current_mA"].any()), ([0.0, 0.0], False))
        numpy.testing.assert_array_equal(infos["final_obs"][0], last[0])
        self.assertFalse(numpy.array_equal(begun[0], last[0]))
        self.assertFalse(same_step.step([0.0, 0.0])[3].any())
        disabled = mckibben.VectorEnv(2, duration_s=0.12, autoreset_mode="Disabled")
        until_ended(disabled)
        with self.assertRaisesRegex(RuntimeError, "reset_mask"):
            disabled.step([0.0, 0.0])

    def test_a_reset_that_could_draw_nothing_is_tried_again(self):
        for mode in ("SameStep", "NextStep"):
            unusable = []

            def rig(random):
                return "no such rig" if unusable else "thesis"

            envs = mckibben.VectorEnv(2, rig=rig, loads_kg=11.0, duration_s=0.05, autoreset_mode=mode)
            envs.reset(seed=0)
            still, failures = numpy.full((2, 1), -1.0), 0
            unusable.append(True)
            for _ in range(6):
                try:
                    envs.step(still)
                except mckibben.errors.MissingInput:
                    failures += 1
            self.assertGreater(failures, 1, mode)
            unusable.clear()
            infos = [envs.step(still)[4] for _ in range(3)]
            self.assertTrue(all(info["_load_kg"].all() for info in infos[:1]), mode)
            self.assertEqual([one.tick for one in envs.episodes], [2, 2], mode)
            self.assertGreater(len(envs.finished[0].history["reward"]), 1)

    def test_says_whose_rig_is_unusable(self):
        def rig(random):
            return {"friction": {"scale": -1.0}} if random.random() < 0.5 else "thesis"

        envs = mckibben.VectorEnv(8, rig=rig, duration_s=0.6)
        who = [i for i in range(8) if numpy.random.default_rng(3 + i).random() < 0.5][0]
        with self.assertRaisesRegex(mckibben.InputError, rf"^member {who}, of seed {3 + who}: rig: friction\.scale") as raised:
            envs.reset(seed=3)
        self.assertEqual(raised.exception.problems[0].path, "friction.scale")

    def test_single_members_begin_again(self):
        envs = mckibben.VectorEnv(3, duration_s=6.0, autoreset_mode="Disabled")
        envs.reset(seed=1)
        other = mckibben.VectorEnv(3, duration_s=6.0)
        other.reset(seed=1)
        for _ in range(20):
            envs.step([0.5] * 3)
            before = other.step([0.5] * 3)[0]
        observations, infos = envs.reset(seed=[None, 9, None], options={"reset_mask": numpy.array([False, True, False])})
        self.assertEqual(infos["_load_kg"].tolist(), [False, True, False])
        self.assertEqual(observations[[0, 2]].tobytes(), before[[0, 2]].tobytes())
        for _ in range(10):
            observations, before = envs.step([0.1] * 3)[0], other.step([0.1] * 3)[0]
            self.assertEqual(observations[[0, 2]].tobytes(), before[[0, 2]].tobytes())
        anew = mckibben.VectorEnv(1, duration_s=6.0)
        anew.reset(seed=9)
        for _ in range(10):
            expected = anew.step([0.1])[0]
        numpy.testing.assert_allclose(observations[1], expected[0], atol=1e-3)
        for mask in (numpy.array([True]), numpy.array([1, 0, 0]), numpy.zeros(3, dtype=bool)):
            with self.assertRaisesRegex(ValueError, "reset_mask"):
                envs.reset(options={"reset_mask": mask})

    def test_each_has_its_load(self):
        envs = mckibben.VectorEnv(3, duration_s=0.6)
        self.assertEqual(envs.reset(options={"load_kg": [8, 9, 10]})[1]["load_kg"].tolist(), [8.0, 9.0, 10.0])
        self.assertEqual(envs.reset(options={"load_kg": 9})[1]["load_kg"].tolist(), [9.0] * 3)
        with self.assertRaisesRegex(ValueError, "one for each of 3 members"):
            envs.reset(options={"load_kg": [8, 9]})

    def test_one_that_fails_is_terminated_alone(self):
        falls = {"muscle": {"stop_stiffness": "1e5 N/m"},
                 "effects": {"residual_law": {"terms": [{"of": "m g", "coefficient": "-800 N"}]}}}
        envs = mckibben.VectorEnv(8, rig=["thesis", falls], loads_kg=(44.0, 45.0), duration_s=1.2, autoreset_mode="Disabled")
        envs.reset(seed=0)
        _, _, terminations, _, infos = envs.step(numpy.zeros(8))
        self.assertTrue(terminations.any() and not terminations.all())
        self.assertEqual(terminations.tolist(), infos["_failure"].tolist())

    def test_nonsense_is_refused(self):
        envs = mckibben.VectorEnv(2, duration_s=0.6)
        with self.assertRaises(RuntimeError):
            envs.step([0.0, 0.0])
        with self.assertRaises(ValueError):
            envs.reset(seed=[1, 2, 3])
        envs.reset(seed=1)
        for bad in ([0.0], [[0.0], [float("nan")]], [0.0] * 3, [[0.0, 0.0]], ["a", "b"]):
            with self.assertRaisesRegex(ValueError, r"of shape \(2, 1\) or \(2,\)$|^action\[1, 0\] = nan: must be finite$"):
                envs.step(bad)
        with self.assertRaisesRegex(ValueError, r"^action = an array of shape \(4, 1\): must be"):
            envs.step(numpy.zeros((4, 1)))
        self.assertLess(len(repr(mckibben.VectorEnv(64).action_space)), 60)
        with self.assertRaisesRegex(ValueError, "threads = -1"):
            mckibben.VectorEnv(2, threads=-1)
        for many in (0, 2.5):
            with self.assertRaisesRegex(ValueError, "num_envs"):
                mckibben.VectorEnv(many)
        with self.assertRaisesRegex(ValueError, "none of NEXT_STEP, SAME_STEP, DISABLED"):
            mckibben.VectorEnv(1, autoreset_mode="Sometimes")
        for mode in mckibben.AutoresetMode:
            for named in (mode.name, mode.value, mode):
                self.assertEqual(mckibben.VectorEnv(1, autoreset_mode=named).autoreset_mode, mode)


main()
