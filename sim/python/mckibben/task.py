"""What episodes of an environment have in common, what is drawn for each, and where one of them is."""
import math
import numbers
import reprlib

import numpy

from ._core import Rig, Scenario


def number(name, value, lowest, highest, unit=""):
    """A number in this range. Raises ValueError with name, value and range."""
    if not isinstance(value, numbers.Real) or not lowest <= value <= highest:
        raise ValueError(f"{name} = {value!r}: must be a number from {lowest:g} to {highest:g}{unit}")
    return float(value)


def actions_of(given, shape):
    """Finite numbers in this shape; of one action each without its last axis, too."""
    try:
        values = numpy.asarray(given, dtype=float)
    except (TypeError, ValueError):
        values = numpy.full((), math.nan)
    shapes = [shape, shape[:-1]] if shape[-1] == 1 else [shape]
    if values.shape not in shapes or not numpy.isfinite(values).all():
        raise ValueError(f"action = {reprlib.repr(given)}: must be finite numbers of shape {shape}")
    return values.reshape(shape)


def one_of(several, random):
    """One of a list, by chance; what a function of chance makes; or itself."""
    if callable(several):
        return several(random)
    if isinstance(several, (list, tuple)):
        return several[int(random.integers(len(several)))]
    return several


class Task:
    """What episodes have in common, and what is drawn for each."""
    TARGET = {"kind": "sine", "mean": 0.1, "amplitude": 0.05, "period": "4 s"}
    MOST, FASTEST = 0.5, 20.0  # contraction ratio [1] that no braid reaches, its speed [1/s]
    HEAVIEST = 500.0  # load [kg]

    def __init__(self, rig, loads_kg, target, duration_s, jitter):
        for name, value in {"rig": rig, "target": target}.items():
            if isinstance(value, (list, tuple)) and not value:
                raise ValueError(f"{name}: a list of one at least, for each episode to draw from")
        if isinstance(rig, (list, tuple)):
            self.rig = [self.made(one) for one in rig]
        else:
            self.rig = rig if callable(rig) else self.made(rig)
        if isinstance(loads_kg, str) or numpy.shape(loads_kg) != (2,):
            raise ValueError(f"loads_kg = {loads_kg!r}: two masses are wanted, the lightest and the heaviest, such as (8.0, 23.0)")
        self.loads_kg = tuple(sorted(number(f"loads_kg[{i}]", load, 0.0, self.HEAVIEST, " kg") for i, load in enumerate(loads_kg)))
        self.target = self.TARGET if target is None else target
        self.duration_s = number("duration_s", duration_s, 0.0001, 3600.0, " s")
        self.jitter = number("jitter", jitter, 0.0, 1.0)
        rigs = self.rig if isinstance(self.rig, list) else [] if callable(self.rig) else [self.rig]
        most = max((one.largest_contraction_ratio for one in rigs), default=self.MOST)
        self.acted = numpy.float32([-1.0]), numpy.float32([1.0])
        self.observed = (numpy.float32([-most, -self.FASTEST, -1.0, -1.0]),
                         numpy.float32([2.0 * most, self.FASTEST, 1.0, 1.0]))
        self.fixed = None
        _, _, drawn = self.draw(numpy.random.default_rng(0), {})  # says what is wrong before the first episode
        if isinstance(self.rig, Rig) and isinstance(self.target, dict):
            self.fixed = drawn

    @staticmethod
    def made(rig):
        rig = rig if isinstance(rig, Rig) else Rig(rig)
        kind = rig.to_dict().get("mechanics", {}).get("kind", "hanging_load")
        if kind != "hanging_load":
            raise ValueError(f"rig: an environment is one muscle that lifts a hanging load; this rig's mechanics are {kind}. "
                             "Step it with Ride, or run a Scenario")
        return rig

    @staticmethod
    def check(options, *seeds):
        """Of a reset, before it changes anything; without what is of a VectorEnv."""
        if unknown := set(options) - {"load_kg"}:
            raise ValueError(f"options: {', '.join(sorted(map(repr, unknown)))} is unknown; there are load_kg and, of a "
                             "VectorEnv, reset_mask")
        if "load_kg" in options:
            number("options: load_kg", options["load_kg"], 0.0, Task.HEAVIEST, " kg")
        for seed in seeds:
            if seed is not None and (not isinstance(seed, numbers.Integral) or seed < 0):
                raise ValueError(f"seed = {seed!r}: must be a whole number, 0 at least, or None")

    def draw(self, random, options):
        """Rig, load [kg] and target of an episode."""
        rig = one_of(self.rig, random)
        if callable(self.rig):
            rig = self.made(rig)
        target = one_of(self.target, random)
        load_kg = float(options.get("load_kg", random.uniform(*self.loads_kg)))
        if self.fixed is not None:
            return rig, load_kg, self.fixed
        unit = rig.command_unit  # whoever is to follow it: a scenario wants a controller
        anybody = {"kind": "sine_current", "low": f"0 {unit}", "high": f"0.1 {unit}", "period": "1 s"}
        scenario = Scenario({"rig": rig, "loads": [f"{load!r} kg" for load in sorted(set(self.loads_kg))],
                             "target": target, "duration": f"{self.duration_s!r} s", "controllers": [anybody]})
        return rig, load_kg, scenario.target


class Episode:
    """Where one stands: its numbers as they are read, and rewarded."""

    def __init__(self, task, random, options):
        self.task, self.random = task, random
        self.rig, self.load_kg, self.target = task.draw(random, options)
        self.zero, self.span = self.rig.command_range
        self.tick, self.action, self.last = 0, -1.0, 0.0
        self.info = {"load_kg": self.load_kg, "time_s": 0.0}

    def begin(self, counted):
        self.last = self.read(counted)
        return self.observation(0.0)

    def command(self, action):
        """What the DAC gives for an action."""
        self.action = min(1.0, max(-1.0, action))
        return self.rig.dac_output(self.zero + 0.5 * (self.action + 1.0) * (self.span - self.zero))

    def arrive(self, counted):
        """A tick later: observation, reward, whether it was the last tick."""
        self.tick += 1
        before, self.last = self.last, self.read(counted)
        reward = -100.0 * abs(self.last - self.target[self.tick])
        return self.observation((self.last - before) / self.rig.tick_s), float(reward), self.over()

    def over(self):
        return self.tick + 1 >= len(self.target)

    def read(self, counted):
        jitter = self.task.jitter
        return counted + jitter * self.random.standard_normal() if jitter else counted

    def observation(self, speed_per_s):
        seen = numpy.float32([self.last, speed_per_s, self.target[self.tick], self.action])
        return numpy.clip(seen, *self.task.observed)
