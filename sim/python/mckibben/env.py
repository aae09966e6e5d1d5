"""The rig as an environment for learning controllers, in the manner of Gymnasium: reset, step, spaces.

Gymnasium is not needed. Where it is installed, Env and VectorEnv are its environments, with ids: Track-v0,
TrackDrawn-v0, whose rigs and targets are drawn, and TrackPair-v0, two muscles against each other.
"""
import copy
import numbers

import numpy

from ._core import Batch, Ride, Rig
from .errors import NumericalFailure
from .task import Episode, Task, actions_of, drawn_rig, drawn_target, options_of, returned

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


def _mode(given):
    """An AutoresetMode by itself, its name or its value."""
    for mode in AutoresetMode:
        if getattr(given, "value", given) in (mode.name, mode.value):
            return mode
    raise ValueError(f"autoreset_mode: {given!r} is none of {', '.join(mode.name for mode in AutoresetMode)}")


def _no_rendering(mode):
    if mode is not None:
        raise ValueError(f"render_mode = {mode!r}: must be None; nothing is rendered, plot env.unwrapped.history")


class Rules:
    """What a subclass of Env or VectorEnv may override: its own reward, and its own end of an episode. Both are asked
    after each tick, before an episode begins again. Of a VectorEnv they get a row for each of its n members, always:
    observation[..., 0] is the position in both. Of those that wait for their reset (self.ended) `usual` is 0, the
    observation stays, and what is returned is ignored; episodes[i].tick is 1 in the first step of an episode."""

    def reward(self, observation, action, usual):
        """The reward of the tick that ended with `observation`; `usual` is minus the error in per cent, as Env says.
        Returns a number, of a VectorEnv n of them."""
        return usual

    def terminates(self, observation):
        """Whether the episode ends here. Returns a bool, of a VectorEnv n of them."""
        return numpy.zeros(observation.shape[:-1], dtype=bool)

    def __copy__(self):
        """An independent one that goes on from here, as of a Ride."""
        return copy.deepcopy(self)


class Env(Rules, Base):
    """Follow a target with an unknown load: an episode is one run.

    action       shape (1,), -1 to 1: the command, from the lower to the upper end of the valve's line; beyond it is cut
    observation  shape (4,): contraction ratio as the encoder counts it, its speed by these counts over the last
                 tick [1/s], the target at this tick [1], the command of the last tick (-1 to 1)
    reward       minus the absolute error of the counted contraction ratio, in per cent; another one: override
                 `reward`, and `terminates` for an end of your own
    two muscles  action (2,), one for each, the first for positive angles; observation (5,): angle [rad], its speed,
                 the target [rad], both commands; reward minus the error in hundredths of a rad; no load hangs
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

    def __init__(self, rig="thesis", loads_kg=None, target=None, duration_s=12.0, jitter=0.0, render_mode=None):
        """`rig`, `target` (as in scenario files; of a pair an angle): one, a list of which each episode draws one, or a
        function that makes one of a numpy.random.Generator; without `target` a sine from 0.05 to 0.15 every 4 s, of a
        pair from -15 to 15 deg. `loads_kg`: a load, or two between which each episode draws its
        own, in either order; if left out, three quarters to one and a half of `usual_load_kg` of the episode's rig.
        `jitter`: root mean square of what shakes the position before it is counted, as a contraction ratio [1] or an
        angle [rad], with the noise that the rig's sensor has.
        Nothing is rendered: plot `history`. Raises InputError, ValueError."""
        _no_rendering(render_mode)
        self.task = Task(rig, loads_kg, target, duration_s, jitter)
        self.action_space, self.observation_space = (Box(*ends) for ends in (self.task.acted, self.task.observed))
        self.episode = self.ride = None
        self.ended = False

    @property
    def history(self):
        """The episode so far, a numpy array for each key, to be plotted: time_s, target, contraction_ratio as counted,
        command in the rig's unit, held up to this time, reward; a row for each step. Behind Gymnasium's wrappers:
        env.unwrapped.history."""
        return self.episode.history if self.episode else self.task.history([])

    def recording(self, id="episode"):
        """The episode so far as a run of measured data with its rig: mckibben.Dataset({"runs": [env.recording()]}).
        There a row has the command from its time on; the first one is at rest, a tick before. Of a member of a VectorEnv:
        envs.episodes[i].recording(), and .history."""
        if self.episode is None:
            raise RuntimeError("reset comes before the first recording")
        return self.episode.recording(id)

    def scenario(self, controllers, **keys):
        """The Scenario of this episode's rig, load, target, duration and jitter for others to control:
        env.scenario([{"kind": "pid"}]).run(). `keys`: further ones of scenario files, such as noise={...} or seed=2
        (of the noise; 1 if left out), or others in place of these. Of a member of a VectorEnv: envs.episodes[i].scenario(...)."""
        if self.episode is None:
            raise RuntimeError("reset comes before the first scenario")
        return self.episode.scenario(controllers, **keys)

    @property
    def rig(self):
        """Of this episode; before the first one as it was given."""
        return self.episode.rig if self.episode else self.task.rig

    @property
    def loads_kg(self):
        """The lightest and the heaviest that episodes draw; where none were given those of this episode's rig, and None
        before it is drawn or of a pair."""
        if self.task.pair:
            return None
        return self.task.loads_of(self.rig) if isinstance(self.rig, Rig) else self.task.loads_kg

    @property
    def target(self):
        """Of this episode, tick by tick [1] or [rad]; before the first one that of all, if there is one."""
        return self.episode.target if self.episode else self.task.fixed

    def reset(self, *, seed=None, options=None):
        """A new episode: (observation, info). `seed` decides its rig, target, load, jitter and noise; `options` may say
        {"load_kg": ...}. The same seed, the same episode; in a VectorEnv it agrees within the solver's tolerance, so that
        a count may differ."""
        options = options_of(options)
        self.task.check(options, seed)
        super().reset(seed=None if seed is None else int(seed))  # Gymnasium takes no whole number of NumPy's
        episode = Episode(self.task, self.np_random, options)
        self.ride, self.episode = Ride(episode.rig, load_kg=episode.load_kg, jitter=episode.shake()), episode
        self.ended = False
        return self.task.observation(self.episode.begin(self._counted())), dict(self.episode.info)

    def step(self, action):
        """A tick: (observation, reward, terminated, truncated, info). info has commands, time_s, and
        true_contraction_ratio or, of a pair, true_angle_rad: what is read, before it is counted; beyond_e_max:
        whether a muscle is shorter than a real one can be."""
        if self.ride is None:
            raise RuntimeError("reset comes before the first step")
        if self.ended:
            raise RuntimeError("the episode has ended; reset begins another one")
        commands = self.episode.commands(actions_of(action, self.action_space.shape).tolist())
        info = dict(zip(self.task.command_names(self.episode.rig.command_unit), commands))
        terminated = False
        self.ride.jitter = self.episode.shake()
        try:
            self.ride.step(**dict(zip(("command", "opposite_command"), commands)))
        except NumericalFailure as failure:
            terminated, info["failure"] = True, str(failure)
        seen, usual, truncated = self.episode.arrive(self._counted())
        observation = self.task.observation(seen)
        reward = float(returned("reward", self.reward(observation, numpy.array(self.episode.action), usual), ()))
        self.episode.rewarded(reward)
        terminated = terminated or bool(returned("terminates", self.terminates(observation), ()))
        self.ended = terminated or truncated
        info.update(self.episode.truth(self.ride), time_s=self.ride.time_s)
        return observation, reward, terminated, truncated, info

    def _counted(self):
        return getattr(self.ride.reading, self.task.reads)

    def render(self):
        """Nothing is drawn."""

    def close(self):
        """Nothing is kept open."""


class PairEnv(Env):
    """TrackPair-v0: Env with a pair of muscles."""

    def __init__(self, rig="thesis_pair", *args, **keys):
        super().__init__(rig, *args, **keys)
        if not self.task.pair:
            raise ValueError("rig: must have two muscles here; Track-v0 is of one. Pairs are drawn by functions such as "
                             "lambda random: {**mckibben.env.drawn_rig(random), 'base': 'thesis_pair'}")


class VectorEnv(Rules, VectorBase):
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

    def __init__(self, num_envs=1, rig="thesis", loads_kg=None, target=None, duration_s=12.0, jitter=0.0,
                 autoreset_mode=AutoresetMode.NEXT_STEP, threads=1, render_mode=None):
        """As Env; rigs of one batch have the same tick and are commanded in the same unit. `threads`: 0 is as many as
        the machine has; results do not depend on them."""
        _no_rendering(render_mode)
        self.task = Task(rig, loads_kg, target, duration_s, jitter)
        if self.task.pair:
            raise ValueError("rig: a VectorEnv is of rigs with one muscle; make one Env for each pair, such as by "
                             "gymnasium.make_vec(..., vectorization_mode='async')")
        for name, value, least in (("num_envs", num_envs, 1), ("threads", threads, 0)):
            if not isinstance(value, numbers.Integral) or value < least:
                raise ValueError(f"{name} = {value!r}: a whole number, {least} at least")
        self.num_envs, self.threads = int(num_envs), int(threads)
        self.autoreset_mode = _mode(autoreset_mode)
        self.metadata = {"render_modes": [], "autoreset_mode": self.autoreset_mode}
        self.single_action_space, self.single_observation_space = (
            Box(*ends) for ends in (self.task.acted, self.task.observed))
        self.action_space = self._many(self.single_action_space)
        self.observation_space = self._many(self.single_observation_space)
        self.episodes, self.batch = [None] * self.num_envs, None
        self.finished = [None] * self.num_envs  # the episode before, of members that began again by themselves
        self.random = [numpy.random.default_rng() for _ in self.episodes]
        self.seeds = [None] * self.num_envs  # where they are known
        self.ended = numpy.zeros(self.num_envs, dtype=bool)

    def _many(self, space):
        low, high = (numpy.repeat(end[None], self.num_envs, axis=0) for end in (space.low, space.high))
        return Box(low, high, dtype=numpy.float32)

    def reset(self, *, seed=None, options=None):
        """New episodes: (observations, infos). A seed is that of the first member, the next one has seed + 1; or one
        for each. With options {"reset_mask": booleans} these alone begin again, and the others stay where they are;
        {"load_kg": ...} is one for all, or one for each member."""
        options = options_of(options)
        mask = options.pop("reset_mask", None)
        seeds = [seed] * self.num_envs if numpy.ndim(seed) == 0 else list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed = {seed!r}: one number, or one for each of {self.num_envs} members")
        loads = options.get("load_kg")
        each = [options] * self.num_envs
        if numpy.ndim(loads):
            if numpy.shape(loads) != (self.num_envs,):
                raise ValueError(f"options: load_kg = {loads!r}: one mass, or one for each of {self.num_envs} members")
            each = [{**options, "load_kg": load} for load in numpy.asarray(loads).tolist()]
        for one in each:
            self.task.check(one, *seeds, known="there are load_kg and reset_mask")
        super().reset(seed=None if seed is None or numpy.ndim(seed) else int(seed))
        if mask is not None:
            mask = numpy.asarray(mask)
            if mask.shape != (self.num_envs,) or mask.dtype != bool or not mask.any():
                raise ValueError(f"reset_mask = {mask.tolist()}: must be a boolean for each of {self.num_envs} members, one of "
                                 "them true")
        if self.batch is None or mask is None:
            mask = numpy.ones(self.num_envs, dtype=bool)
        for i in numpy.flatnonzero(mask):
            if seeds[i] is not None:
                self.seeds[i] = int(seeds[i]) + (0 if numpy.ndim(seed) else int(i))
                self.random[i] = numpy.random.default_rng(self.seeds[i])
        infos = {}
        self.observations = self._begin(numpy.flatnonzero(mask), each, infos)
        return self.observations.copy(), infos

    def step(self, actions):
        """A tick of all: (observations, rewards, terminations, truncations, infos)."""
        if self.batch is None:
            raise RuntimeError("reset comes before the first step")
        if self.autoreset_mode == AutoresetMode.DISABLED and self.ended.any():
            raise RuntimeError("an episode has ended; reset(options={'reset_mask': ...}) begins another one")
        actions = actions_of(actions, (self.num_envs, 1)).tolist()
        waiting, infos = self.ended.copy(), {}
        commands = numpy.array([one.commands(action)[0] for one, action in zip(self.episodes, actions)])
        self.batch.jitter = [0.0 if waits else one.shake() for waits, one in zip(waiting, self.episodes)]
        self.batch.step(commands)
        usual, truncations = numpy.zeros(self.num_envs), numpy.zeros(self.num_envs, dtype=bool)
        counted, failures = self.batch.contraction_ratio.tolist(), self.batch.failures
        moved = numpy.flatnonzero(~waiting).tolist()
        if moved:
            seen, usual[moved], truncations[moved] = zip(*(self.episodes[i].arrive(counted[i]) for i in moved))
            self.observations[moved] = self.task.observation(seen)
        now, acted = self.observations.copy(), numpy.array([one.action for one in self.episodes])
        rewards = returned("reward", self.reward(now, acted, usual), waiting.shape, waiting).astype(float)
        for i in moved:
            self.episodes[i].rewarded(float(rewards[i]))
        terminations = returned("terminates", self.terminates(now), waiting.shape, waiting).astype(bool)
        failed = [i for i in moved if i in failures]
        terminations[failed] = True
        name, = self.task.command_names(self.episodes[0].rig.command_unit)
        true = self.batch.state[moved, 0]
        self._note(infos, moved, {name: commands[moved], "true_contraction_ratio": true,
                                  "beyond_e_max": true > [self.episodes[i].e_max for i in moved],
                                  "time_s": numpy.array([self.episodes[i].tick * self.episodes[i].tick_s for i in moved])})
        self._note(infos, failed, {"failure": [failures[i] for i in failed]})
        self.ended = terminations | truncations
        if self.autoreset_mode == AutoresetMode.SAME_STEP:
            if self.ended.any():
                ended, final = numpy.flatnonzero(self.ended), {}
                for key in [key for key in infos if not key.startswith("_")]:
                    has = infos["_" + key] & self.ended
                    self._note(final, numpy.flatnonzero(has), {key: infos[key][has]})
                    infos["_" + key] &= ~self.ended
                self._note(infos, ended, {"final_obs": [self.observations[i].copy() for i in ended]})
                infos["final_info"], infos["_final_info"] = final, self.ended.copy()
            waiting = waiting | self.ended
        if self.autoreset_mode != AutoresetMode.DISABLED and waiting.any():
            self.ended = self.ended | waiting  # where no episode can be drawn they still wait, for another try
            again = numpy.flatnonzero(waiting)
            before = [self.episodes[i] for i in again]
            self._begin(again, [{}] * self.num_envs, infos)
            for i, one in zip(again, before):
                self.finished[i] = one
        return self.observations.copy(), rewards, terminations, truncations, infos

    def render(self):
        """Nothing is drawn."""

    def close(self, **kwargs):
        """Nothing is kept open."""

    def _begin(self, which, options, infos):
        """New episodes of these members; all observations."""
        begun = [self._episode(i, options[i]) for i in which]
        rigs, loads_kg, jitter = zip(*((one.rig, one.load_kg, one.shake()) for one in begun))
        if len(which) == self.num_envs:
            self.batch = Batch(rigs, loads_kg, self.threads, jitter=jitter)
            self.observations = numpy.zeros(self.observation_space.shape, dtype=numpy.float32)
        else:
            self.batch.restart(which, rigs, loads_kg, jitter=jitter)
        for i, one in zip(which, begun):
            self.episodes[i] = one
        counted = self.batch.contraction_ratio.tolist()
        self.observations[which] = self.task.observation([self.episodes[i].begin(counted[i]) for i in which])
        for key in self.episodes[which[0]].info:
            self._note(infos, which, {key: numpy.array([self.episodes[i].info[key] for i in which])})
        self.ended = self.ended.copy()
        self.ended[which] = False
        return self.observations

    def _episode(self, i, options):
        try:
            return Episode(self.task, self.random[i], options)
        except (ValueError, TypeError, OSError) as error:
            seed = "" if self.seeds[i] is None else f", of seed {self.seeds[i]}"
            error.args = f"member {i}{seed}: {error}", *error.args[1:]
            raise

    def _note(self, infos, which, info):
        """Gymnasium's infos: an array for each key, and behind an underscore who has it. Of these members: arrays of
        numbers, or lists of anything."""
        for key, values in info.items():
            if not len(values):
                continue
            if key not in infos:
                kind = values.dtype if isinstance(values, numpy.ndarray) else object
                infos[key], infos["_" + key] = numpy.zeros(self.num_envs, dtype=kind), numpy.zeros(self.num_envs, dtype=bool)
            if infos[key].dtype == object:
                for i, value in zip(which, values):
                    infos[key][i] = value
            else:
                infos[key][which] = values
            infos["_" + key][which] = True


def _register():
    one = {"entry_point": "mckibben.env:Env", "vector_entry_point": "mckibben.env:VectorEnv"}
    for name, spec in {"Track-v0": one, "TrackDrawn-v0": {**one, "kwargs": {"rig": drawn_rig, "target": drawn_target}},
                       "TrackPair-v0": {"entry_point": "mckibben.env:PairEnv"}}.items():
        if f"mckibben/{name}" not in gymnasium.registry:
            gymnasium.register(id=f"mckibben/{name}", **spec)


if gymnasium is not None:
    _register()
