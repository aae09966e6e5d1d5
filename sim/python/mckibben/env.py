"""The rig as an environment for learning controllers, in the manner of Gymnasium: reset, step, spaces.

Gymnasium is not needed. Where it is installed, Env is one of its environments and the spaces are its own.
"""
import math

import numpy

from ._core import Ride, Rig, Scenario
from .errors import NumericalFailure

try:
    import gymnasium
    Base, Box = gymnasium.Env, gymnasium.spaces.Box
except ImportError:
    class Base:
        """What Env has of Gymnasium's Env: chance, by a seed."""
        _np_random = None

        @property
        def np_random(self):
            """Where all chance comes from, a numpy.random.Generator."""
            if self._np_random is None:
                self._np_random = numpy.random.default_rng()
            return self._np_random

        @property
        def unwrapped(self):
            """Itself."""
            return self

        def reset(self, *, seed=None, options=None):
            if seed is not None:
                self._np_random = numpy.random.default_rng(seed)

    class Box:
        """Numbers between `low` and `high`: what there is of Gymnasium's Box here."""

        def __init__(self, low, high, dtype=numpy.float32):
            self.low = numpy.asarray(low, dtype)
            self.high = numpy.asarray(high, dtype)
            self.shape, self.dtype = self.low.shape, numpy.dtype(dtype)
            self._random = numpy.random.default_rng()

        def seed(self, seed=None):
            self._random = numpy.random.default_rng(seed)

        def sample(self):
            return self._random.uniform(self.low, self.high).astype(self.dtype)

        def contains(self, x):
            x = numpy.asarray(x)
            return x.shape == self.shape and bool(numpy.all((x >= self.low) & (x <= self.high)))

        def __contains__(self, x):
            return self.contains(x)

        def __repr__(self):
            return f"Box({self.low}, {self.high}, {self.shape}, {self.dtype})"


class Env(Base):
    """Follow a target with an unknown load: an episode is one run.

    action       shape (1,), -1 to 1: the command, from the lower to the upper end of the valve's line
    observation  shape (4,): contraction ratio as the encoder counts it, its speed by these counts over the last
                 tick [1/s], the target at this tick [1], the command of the last tick (-1 to 1)
    reward       minus the absolute error of the counted contraction ratio, in per cent
    truncated    at the end of `duration`; terminated where the simulation cannot go on

    >>> import mckibben
    >>> env = mckibben.Env(loads_kg=(11.0, 23.0), duration_s=1.2)
    >>> observation, info = env.reset(seed=3)
    >>> observation.shape, env.action_space.shape
    ((4,), (1,))
    >>> observation, reward, terminated, truncated, info = env.step([0.1])
    >>> reward < 0, terminated, truncated
    (True, False, False)
    """

    metadata = {"render_modes": []}
    render_mode = None
    TARGET = {"kind": "sine", "mean": 0.1, "amplitude": 0.05, "period": "4 s"}

    def __init__(self, rig="thesis", loads_kg=(8.0, 23.0), target=None, duration_s=12.0, jitter=0.0):
        """`loads_kg`: between these each episode draws its load. `target`: as in scenario files. `jitter`: root mean
        square of what shakes the reading, as a contraction ratio [1]. Raises InputError, ValueError."""
        self.rig = rig if isinstance(rig, Rig) else Rig(rig)
        if len(loads_kg) != 2:
            raise ValueError("loads_kg: the lightest and the heaviest load")
        lightest, heaviest = sorted(map(float, loads_kg))
        # Whoever is to follow it: a scenario wants a controller.
        unit = self.rig.command_unit
        anybody = {"kind": "sine_current", "low": f"0 {unit}", "high": f"0.1 {unit}", "period": "1 s"}
        scenario = Scenario({"rig": self.rig, "loads": [f"{load!r} kg" for load in sorted({lightest, heaviest})],
                             "target": target or self.TARGET, "duration": f"{float(duration_s)!r} s",
                             "controllers": [anybody]})
        self.target = scenario.target
        self.loads_kg, self.jitter = (lightest, heaviest), float(jitter)
        self.zero, self.span = self.rig.command_range
        self.given = "current_mA" if unit == "mA" else f"command_{unit}"
        self.action_space = Box(numpy.float32([-1.0]), numpy.float32([1.0]))
        most, fastest = self.rig.largest_contraction_ratio, 20.0
        self.observation_space = Box(numpy.float32([-most, -fastest, -1.0, -1.0]),
                                     numpy.float32([2.0 * most, fastest, 1.0, 1.0]))
        self.ride = None

    def reset(self, *, seed=None, options=None):
        """A new episode: (observation, info). `seed` decides its load and its jitter; `options` may say
        {"load_kg": ...}. The same seed, the same episode."""
        super().reset(seed=seed)
        drawn_kg = float(self.np_random.uniform(*self.loads_kg))
        load_kg = float((options or {}).get("load_kg", drawn_kg))
        self.ride = Ride(self.rig, load_kg=load_kg)
        self.tick, self.last, self.action = 0, self._read(), -1.0
        return self._observation(0.0), {"load_kg": load_kg, "time_s": 0.0}

    def step(self, action):
        """A tick: (observation, reward, terminated, truncated, info)."""
        if self.ride is None:
            raise RuntimeError("reset comes before the first step")
        if self.tick + 1 >= len(self.target):
            raise RuntimeError("the episode has ended; reset begins another one")
        values = numpy.asarray(action, dtype=float).reshape(-1)
        if values.size != 1 or not math.isfinite(values[0]):
            raise ValueError("an action is one finite number")
        self.action = min(1.0, max(-1.0, float(values[0])))
        command = self.rig.dac_output(self.zero + 0.5 * (self.action + 1.0) * (self.span - self.zero))
        info = {self.given: command}
        terminated = False
        try:
            self.ride.step(command)
        except NumericalFailure as failure:
            terminated, info["failure"] = True, str(failure)
        self.tick += 1
        before, self.last = self.last, self._read()
        observation = self._observation((self.last - before) / self.rig.tick_s)
        info.update(time_s=self.ride.time_s, true_contraction_ratio=float(self.ride.state[0]))
        reward = -100.0 * abs(self.last - self.target[self.tick])
        return observation, float(reward), terminated, self.tick + 1 >= len(self.target), info

    def render(self):
        """Nothing is drawn."""

    def close(self):
        """Nothing is kept open."""

    def _read(self):
        counted = self.ride.reading.contraction_ratio
        return counted + self.jitter * self.np_random.standard_normal() if self.jitter else counted

    def _observation(self, speed_per_s):
        seen = numpy.float32([self.last, speed_per_s, self.target[self.tick], self.action])
        return numpy.clip(seen, self.observation_space.low, self.observation_space.high)
