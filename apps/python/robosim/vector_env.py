"""Many environments that step together, with the interface of Gymnasium 1.0's VectorEnv."""
import numpy as np

from ._arguments import SEED_MAX, refuse, require_whole
from ._farama import AutoresetMode, VectorEnvBase
from ._learning import (Copyable, Results, batched, end_reason, make_batch, numbers_of, parts_of, spaces_of, worlds_of)


class VectorEnv(Copyable, VectorEnvBase):
    """Many environments that step together in this process, with the semantics of gymnasium.vector.VectorEnv 1.0. It is
    one, with Gymnasium's spaces and AutoresetMode, when Gymnasium is installed.

    worlds: World or file, or a list of them; environment i is of world i modulo their number. Or a WorldGenerator: each
        episode has a new world, which depends on the environment's seed and the number of the episode.
    num_envs: number of environments.
    robots: the first robots of each world, which are the agents. 0: all robots. Actions drive them, whatever controller
        the world names. Of agents of different types each leaves out the parts of `observations` that only others have;
        the rest of its row is 0, within bounds of 0.
    others: "controllers": the other robots are driven by the controllers that the world names for them, and stand still
        without one; "still": all stand still.
    observations: parts of an observation: kinds of sensors, labels of sensors, "stalled", "pose" (Simulation.readings() lists them).
    reward: weights by name: "win" (1 when the world is won), "forward" (distance driven [m]), "heat" (increase of the
        reading [°C]), "stall" (1 when an obstacle stopped the robot), "step" (1). Default {"win": 1}.
    max_steps: an episode of so many steps is truncated.
    period_s: length of a step, (0, 1] s.
    random_starts: each episode starts at random poses, which depend on the seed; else at the world's.
    start_distance_m: distance that random starts keep from the gold. None: that of the world file, or else the range of
        the heat sensors, or that of the farthest tenth of the free places.
    threads: they do not affect the results.

    Observations are float32 of shape (num_envs, size); of several agents (num_envs, agents, size). With ray-cast cameras
    among `observations` (doc/raycast_cameras.md) they are dicts: "camera" of uint8 (num_envs, height, width, 3), "camera_depth"
    of float32 [m] and "camera_identity" of uint32 (num_envs, height, width), for the layers that the camera has; all other
    parts are "numbers", if there are any. Pixels are 0 in a step in which the camera takes no picture.

    Actions are of shape
    (num_envs, 2) or (num_envs, agents, 2): speed and turn rate as fractions of the robot's maximum, clipped to [-1, 1];
    3 numbers, the third a lateral speed, if any agent has an omnidirectional drive.
    Rewards are float64 of shape (num_envs,) or (num_envs, agents).

    The step in which an episode ends returns its final observation. The next step ignores the action of that
    environment, begins its next episode, and returns its first observation with reward 0 (AutoresetMode.NEXT_STEP).

    infos has, by environment, "step": number of steps since the episode's beginning, int64; "time_s": simulated time
    since then; "gold_found": whether a robot has found the gold; and when an episode ends "ended_by": "win" or
    "max_steps", and "winner": name of the robot that has won. Each has Gymnasium's mask ("_step"); values are None where
    the masks of the last two are False.

    An environment can be pickled, deep-copied and sent to a spawned process; the copy continues bit for bit. Within an
    episode in which controllers drive other robots only copy.deepcopy() is possible.

    The engine writes into the returned arrays without a copy, alternating between two sets: they keep their values
    until the next but one call of step() or reset(). Copy what is to be kept for longer.
    """

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}
    spec = None
    render_mode = None

    def __init__(self, worlds, num_envs=1, robots=1, observations=("sonar", "heat"), reward=None, max_steps=1000,
                 period_s=0.1, random_starts=True, threads=1, seed=1, start_distance_m=None, others="controllers"):
        self.closed = True
        self._made_of = (worlds_of(worlds), num_envs, robots, observations, reward, period_s, max_steps, random_starts,
                         start_distance_m, threads, seed, others)
        self._batch = make_batch(*self._made_of)
        self.closed = False
        self.num_envs = int(num_envs)
        self.agent_names = tuple(self._batch.agent_names)
        agent = 0 if robots == 1 else None
        self.single_observation_space, self.single_action_space = spaces_of(self._batch, agent)
        self.observation_space = batched(self.single_observation_space, self.num_envs)
        self.action_space = batched(self.single_action_space, self.num_envs)
        self._sets = [Results(self._batch, self.num_envs) for _ in range(2)]
        self._action_shape = (self.num_envs, self._batch.agents, self._batch.action_size)
        self._has_episode = np.zeros(self.num_envs, bool)
        self._all = np.ones(self.num_envs, bool)
        self._is_ready = False
        self._np_random = None
        self._np_random_seed = None

    @property
    def observation_parts(self):
        """Slice of the first agent's observation by the name of its part."""
        return parts_of(self._batch, 0)

    @property
    def agent_observation_parts(self):
        """The slices of each agent, by its name."""
        return {name: parts_of(self._batch, index) for index, name in enumerate(self.agent_names)}

    @property
    def world_seeds(self):
        """Seed of each environment's generated world: uint64, shape (num_envs,); WorldGenerator.generate(seed) makes
        it again. 0 before the first reset, and of worlds that are not generated."""
        self._require_open()
        return self._batch.world_seeds

    def reset(self, *, seed=None, options=None):
        """Begins a new episode in every environment; returns observations and infos.

        seed: environment i gets seed + i (modulo 2^64); or a list of a seed or None for each. Without one, the next episodes follow.
        options: {"reset_mask": bool array of shape (num_envs,)} resets the selected environments only.
            {"interventions": {environment: [element, …]}} are set by set_interventions() before the episodes begin.
        """
        self._require_open()
        if options is not None and not hasattr(options, "keys"):
            refuse("options", options, "a dict with 'reset_mask' and 'interventions'", '{"interventions": {0: []}}')
        options = dict(options or {})
        mask = options.pop("reset_mask", None)
        interventions = options.pop("interventions", None) or {}
        if not hasattr(interventions, "items"):
            refuse("options['interventions']", interventions, "a dict of lists of elements by environment",
                   "{0: ['<remove name=\"Puck1\"/>']}")
        if options:
            raise ValueError(f"unknown options {sorted(options)}; options are 'reset_mask' and 'interventions'")
        selected = np.ones(self.num_envs, bool) if mask is None else mask
        if not isinstance(selected, np.ndarray) or selected.dtype != bool or selected.shape != (self.num_envs,):
            raise TypeError(f"reset_mask must be a bool array of shape ({self.num_envs},), "
                            f"for example np.ones({self.num_envs}, bool)")
        seeds = self._seeds_of(seed)
        for environment, elements in interventions.items():
            self.set_interventions(environment, elements)
        results = self._sets[1]
        if mask is not None:
            results.observations[:] = self._sets[0].observations
        for index, of_one in enumerate(seeds):
            if of_one is not None and selected[index]:
                self._batch.set_seed(index, of_one)
        self._batch.reset(results.observations, mask)
        results.take_pictures(self._batch)
        self._has_episode |= selected
        self._is_ready = bool(self._has_episode.all())
        self._sets.reverse()
        return self._observed(results), self._infos(selected, self._batch.steps, self._batch.gold_found)

    def set_interventions(self, environment, elements):
        """The following episodes of an environment begin with these changes, until others are set; [] for none.

        elements: XML elements of doc/interventions.md, in metres and radians, applied in their order: place, add,
            remove, change, open, activity, communication. The first observation is of the changed world.

        A change that is impossible when an episode begins (it overlaps a robot at a random start) raises ConfigError in
        reset() or step(); the next call begins the next episode. Set others before the step that begins an episode, the
        one after its end, to give each episode changes of its own.
        """
        self._require_open()
        require_whole("the environment", environment, 0, self.num_envs - 1)
        if isinstance(elements, str):
            elements = [elements]
        if not np.iterable(elements) or not all(isinstance(element, str) for element in elements):
            refuse("elements", elements, "a list of XML elements as str", "['<remove name=\"Puck1\"/>']")
        self._batch.set_interventions(int(environment), list(elements))

    def step(self, actions):
        """Takes a step in every environment; returns observations, rewards, terminations, truncations and infos."""
        self._require_open()
        if not self._is_ready:
            raise RuntimeError("call reset() before the first step")
        actions = numbers_of(actions, "actions", self.action_space.shape).reshape(self._action_shape)
        results = self._sets[1]
        steps, gold_found, have_ended = self._batch.step(actions, results.observations, results.rewards,
                                                         results.terminated, results.truncated)
        results.take_pictures(self._batch)
        self._sets.reverse()
        rewards = results.rewards if len(self.action_space.shape) == 3 else results.rewards[:, 0]
        infos = self._infos(self._all, steps, gold_found)
        if have_ended:
            reasons = [end_reason(*flags) for flags in zip(results.terminated, results.truncated)]
            infos["ended_by"], infos["_ended_by"] = np.array(reasons, object), results.terminated | results.truncated
            if results.terminated.any():
                infos["winner"] = self._batch.winners
                infos["_winner"] = results.terminated.copy()
        return self._observed(results), rewards, results.terminated, results.truncated, infos

    def render(self):
        """Returns None: there is no render mode."""

    def close(self, **kwargs):
        """Releases the environments. Arrays keep their values."""
        if not self.closed:
            self.close_extras(**kwargs)
            self.closed = True

    def close_extras(self, **kwargs):
        self._batch = None

    @property
    def np_random(self):
        """A generator seeded by reset(seed=…), for wrappers; the environments have random numbers of their own."""
        if self._np_random is None:
            self._seed_generator(None)
        return self._np_random

    @np_random.setter
    def np_random(self, value):
        self._np_random = value
        self._np_random_seed = -1

    @property
    def np_random_seed(self):
        """Seed of np_random; -1 if unknown."""
        if self._np_random is None:
            self._seed_generator(None)
        return self._np_random_seed

    @property
    def unwrapped(self):
        return self

    def __enter__(self):
        return self

    def __exit__(self, *args):
        self.close()

    def __repr__(self):
        return f"VectorEnv(num_envs={self.num_envs}, agents={len(self.agent_names)})"

    def _require_open(self):
        if self.closed:
            raise ValueError("the environment is closed; make another one")

    def _seed_generator(self, seed):
        sequence = np.random.SeedSequence(seed)
        self._np_random = np.random.Generator(np.random.PCG64(sequence))
        self._np_random_seed = sequence.entropy

    def _seeds_of(self, seed):
        if seed is None:
            return [None] * self.num_envs
        if isinstance(seed, (int, np.integer)) or not np.iterable(seed):
            require_whole("the seed", seed, 0, SEED_MAX)
            self._seed_generator(int(seed))
            return [(int(seed) + i) % (SEED_MAX + 1) for i in range(self.num_envs)]
        seeds = list(seed)
        for of_one in seeds:
            if of_one is not None:
                require_whole("the seed", of_one, 0, SEED_MAX)
        if len(seeds) != self.num_envs:
            raise ValueError(f"there are {len(seeds)} seeds; {self.num_envs} are required, one for each environment, "
                             f"for example seed=list(range({self.num_envs}))")
        return seeds

    def _infos(self, which, steps, gold_found):
        """In Gymnasium's form: an array for each name, and whether it is given for each environment."""
        return {"step": steps, "_step": which, "time_s": steps * self._batch.period_s, "_time_s": which,
                "gold_found": gold_found, "_gold_found": which}

    def _observed(self, results):
        has_agents = len(self.action_space.shape) == 3
        return results.observed(self._batch, lambda array: array if has_agents else array[:, 0])
