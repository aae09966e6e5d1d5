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


def array_of(given):
    """As NumPy reads it; of what is no array at all one that holds no number."""
    try:
        return numpy.asarray(given)
    except (TypeError, ValueError):
        return numpy.array(None)


def actions_of(given, shape):
    """Finite numbers in this shape; of one action each without its last axis, too. What can be read as numbers, such
    as texts and dates, is none."""
    values = array_of(given)
    shapes = [shape, shape[:-1]] if shape[-1] == 1 else [shape]
    if values.dtype.kind not in "fiu" or values.shape not in shapes:
        alone = f" or {shape[:-1]}" if shape[:-1] else " or one number"
        it = reprlib.repr(given) if values.size < 4 else f"an array of shape {values.shape}"
        raise ValueError(f"action = {it}: must be numbers of shape {shape}{alone * (len(shapes) - 1)}")
    require_finite("action", values)
    return values.reshape(shape).astype(float)


def require_finite(name, values):
    """Raises ValueError with the first place of what is no number."""
    for at in numpy.argwhere(~numpy.isfinite(values)).tolist()[:1]:
        raise ValueError(f"{name}{at or ''} = {values[tuple(at)]}: must be finite")


def returned(name, given, shape, ignored=False):
    """What a subclass's method gave: numbers of this shape, 0 where they are ignored. Raises ValueError."""
    values = array_of(given)
    if values.dtype.kind not in "fiub" or values.shape != shape:
        many = f"an array of {shape[0]}, one for each member" if shape else "one number"
        raise ValueError(f"{name} returned {reprlib.repr(given)}: must be {many}")
    values = numpy.where(ignored, 0, values)
    require_finite(name, values)
    return values


def options_of(given):
    """Of a reset, as a dict of one's own."""
    if not isinstance(given, (dict, type(None))):
        raise ValueError(f"options = {reprlib.repr(given)}: must be a dict, such as {{'load_kg': 11.0}}")
    return dict(given or {})


def one_of(name, several, random):
    """One of a list, by chance; what a function of chance makes; or itself."""
    if callable(several):
        try:
            return several(random)
        except Exception as error:
            raise ValueError(f"{name}: the function that draws it failed, called with a numpy.random.Generator: "
                             f"{type(error).__name__}: {error}") from error
    if isinstance(several, (list, tuple)):
        several = several[int(random.integers(len(several)))]
    if name == "target" and isinstance(several, (numpy.ndarray, numbers.Real)):
        raise ValueError("target: numbers need their times: {'kind': 'points', 'points': numpy.c_[times_s, ratios]}")
    return several


def drawn_rig(random):
    """The thesis's rig of one muscle, but threads with half to twice the friction, a muscle up to a tenth thinner or
    thicker, a valve up to a third slower or quicker."""
    def factor(most):
        return float(most ** random.uniform(-1.0, 1.0))

    return {"base": "thesis", "friction": {"scale": factor(2.0)},
            "muscle": {"rest_radius": f"{7.5 * factor(1.1)!r} mm"},
            "valve": {"conductance": f"{4e-9 * factor(1.33)!r} m3/(s.Pa)"}}


def drawn_target(random):
    """A sine about some contraction ratio, of one muscle, slow or quick."""
    return {"kind": "sine", "mean": float(random.uniform(0.06, 0.12)), "amplitude": float(random.uniform(0.01, 0.05)),
            "period": f"{float(random.uniform(2.0, 8.0))!r} s"}


class Task:
    """What episodes have in common, and what is drawn for each. A rig lifts a load, or is a pair of muscles: then a
    command for each, and what is read and wanted is the joint's angle."""
    TARGET = {"kind": "sine", "mean": 0.1, "amplitude": 0.05, "period": "4 s"}
    PAIR_TARGET = {"kind": "sine", "mean": "0 deg", "amplitude": "15 deg", "period": "4 s"}
    HEAVIEST = 500.0
    MOST, FASTEST = 0.5, 20.0  # contraction ratio [1] that no braid reaches, its speed [1/s]
    MOST_RAD, FASTEST_RAD = math.pi, 100.0

    def __init__(self, rig, loads_kg, target, duration_s, jitter):
        for name, value in {"rig": rig, "target": target}.items():
            if isinstance(value, (list, tuple)) and not value:
                raise ValueError(f"{name}: a list of one at least, for each episode to draw from")
        self.pair = None  # as the first rig is
        several = isinstance(rig, (list, tuple))
        made = [self.made(one) for one in (rig if several else [one_of("rig", rig, numpy.random.default_rng(0))])]
        self.rig = rig if callable(rig) else made if several else made[0]
        self.rigs = [] if callable(rig) else made  # known before they are drawn
        if self.pair and loads_kg is not None:
            raise ValueError(f"loads_kg = {loads_kg!r}: must be left out; no load hangs on a pair of muscles")
        if self.pair and target is drawn_target:
            raise ValueError("target: drawn_target draws contraction ratios, of one muscle; a pair wants angles, such as lambda random: "
                             "{'kind': 'sine', 'mean': '0 deg', 'amplitude': f'{random.uniform(5, 15)} deg', 'period': '4 s'}")
        self.loads_kg = None
        if loads_kg is not None:
            if isinstance(loads_kg, numbers.Real):
                loads_kg = loads_kg, loads_kg
            if isinstance(loads_kg, str) or numpy.shape(loads_kg) != (2,):
                raise ValueError(f"loads_kg = {loads_kg!r}: one mass, or the lightest and the heaviest, in either order, such as (8.0, 23.0)")
            self.loads_kg = tuple(sorted(self.load(f"loads_kg[{i}]", load) for i, load in enumerate(loads_kg)))
        default = self.PAIR_TARGET if self.pair else self.TARGET
        self.target = default if target is None else target
        self.duration_s = number("duration_s", duration_s, 0.0001, 3600.0, " s")
        self.jitter = number("jitter", jitter, 0.0, 1.0)
        self.reads = "angle_rad" if self.pair else "contraction_ratio"
        ends = numpy.ones(2 if self.pair else 1, dtype=numpy.float32)
        self.acted = -ends, ends
        low, high = [-self.MOST, -self.FASTEST, -1.0], [2.0 * self.MOST, self.FASTEST, 1.0]  # the same for all rigs
        if self.pair:
            high = [self.MOST_RAD, self.FASTEST_RAD, self.MOST_RAD]
            low = [-end for end in high]
        self.observed = numpy.float32([*low, *-ends]), numpy.float32([*high, *ends])
        self.fixed = None
        tick_s, drawn = made[0].tick_s, ()
        if self.duration_s > tick_s:
            rig, _, _, drawn = self.draw(numpy.random.default_rng(0), {})  # says what is wrong before the first episode
            tick_s = rig.tick_s
        if len(drawn) < 2:
            raise ValueError(f"duration_s = {duration_s!r}: must be two ticks at least, of {tick_s:g} s each")
        if isinstance(self.rig, Rig) and isinstance(self.target, dict):
            self.fixed = drawn

    def made(self, rig):
        rig = rig if isinstance(rig, Rig) else Rig(rig)
        kind = rig.to_dict().get("mechanics", {}).get("kind", "hanging_load")
        if kind not in ("hanging_load", "pair"):
            raise ValueError("rig: an environment is one muscle that lifts a hanging load, or a pair of muscles; this rig's "
                             f"mechanics are {kind}. Step it with Ride, or run a Scenario")
        if self.pair not in (None, rig.pair):
            raise ValueError("rig: all rigs of an environment have one muscle, or all have two")
        self.pair = rig.pair
        return rig

    def loads_of(self, rig):
        """The lightest and the heaviest of episodes with this rig; friction holds lighter ones than the usual above the
        lowest of TARGET."""
        return self.loads_kg or (0.75 * rig.usual_load_kg, 1.5 * rig.usual_load_kg)

    def load(self, name, load_kg):
        """A load that every known rig can lift."""
        load_kg = number(name, load_kg, 0.0, Task.HEAVIEST, " kg")
        for rig in () if self.pair else self.rigs:
            rig._load_within(load_kg, name)
        return load_kg

    def check(self, options, *seeds, known="there is load_kg"):
        """Of a reset, before it changes anything; without what is of a VectorEnv."""
        if self.pair and "load_kg" in options:
            raise ValueError("options: load_kg: must be left out; no load hangs on a pair of muscles")
        if unknown := set(options) - {"load_kg"}:
            raise ValueError(f"options: {', '.join(sorted(map(repr, unknown)))} is unknown; "
                             f"{'a pair of muscles has none' if self.pair else known}")
        if "load_kg" in options:
            self.load("options: load_kg", options["load_kg"])
        for seed in seeds:
            if seed is not None and (not isinstance(seed, numbers.Integral) or seed < 0):
                raise ValueError(f"seed = {seed!r}: must be a whole number, 0 at least, or None")

    def observation(self, seen):
        """Of an episode, or of many."""
        return numpy.clip(numpy.float32(seen), *self.observed)

    def command_names(self, unit):
        """What infos call the command of each muscle."""
        name = "current" if unit == "mA" else "command"
        return [f"{name}{muscle}_{unit}" for muscle in (("_1", "_2") if self.pair else ("",))]

    def history(self, rows):
        """Of these rows of an episode, an array for each key."""
        keys = ("time_s", "target", self.reads, *("command", "opposite_command")[:2 if self.pair else 1], "reward")
        return dict(zip(keys, numpy.array(rows, dtype=float).reshape(-1, len(keys)).T))

    def scenario(self, rig, loads_kg, target, controllers, keys={}):
        keys = {"rig": rig, "duration": f"{self.duration_s!r} s", "controllers": controllers, **keys}
        if self.pair:
            return Scenario({"targets": [{"angle": target}], **keys})
        return Scenario({"target": target, "loads": [f"{load!r} kg" for load in loads_kg], **keys})

    def draw(self, random, options):
        """Rig, load [kg] (none of a pair) and target of an episode: as a scenario has it, and tick by tick."""
        rig = one_of("rig", self.rig, random)
        if callable(self.rig):
            rig = self.made(rig)
        target = one_of("target", self.target, random)
        load_kg = None if self.pair else float(options.get("load_kg", random.uniform(*self.loads_of(rig))))
        if self.fixed is not None:
            return rig, load_kg, target, self.fixed
        anybody, unit = {"kind": "pid"}, rig.command_unit  # whoever is to follow it: a scenario wants a controller
        if not self.pair:
            anybody = {"kind": "sine_current", "low": f"0 {unit}", "high": f"0.1 {unit}", "period": "1 s"}
        wanted = self.scenario(rig, sorted(set(self.loads_of(rig))), target, [anybody]).target
        wanted.setflags(write=False)  # shown to whoever asks; another one is another Env's
        return rig, load_kg, target, wanted


class Episode:
    """Where one is: what is read and rewarded. Plain numbers: a VectorEnv makes arrays of many at once."""

    def __init__(self, task, random, options):
        self.task, self.random = task, random
        self.rig, self.load_kg, self.wish, self.target = task.draw(random, options)
        self.wanted, self.tick_s = self.target.tolist(), self.rig.tick_s
        self.ranges = [self.rig.command_range, self.rig.opposite_command_range][:2 if task.pair else 1]
        self.e_max = self.rig.largest_contraction_ratio
        self.tick, self.action, self.last = 0, [-1.0] * len(self.ranges), 0.0
        if task.pair:  # the contraction ratio of the first muscle at 0 rad, and the angle that one of 1 more turns
            keys = self.rig.to_dict()
            self.middle, length_m, radius_m = (float(str(value).split()[0]) for value in (
                keys["mechanics"]["contraction_1"], keys["muscle"]["rest_length"], keys["joint"]["wheel_radius"]))
            self.rad = length_m / radius_m
        self.shaken = math.hypot(self.jitter_ratio(), self.rig._position_noise)  # as a scenario has both
        self.info = {"time_s": 0.0} if task.pair else {"load_kg": self.load_kg, "time_s": 0.0}

    def scenario(self, controllers, **keys):
        """The same rig, load, target, time and jitter for these controllers."""
        noise = keys.get("noise", {})
        if self.task.jitter and isinstance(noise, dict):
            keys = {**keys, "noise": {"encoder_jitter": self.jitter_ratio(), **noise}}
        return self.task.scenario(self.rig, [self.load_kg], self.wish, controllers, keys)

    def columns(self):
        """How a data set reads the episode's angle: as counts; a contraction ratio is taken for one by itself."""
        if not self.task.pair:
            return {}
        per_count = self.rig.contraction_per_count * self.rad
        return {"columns": {"angle": {"column": "angle_rad", "unit": "count", "factor": 1.0 / per_count}}}

    def begin(self, counted):
        self.last = self.at_rest = counted
        self.rows = []
        return self.seen(0.0)

    @property
    def history(self):
        """As Env has it."""
        return self.task.history(self.rows)

    def recording(self, id="episode"):
        """As Env has it."""
        if not self.rows:
            raise RuntimeError("a recording wants one step at least")
        rows = numpy.array(self.rows, dtype=float)
        names = self.task.command_names(self.rig.command_unit)
        data = {"time_s": (numpy.arange(len(rows) + 2) * self.tick_s).round(9),
                self.task.reads: numpy.concatenate([[self.at_rest] * 2, rows[:, 2]])}
        for i, (name, rest) in enumerate(zip(names, self.resting())):
            data[name] = numpy.concatenate([[rest], rows[:, 3 + i], rows[-1:, 3 + i]])
        load = {} if self.task.pair else {"load": f"{self.load_kg!r} kg"}
        return {"id": id, "rig": self.rig, **load, **self.columns(), "data": data}

    def truth(self, ride):
        """What is read, before it is counted, as info has it, and whether a muscle could be so short."""
        contraction = float(ride.state[0])
        beyond = {"beyond_e_max": self.rig._beyond_e_max(contraction)}
        if not self.task.pair:
            return {"true_contraction_ratio": contraction, **beyond}
        return {"true_angle_rad": (contraction - self.middle) * self.rad, **beyond}

    def resting(self):
        """The commands under which an episode begins at rest."""
        return [zero for zero, _ in self.ranges]

    def commands(self, action):
        """What the DAC gives each muscle for an action."""
        self.action = [min(1.0, max(-1.0, one)) for one in action]
        self.given = [self.rig.dac_output(zero + 0.5 * (one + 1.0) * (span - zero))
                      for one, (zero, span) in zip(self.action, self.ranges)]
        return self.given

    def arrive(self, counted):
        """A tick later: what is seen, reward, whether it was the last tick."""
        self.tick += 1
        before, self.last = self.last, counted
        reward = -100.0 * abs(self.last - self.wanted[self.tick])
        self.rows.append([self.tick * self.tick_s, self.wanted[self.tick], self.last, *self.given, reward])
        return self.seen((self.last - before) / self.tick_s), reward, self.over()

    def rewarded(self, reward):
        """The last tick, by whoever rewards it otherwise."""
        self.rows[-1][-1] = reward

    def over(self):
        return self.tick + 1 >= len(self.wanted)

    def shake(self):
        """By what the position is off that is counted next, as a contraction ratio."""
        return self.shaken * self.random.standard_normal() if self.shaken else 0.0

    def jitter_ratio(self):
        return self.task.jitter / (self.rad if self.task.pair else 1.0)

    def seen(self, speed_per_s):
        return [self.last, speed_per_s, self.wanted[self.tick], *self.action]
