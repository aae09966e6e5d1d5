"""The rig as an environment for learning controllers, in the manner of Gymnasium: reset, step, spaces.

Gymnasium is not needed. Where it is installed, Env and VectorEnv are its environments, with ids: Track-v0, and
TrackDrawn-v0, whose rigs and targets are drawn.
"""
import math
import numbers

import numpy

from ._core import Batch, Ride, Rig, Scenario
from .errors import NumericalFailure

try:
    import gymnasium
    Base, Box = gymnasium.Env, gymnasium.spaces.Box
except ImportError:
    gymnasium = None
    from .without_gymnasium import Base, Box

try:
    from gymnasium.vector import AutoresetMode
    from gymnasium.vector import VectorEnv as VectorBase
except ImportError:
    VectorBase = Base
    from .without_gymnasium import AutoresetMode


def _one_of(several, random):
    """One of a list, by chance; what a function of chance makes; or itself."""
    if callable(several):
        return several(random)
    if isinstance(several, (list, tuple)):
        return several[int(random.integers(len(several)))]
    return several


def _mode(given):
    """An AutoresetMode by itself, its name or its value."""
    for mode in AutoresetMode:
        if getattr(given, "value", given) in (mode.name, mode.value):
            return mode
    raise ValueError(f"autoreset_mode: {given!r} is none of {', '.join(mode.name for mode in AutoresetMode)}")


class _Task:
    """What episodes have in common, and what is drawn for each."""
    TARGET = {"kind": "sine", "mean": 0.1, "amplitude": 0.05, "period": "4 s"}
    MOST, FASTEST = 0.5, 20.0  # contraction ratio [1] that no braid reaches, its speed [1/s]

    def __init__(self, rig, loads_kg, target, duration_s, jitter):
        for name, value in {"rig": rig, "target": target}.items():
            if isinstance(value, (list, tuple)) and not value:
                raise ValueError(f"{name}: a list of one at least, for each episode to draw from")
        if isinstance(rig, (list, tuple)):
            self.rig = [self.made(one) for one in rig]
        else:
            self.rig = rig if callable(rig) else self.made(rig)
        if numpy.shape(loads_kg) != (2,):
            raise ValueError("loads_kg: the lightest and the heaviest load, as (8.0, 23.0)")
        for name, value in {"duration_s": duration_s, "jitter": jitter}.items():
            if not isinstance(value, numbers.Real):
                raise ValueError(f"{name} = {value!r} is no number")
        self.loads_kg = tuple(sorted(map(float, loads_kg)))
        self.target = self.TARGET if target is None else target
        self.duration_s, self.jitter = float(duration_s), float(jitter)
        rigs = self.rig if isinstance(self.rig, list) else [] if callable(self.rig) else [self.rig]
        most = max((one.largest_contraction_ratio for one in rigs), default=self.MOST)
        self.action_space = Box(numpy.float32([-1.0]), numpy.float32([1.0]))
        self.observation_space = Box(numpy.float32([-most, -self.FASTEST, -1.0, -1.0]),
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
    def check(options):
        """Of a reset, before it changes anything; without what is of a VectorEnv."""
        if unknown := set(options) - {"load_kg"}:
            raise ValueError(f"options: {', '.join(sorted(map(repr, unknown)))} is unknown; there are load_kg and, of a "
                             "VectorEnv, reset_mask")

    def draw(self, random, options):
        """Rig, load [kg] and target of an episode."""
        rig = _one_of(self.rig, random)
        if callable(self.rig):
            rig = self.made(rig)
        target = _one_of(self.target, random)
        load_kg = float(options.get("load_kg", random.uniform(*self.loads_kg)))
        if self.fixed is not None:
            return rig, load_kg, self.fixed
        unit = rig.command_unit  # whoever is to follow it: a scenario wants a controller
        anybody = {"kind": "sine_current", "low": f"0 {unit}", "high": f"0.1 {unit}", "period": "1 s"}
        scenario = Scenario({"rig": rig, "loads": [f"{load!r} kg" for load in sorted(set(self.loads_kg))],
                             "target": target, "duration": f"{self.duration_s!r} s", "controllers": [anybody]})
        return rig, load_kg, scenario.target


class _Episode:
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
        space = self.task.observation_space
        seen = numpy.float32([self.last, speed_per_s, self.target[self.tick], self.action])
        return numpy.clip(seen, space.low, space.high)


class Env(Base):
    """Follow a target with an unknown load: an episode is one run.

    action       shape (1,), -1 to 1: the command, from the lower to the upper end of the valve's line; beyond it is cut
    observation  shape (4,): contraction ratio as the encoder counts it, its speed by these counts over the last
                 tick [1/s], the target at this tick [1], the command of the last tick (-1 to 1)
    reward       minus the absolute error of the counted contraction ratio, in per cent
    truncated    at the end of `duration`, after one step less than it has ticks; terminated where the simulation
                 cannot go on

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

    def __init__(self, rig="thesis", loads_kg=(8.0, 23.0), target=None, duration_s=12.0, jitter=0.0):
        """`rig`, `target` (as in scenario files): one, a list of which each episode draws one, or a function that makes
        one of a numpy.random.Generator; without `target` a sine from 0.05 to 0.15 every 4 s. `loads_kg`: between these
        each episode draws its load. `jitter`: root mean square of what shakes the reading, as a contraction ratio [1].
        Raises InputError, ValueError."""
        self.task = _Task(rig, loads_kg, target, duration_s, jitter)
        self.action_space, self.observation_space = self.task.action_space, self.task.observation_space
        self.loads_kg = self.task.loads_kg
        self.episode = self.ride = None
        self.rows = []

    @property
    def history(self):
        """The episode so far, a numpy array for each key, to be plotted: time_s, target, contraction_ratio as counted,
        command in the rig's unit, reward; a row for each step."""
        keys = ("time_s", "target", "contraction_ratio", "command", "reward")
        return dict(zip(keys, numpy.array(self.rows, dtype=float).reshape(-1, len(keys)).T))

    @property
    def rig(self):
        """Of this episode; before the first one as it was given."""
        return self.episode.rig if self.episode else self.task.rig

    @property
    def target(self):
        """Of this episode, tick by tick [1]; before the first one that of all, if there is one."""
        return self.episode.target if self.episode else self.task.fixed

    def reset(self, *, seed=None, options=None):
        """A new episode: (observation, info). `seed` decides its rig, target, load and jitter; `options` may say
        {"load_kg": ...}. The same seed, the same episode."""
        options = options or {}
        self.task.check(options)
        super().reset(seed=seed)
        self.episode = _Episode(self.task, self.np_random, options)
        self.ride = Ride(self.episode.rig, load_kg=self.episode.load_kg)
        self.rows = []
        return self.episode.begin(self.ride.reading.contraction_ratio), dict(self.episode.info)

    def step(self, action):
        """A tick: (observation, reward, terminated, truncated, info)."""
        if self.ride is None:
            raise RuntimeError("reset comes before the first step")
        if self.episode.over():
            raise RuntimeError("the episode has ended; reset begins another one")
        values = numpy.asarray(action, dtype=float)
        if values.size != 1 or not math.isfinite(values.flat[0]):
            raise ValueError(f"an action is one finite number, of shape (1,), not {action!r}")
        command = self.episode.command(float(values.flat[0]))
        unit = self.episode.rig.command_unit
        info = {"current_mA" if unit == "mA" else f"command_{unit}": command}
        terminated = False
        try:
            self.ride.step(command)
        except NumericalFailure as failure:
            terminated, info["failure"] = True, str(failure)
        observation, reward, truncated = self.episode.arrive(self.ride.reading.contraction_ratio)
        info.update(time_s=self.ride.time_s, true_contraction_ratio=float(self.ride.state[0]))
        self.rows.append((self.ride.time_s, self.episode.target[self.episode.tick], self.episode.last, command, reward))
        return observation, reward, terminated, truncated, info

    def render(self):
        """Nothing is drawn."""

    def close(self):
        """Nothing is kept open."""


class VectorEnv(VectorBase):
    """Many episodes at once in a Batch, each with rig, load and target of its own; arrays with a row for each.

    A member whose episode has ended is reset in the next step (its action is ignored, its reward is 0), in the same
    step (the last observation is in infos["final_obs"]), or by reset(options={"reset_mask": ...}): `autoreset_mode`.

    >>> import mckibben
    >>> envs = mckibben.VectorEnv(3, duration_s=1.2)
    >>> observations, infos = envs.reset(seed=3)
    >>> observations.shape, infos["load_kg"].shape
    ((3, 4), (3,))
    """

    render_mode = None

    def __init__(self, num_envs=1, rig="thesis", loads_kg=(8.0, 23.0), target=None, duration_s=12.0, jitter=0.0,
                 autoreset_mode=AutoresetMode.NEXT_STEP, threads=1):
        """As Env; rigs of one batch have the same tick and are commanded in the same unit."""
        self.task = _Task(rig, loads_kg, target, duration_s, jitter)
        if not isinstance(num_envs, numbers.Integral) or num_envs < 1:
            raise ValueError(f"num_envs = {num_envs!r}: a whole number, one at least")
        self.num_envs, self.threads = int(num_envs), threads
        self.autoreset_mode = _mode(autoreset_mode)
        self.metadata = {"render_modes": [], "autoreset_mode": self.autoreset_mode}
        self.single_action_space, self.single_observation_space = self.task.action_space, self.task.observation_space
        self.action_space = self._many(self.single_action_space)
        self.observation_space = self._many(self.single_observation_space)
        self.episodes, self.batch = [None] * self.num_envs, None
        self.random = [numpy.random.default_rng() for _ in self.episodes]
        self.ended = numpy.zeros(self.num_envs, dtype=bool)

    def _many(self, space):
        low, high = (numpy.repeat(end[None], self.num_envs, axis=0) for end in (space.low, space.high))
        return Box(low, high, dtype=numpy.float32)

    def reset(self, *, seed=None, options=None):
        """New episodes: (observations, infos). A seed is that of the first member, the next one has seed + 1; or one
        for each. With options {"reset_mask": booleans} these alone begin again, and the others stay where they are."""
        options = dict(options or {})
        mask = options.pop("reset_mask", None)
        self.task.check(options)
        super().reset(seed=seed if isinstance(seed, int) else None)
        if mask is not None:
            mask = numpy.asarray(mask)
            if mask.shape != (self.num_envs,) or mask.dtype != bool or not mask.any():
                raise ValueError("reset_mask: a boolean for each member, one of them true")
        if self.batch is None or mask is None:
            mask = numpy.ones(self.num_envs, dtype=bool)
        if numpy.ndim(seed) == 0:
            seed = [None if seed is None else seed + i for i in range(self.num_envs)]
        seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError("seed: one number, or one for each member")
        for i in numpy.flatnonzero(mask):
            if seeds[i] is not None:
                self.random[i] = numpy.random.default_rng(seeds[i])
        infos = {}
        self.observations = self._begin(numpy.flatnonzero(mask), options, infos)
        return self.observations.copy(), infos

    def step(self, actions):
        """A tick of all: (observations, rewards, terminations, truncations, infos)."""
        if self.batch is None:
            raise RuntimeError("reset comes before the first step")
        if self.autoreset_mode == AutoresetMode.DISABLED and self.ended.any():
            raise RuntimeError("an episode has ended; reset(options={'reset_mask': ...}) begins another one")
        actions = numpy.asarray(actions, dtype=float)
        if actions.shape not in ((self.num_envs, 1), (self.num_envs,)) or not numpy.isfinite(actions).all():
            raise ValueError(f"actions are a finite number for each member, of shape ({self.num_envs}, 1); these have "
                             f"the shape {actions.shape}")
        actions = actions.reshape(-1)
        waiting, infos = self.ended.copy(), {}
        self.batch.step([one.command(action) for one, action in zip(self.episodes, actions)])
        rewards = numpy.zeros(self.num_envs)
        terminations, truncations = (numpy.zeros(self.num_envs, dtype=bool) for _ in range(2))
        counted, failures = self.batch.contraction_ratio, self.batch.failures
        for i in numpy.flatnonzero(~waiting):
            self.observations[i], rewards[i], truncations[i] = self.episodes[i].arrive(counted[i])
            terminations[i] = i in failures
            self._note(infos, i, {"time_s": self.episodes[i].tick * self.episodes[i].rig.tick_s})
            if terminations[i]:
                self._note(infos, i, {"failure": failures[i]})
        self.ended = terminations | truncations
        if self.autoreset_mode == AutoresetMode.SAME_STEP:
            waiting = self.ended
            final = {}
            for i in numpy.flatnonzero(waiting):
                self._note(infos, i, {"final_obs": self.observations[i].copy()})
                self._note(final, i, {"time_s": infos["time_s"][i]})
            if final:
                infos["final_info"], infos["_final_info"] = final, waiting.copy()
        if self.autoreset_mode != AutoresetMode.DISABLED and waiting.any():
            self._begin(numpy.flatnonzero(waiting), {}, infos)
        return self.observations.copy(), rewards, terminations, truncations, infos

    def render(self):
        """Nothing is drawn."""

    def close(self, **kwargs):
        """Nothing is kept open."""

    def _begin(self, which, options, infos):
        """New episodes of these members; all observations."""
        for i in which:
            self.episodes[i] = _Episode(self.task, self.random[i], options)
        rigs, loads_kg = [self.episodes[i].rig for i in which], [self.episodes[i].load_kg for i in which]
        if len(which) == self.num_envs:
            self.batch = Batch(rigs, loads_kg, self.threads)
            self.observations = numpy.zeros(self.observation_space.shape, dtype=numpy.float32)
        else:
            self.batch.restart(which, rigs, loads_kg)
        counted = self.batch.contraction_ratio
        for i in which:
            self.observations[i] = self.episodes[i].begin(counted[i])
            self._note(infos, i, self.episodes[i].info)
        self.ended = self.ended.copy()
        self.ended[which] = False
        return self.observations

    def _note(self, infos, member, info):
        """Gymnasium's infos: an array for each key, and behind an underscore who has it."""
        for key, value in info.items():
            if key not in infos:
                number = isinstance(value, float)
                infos[key] = numpy.zeros(self.num_envs) if number else numpy.full(self.num_envs, None, dtype=object)
                infos["_" + key] = numpy.zeros(self.num_envs, dtype=bool)
            infos[key][member], infos["_" + key][member] = value, True


def drawn_rig(random):
    """The thesis's rig, but threads with half to twice the friction, a muscle up to a tenth thinner or thicker, a valve
    up to a third slower or quicker."""
    def factor(most):
        return float(most ** random.uniform(-1.0, 1.0))

    return {"base": "thesis", "friction": {"scale": factor(2.0)},
            "muscle": {"rest_radius": f"{7.5 * factor(1.1)!r} mm"},
            "valve": {"conductance": f"{4e-9 * factor(1.33)!r} m3/(s.Pa)"}}


def drawn_target(random):
    """A sine about some contraction, slow or quick."""
    return {"kind": "sine", "mean": float(random.uniform(0.06, 0.12)), "amplitude": float(random.uniform(0.01, 0.05)),
            "period": f"{float(random.uniform(2.0, 8.0))!r} s"}


def _register():
    for name, kwargs in {"Track-v0": {}, "TrackDrawn-v0": {"rig": drawn_rig, "target": drawn_target}}.items():
        if f"mckibben/{name}" not in gymnasium.registry:
            gymnasium.register(id=f"mckibben/{name}", entry_point="mckibben.env:Env",
                               vector_entry_point="mckibben.env:VectorEnv", kwargs=kwargs)


if gymnasium is not None:
    _register()
