"""The environment for learning controllers: its contract, with and without Gymnasium."""
import importlib
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
        env = mckibben.Env(loads_kg=(9.0, 10.0), duration_s=1.0)
        loads = {env.reset(seed=seed)[1]["load_kg"] for seed in range(5)}
        self.assertEqual(len(loads), 5)
        self.assertTrue(all(9.0 <= load <= 10.0 for load in loads))
        self.assertEqual(env.reset(options={"load_kg": 15.0})[1]["load_kg"], 15.0)

    def test_nothing_is_done_out_of_order(self):
        env = mckibben.Env(duration_s=0.036)
        with self.assertRaises(RuntimeError):
            env.step([0.0])
        env.reset(seed=1)
        for no_action in ([float("nan")], [], [0.1, 0.2]):
            with self.assertRaises(ValueError):
                env.step(no_action)
        with self.assertRaisesRegex(ValueError, "the lightest and the heaviest"):
            mckibben.Env(loads_kg=(5.0,))
        self.assertFalse(env.step(env.action_space.sample())[3])
        self.assertTrue(env.step([5.0])[3])
        with self.assertRaises(RuntimeError):
            env.step([0.0])
        with self.assertRaises(mckibben.InputError):
            mckibben.Env(target={"kind": "sine"})

    def keeps_gymnasiums_conventions(self, env):
        """What Gymnasium's own checker of environments asks for."""
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
        self.assertEqual([type(one) for one in (reward, terminated, truncated, info)], [float, bool, bool, dict])
        before = repr(env.np_random.bit_generator.state)
        env.reset()  # goes on with chance where it was
        self.assertNotEqual(repr(env.np_random.bit_generator.state), before)
        self.assertEqual((env.metadata["render_modes"], env.render_mode), ([], None))
        env.close()

    def test_is_one_of_gymnasiums_where_that_is_installed(self):
        self.keeps_gymnasiums_conventions(mckibben.Env())
        gymnasium = types.ModuleType("gymnasium")
        here = mckibben.env.Base
        gymnasium.Env = type("Env", (), {"_np_random": None, "np_random": here.np_random, "unwrapped": here.unwrapped,
                                         "reset": here.reset})
        gymnasium.spaces = types.SimpleNamespace(Box=mckibben.env.Box)
        try:
            with mock.patch.dict(sys.modules, {"gymnasium": gymnasium}):
                module = importlib.reload(mckibben.env)
            self.assertTrue(issubclass(module.Env, gymnasium.Env))
            self.keeps_gymnasiums_conventions(module.Env())
        finally:
            importlib.reload(mckibben.env)
        self.assertFalse(issubclass(mckibben.env.Env, gymnasium.Env))


main()
