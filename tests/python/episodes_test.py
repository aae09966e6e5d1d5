"""What becomes of an episode: a recording that replays, a scenario that others control."""
import copy
import unittest

import numpy

import mckibben
import mckibben.env
from common import main


class Episodes(unittest.TestCase):
    def test_a_recording_replays(self):
        for rig in ("thesis", "thesis_pair"):
            env = mckibben.Env(rig, duration_s=1.2)
            env.reset(seed=1)
            with self.assertRaisesRegex(RuntimeError, "one step at least"):
                env.recording()
            chance = numpy.random.default_rng(2)
            for _ in range(60):
                env.step(chance.uniform(-1.0, 1.0, env.action_space.shape))
            recording = env.recording()
            replayed = mckibben.Dataset({"runs": [recording]}).replay()[0]
            reads = env.task.reads
            numpy.testing.assert_allclose(replayed[f"encoder_{reads}"], recording["data"][reads], rtol=0, atol=1e-9)
            self.assertLess(max(gap["rmse"] for gap in replayed.gaps.values()), 1e-9)
            self.assertGreater(abs(numpy.diff(recording["data"][reads])).max(), 1e-3)

    def test_a_recording_carries_its_rig(self):
        recordings = []
        for scale in (2.0, 0.5):
            env = mckibben.Env({"friction": {"scale": scale}}, duration_s=1.2)
            env.reset(seed=1)
            while not env.ended:
                env.step([0.5])
            recordings.append(env.recording(f"friction_{round(10 * scale)}"))
        one, other = recordings
        self.assertEqual(mckibben.Dataset({"runs": [one]}).rig, one["rig"])
        self.assertLess(mckibben.Dataset({"runs": [one]}).replay()[0].gaps["contraction"]["rmse"], 1e-9)
        self.assertEqual(mckibben.Dataset({"runs": [one, {**one, "id": "again", "rig": one["rig"].to_dict()}]}).ids, [one["id"], "again"])
        with self.assertRaisesRegex(ValueError, r"runs\[1\]\.rig: is another one than that of runs\[0\]"):
            mckibben.Dataset({"runs": [one, other]})
        without = {key: value for key, value in other.items() if key != "rig"}
        with self.assertRaisesRegex(ValueError, "rig: some runs have one, others none"):
            mckibben.Dataset({"runs": [one, without]})
        both = mckibben.Dataset({"rig": "thesis", "runs": [one, other]})  # as one that does not know their friction
        self.assertGreater(both.replay()[0].gaps["contraction"]["rmse"], 1e-4)

    def test_its_scenario_shakes_as_it_does(self):
        for rig, per in (("thesis", 1.0), ("thesis_pair", None)):
            env = mckibben.Env(rig, duration_s=1.2, jitter=0.002)
            env.reset(seed=1)
            noise = env.scenario([{"kind": "pid"}]).to_dict()["noise"]["encoder_jitter"]
            self.assertAlmostEqual(noise, 0.002 / (per or env.episode.rad))
            noise = env.scenario([{"kind": "pid"}], noise={"encoder_jitter": 0.0}).to_dict()["noise"]
            self.assertEqual(noise["encoder_jitter"], 0.0)
            noise = env.scenario([{"kind": "pid"}], noise={"gauge": "1 mbar"}).to_dict()["noise"]
            self.assertAlmostEqual(noise["encoder_jitter"], 0.002 / (per or env.episode.rad))
            self.assertEqual(noise["gauge"], "100 Pa")

    def test_what_is_shaken_is_counted_after(self):
        one, many = mckibben.Env(duration_s=1.2, jitter=0.002), mckibben.VectorEnv(2, duration_s=1.2, jitter=0.002)
        one.reset(seed=1), many.reset(seed=1)
        true = [one.step([0.0])[4]["true_contraction_ratio"] for _ in range(60)]
        for _ in range(60):
            many.step(numpy.zeros((2, 1)))
        read, per_count = one.history["contraction_ratio"], one.rig.contraction_per_count
        numpy.testing.assert_allclose(read / per_count, numpy.round(read / per_count), atol=1e-6)
        self.assertTrue(0.001 < numpy.std(read - true) < 0.003, numpy.std(read - true))
        numpy.testing.assert_allclose(many.episodes[0].history["contraction_ratio"], read, atol=1e-12)

    def test_sensors_have_their_noise(self):
        laser = {"signal": "contraction", "kind": "laser", "resolution": "10 um", "highest": "80 mm"}
        noisy = {"sensors": [{**laser, "noise": "3 mm"}]}

        def scatter(env, action):
            env.reset(seed=1)
            true = [env.step(action)[4]["true_contraction_ratio"] for _ in range(99)]
            return env.history["contraction_ratio"] - true

        env = mckibben.Env(noisy, duration_s=1.2)
        one = scatter(env, [0.0])
        self.assertTrue(0.008 < one.std() < 0.012, one.std())  # 3 mm of 300 mm
        run = env.scenario([{"kind": "pid"}]).run()[0]
        self.assertTrue(0.8 < one.std() / (run["encoder_contraction_ratio"] - run["contraction_ratio"]).std() < 1.25)
        both = scatter(mckibben.Env(noisy, duration_s=1.2, jitter=0.01), [0.0])
        self.assertAlmostEqual(both.std() / one.std(), 2.0**0.5, delta=0.05)
        self.assertGreater(len({env.reset(seed=seed)[0][0] for seed in range(5)}), 3, "the first reading scatters, too")

        quiet, slow = {"sensors": [laser]}, {"sensors": [{**laser, "noise": "3 mm", "rate": "10 Hz"}]}
        many = [mckibben.VectorEnv(9, [noisy, quiet], duration_s=1.2, threads=threads) for threads in (1, 2)]
        rows = [[envs.reset(seed=1)[0], *(envs.step(numpy.zeros((9, 1)))[0] for _ in range(60))] for envs in many]
        numpy.testing.assert_array_equal(*rows)
        for member in many[0].episodes:
            has_noise = member.rig == mckibben.Rig(noisy)
            self.assertEqual(numpy.diff(member.history["contraction_ratio"], 2).std() > 0.005, has_noise)
        alone = mckibben.Env([noisy, quiet], duration_s=1.2)
        alone.reset(seed=4)
        for _ in range(60):
            alone.step([0.0])
        numpy.testing.assert_allclose(many[0].episodes[3].history["contraction_ratio"], alone.history["contraction_ratio"], atol=1e-4)

        copied = copy.deepcopy(env)
        self.assertEqual([env.step([0.1])[0].tolist() for _ in range(9)], [copied.step([0.1])[0].tolist() for _ in range(9)])
        for held in (mckibben.Env(slow, duration_s=1.2), mckibben.VectorEnv(2, slow, duration_s=1.2)):
            held.reset(seed=1)
            read = [held.step(numpy.zeros(held.action_space.shape))[0].flat[0] for _ in range(60)]
            self.assertTrue(5 <= numpy.count_nonzero(numpy.diff(read)) <= 9, "a reading is shown until the next")

        turned = {"base": "thesis_pair", "sensors": [{"signal": "contraction", "kind": "potentiometer",
                                                      "resolution": "0.001 deg", "noise": "1 deg"}]}
        pair = mckibben.Env(turned, duration_s=1.2)
        pair.reset(seed=1)
        true = [pair.step([0.0, 0.0])[4]["true_angle_rad"] for _ in range(99)]
        self.assertTrue(0.8 < numpy.degrees((pair.history["angle_rad"] - true).std()) < 1.2)

    def test_a_subclass_has_its_own_reward_and_end(self):
        class Squares(mckibben.env.Rules):
            def reward(self, observation, action, usual):
                error = observation[..., 0] - observation[..., 2]
                return -error**2 - action[..., 0]**2 + 0.0 * usual

            def terminates(self, observation):
                return observation[..., 0] > 0.04

        class One(Squares, mckibben.Env):
            pass

        class Many(Squares, mckibben.VectorEnv):
            pass

        env = One(duration_s=1.2)
        seen, _ = env.reset(seed=1)
        rewards, terminated = [], False
        while not terminated:
            seen, reward, terminated, truncated, _ = env.step([0.5])
            self.assertAlmostEqual(reward, -(float(seen[0]) - float(seen[2]))**2 - 0.25, places=6)
            self.assertFalse(truncated)
            rewards.append(reward)
        self.assertGreater(seen[0], 0.04)
        self.assertEqual(env.history["reward"].tolist(), rewards)

        for mode in mckibben.AutoresetMode:
            with self.subTest(mode=mode):
                many = Many(2, loads_kg=env.episode.load_kg, duration_s=1.2, autoreset_mode=mode)
                many.reset(seed=1)
                first, ended = many.episodes[0], []
                for _ in rewards:
                    result = many.step(numpy.full((2, 1), 0.5))
                    ended.append(bool(result[2][0]))
                self.assertEqual(ended, [False] * (len(rewards) - 1) + [True])
                numpy.testing.assert_allclose(first.history["reward"], rewards, atol=1e-3)
                self.assertAlmostEqual(result[1][0], first.history["reward"][-1])
                if mode == mckibben.AutoresetMode.NEXT_STEP:
                    self.assertEqual(many.step(numpy.full((2, 1), 0.5))[1][0], 0.0)
                if mode != mckibben.AutoresetMode.DISABLED:
                    self.assertIs(many.finished[0], first)
                    many.step(numpy.zeros((2, 1)))
                    self.assertEqual(len(first.rows), len(rewards))

    def test_a_reward_may_remember_each_member(self):
        class Smooth(mckibben.VectorEnv):
            before, waited = numpy.zeros((3, 1)), []

            def reward(self, observation, action, usual):
                change, self.before = abs(action - self.before)[:, 0], action
                self.waited.append(self.ended.tolist())
                if self.ended.any():
                    at = numpy.flatnonzero(self.ended)
                    ours.assertEqual((usual[at].tolist(), observation[at].tolist()), ([0.0], self.last[at].tolist()))
                return numpy.where(self.ended, numpy.nan, -change)

            def terminates(self, observation):
                self.last = observation
                first = numpy.array([one.tick for one in self.episodes]) == 4
                return self.ended | (first & (numpy.arange(3) == 1))

        ours, chance = self, numpy.random.default_rng(1)
        envs = Smooth(3, duration_s=1.2)
        envs.reset(seed=1)
        before = numpy.zeros((3, 1))
        for _ in range(9):
            actions = chance.uniform(-1.0, 1.0, (3, 1))
            waits, (_, rewards, terminations, _, _) = envs.ended, envs.step(actions)
            numpy.testing.assert_allclose(rewards, numpy.where(waits, 0.0, -abs(actions - before)[:, 0]))
            self.assertFalse((terminations & waits).any())
            before = actions
        self.assertEqual([waited.index(True) if any(waited) else None for waited in envs.waited],
                         [None] * 4 + [1] + [None] * 4)

    def test_a_reward_of_another_shape_is_an_error(self):
        for kind, many, wrong in ((mckibben.Env, (), None), (mckibben.Env, (), [1.0]), (mckibben.Env, (), numpy.nan),
                                  (mckibben.VectorEnv, (2,), [0.0, numpy.nan]),
                                  (mckibben.VectorEnv, (2,), 1.0), (mckibben.VectorEnv, (2,), numpy.zeros((2, 1)))):
            env = type("Own", (kind,), {"reward": lambda self, *_: wrong})(*many, duration_s=0.12)
            env.reset(seed=1)
            with self.assertRaisesRegex(ValueError, r"(?s)reward returned .*: must be (one number|an array of 2, one for)|^reward(\[1\])? = nan: must be finite$"):
                env.step(numpy.zeros((*many, 1)))

    def test_says_where_a_muscle_is_shorter_than_one_can_be(self):
        full = {"loads_kg": 11.0, "duration_s": 2.4}
        one, many = mckibben.Env(**full), mckibben.VectorEnv(2, **full)
        one.reset(seed=1)
        many.reset(seed=1)
        e_max, seen = one.rig.largest_contraction_ratio, []
        for _ in range(190):
            info, infos = one.step([1.0])[4], many.step(numpy.ones((2, 1)))[4]
            self.assertEqual(info["beyond_e_max"], info["true_contraction_ratio"] > e_max)
            self.assertEqual(infos["beyond_e_max"].tolist(), (infos["true_contraction_ratio"] > e_max).tolist())
            seen.append(info["beyond_e_max"])
        self.assertEqual({True, False}, set(seen))
        pair = mckibben.Env("thesis_pair", duration_s=0.6)
        pair.reset(seed=1)
        self.assertIs(pair.step([0.0, 0.0])[4]["beyond_e_max"], False)
        rig, e_max = pair.rig, pair.rig.largest_contraction_ratio
        self.assertTrue(rig._beyond_e_max(e_max + 0.01))
        self.assertTrue(rig._beyond_e_max(0.2 - e_max - 0.01), "muscle 2, mounted at 0.1 as the first")

    def test_others_can_have_its_target(self):
        for keys, controller in (({"rig": mckibben.env.drawn_rig, "target": mckibben.env.drawn_target}, {"kind": "pid"}),
                                 ({"rig": "thesis_pair"}, {"kind": "pid"})):
            env = mckibben.Env(**keys, duration_s=2.4)
            with self.assertRaisesRegex(RuntimeError, "reset comes before the first scenario"):
                env.scenario([controller])
            env.reset(seed=1)
            scenario = env.scenario([controller], name="mine")
            self.assertEqual((scenario.name, scenario.rig), ("mine", env.rig))
            self.assertEqual(scenario.target.tobytes(), env.target.tobytes())
            described = "thesis_pair" if env.task.pair else "thesis"
            self.assertEqual(env.scenario([controller], rig=described).rig, mckibben.Rig(described))
            if "rig" in keys and keys["rig"] != "thesis_pair":
                self.assertEqual(scenario.to_dict()["loads"], [f"{env.episode.load_kg!r} kg"])


main()
