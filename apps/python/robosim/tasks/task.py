"""What all tasks have in common, and their environment."""
import numpy as np

from .._arguments import refuse
from .._farama import AutoresetMode, Box, VectorEnvBase
from .._learning import batched, numbers_of
from ..vector_env import VectorEnv

TRAINING_WORLDS = range(1, 33)
HELD_OUT_WORLDS = range(100_001, 100_101)  # training never uses them


class Task:
    """Definition of a task. An object belongs to one TaskEnv and keeps what its rewards need of the present episodes."""

    name = ""
    help = ""  # one sentence
    agents = 1  # the first robots of the world, which the actions drive
    observations = ()  # as of VectorEnv
    max_steps = 1000
    metrics = {}  # by name: "share" of episodes or "mean"; the first one is the score
    options = {}  # further arguments of VectorEnv
    robots = None  # number of robots that this class or the actions drive; None: agents

    @classmethod
    def world(cls, seed):
        """The World of a seed."""
        raise NotImplementedError

    @classmethod
    def changes(cls, seed):
        """Interventions with which episodes in that world begin (doc/interventions.md)."""
        return []

    @classmethod
    def handwritten(cls):
        """The hand-written baseline, a policy."""
        raise NotImplementedError

    @classmethod
    def features(cls, observations):
        """Numbers of similar size for NetworkPolicy: float32, shape (…, agents, features)."""
        raise NotImplementedError

    def complete(self, actions, env):
        """The actions of all robots: shape (num_envs, robots, 2)."""
        return actions

    def begin(self, env, which):
        """Episodes have begun in these environments."""

    def step(self, env, rewards, terminated):
        """Rewards (num_envs, agents) and ends (num_envs,) of a step.

        env: VectorEnv with all robots. rewards, terminated: those of its own.
        """
        raise NotImplementedError

    def results(self, env):
        """The metrics of the present episodes: arrays of shape (num_envs,) by name."""
        raise NotImplementedError


class TaskEnv(VectorEnvBase):
    """Environments of a task, with the interface of gymnasium.vector.VectorEnv 1.0 and next-step autoreset.

    Shapes are those of VectorEnv. infos has "step" and "time_s", and when an episode ends the metrics of the task and
    "ended_by": "task" (terminated) or "max_steps" (truncated), with Gymnasium's masks. Environments can be pickled and
    deep-copied as a VectorEnv.
    """

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}
    spec = None
    render_mode = None

    def __init__(self, task, num_envs, seeds, threads=1, seed=1):
        """seeds: of the worlds; environment i is in that of seed i modulo their number."""
        seeds = list(seeds)[:num_envs]
        self.task = task
        robots = task.robots or task.agents
        self._env = VectorEnv([task.world(of) for of in seeds], num_envs, robots=robots, observations=task.observations,
                              max_steps=task.max_steps, random_starts=False, threads=threads, seed=seed, **task.options)
        for i in range(num_envs):
            changes = task.changes(seeds[i % len(seeds)])
            if changes:
                self._env.set_interventions(i, changes)
        self.num_envs = num_envs
        self.agent_names = self._env.agent_names[:task.agents]
        whole = self._env.single_observation_space
        self._is_team = task.agents > 1
        low, high = (whole.low[:task.agents], whole.high[:task.agents]) if self._is_team else (whole.low, whole.high)
        self.single_observation_space = Box(low, high, low.shape, np.float32)
        self.single_action_space = Box(-1, 1, (task.agents, 2) if self._is_team else (2,), np.float32)
        self.observation_space = batched(self.single_observation_space, num_envs)
        self.action_space = batched(self.single_action_space, num_envs)
        self._over = np.ones(num_envs, bool)
        self.closed = False

    @property
    def observation_parts(self):
        """Slice of an agent's observation by the name of its part."""
        return self._env.observation_parts

    @property
    def np_random(self):
        return self._env.np_random

    @property
    def np_random_seed(self):
        return self._env.np_random_seed

    @property
    def unwrapped(self):
        return self

    def reset(self, *, seed=None, options=None):
        """Begins a new episode in every environment, or in those of options={"reset_mask": mask}."""
        if options is not None and not hasattr(options, "keys"):
            refuse("options", options, "a dict with 'reset_mask'", '{"reset_mask": np.ones(1, bool)}')
        if set(options or {}) - {"reset_mask"}:
            raise ValueError(f"unknown options {sorted(options)}; the only option of a task is 'reset_mask'")
        observations, infos = self._env.reset(seed=seed, options=options)
        which = infos["_step"]
        self.task.begin(self._env, which)
        self._over = self._over & ~which
        return self._of_agents(observations), self._times(infos)

    def step(self, actions):
        """Takes a step in every environment; returns observations, rewards, terminations, truncations and infos."""
        if self.closed:
            raise ValueError("the environment is closed; make another one")
        actions = numbers_of(actions, "actions", self.action_space.shape)
        begun = self._over
        observations, rewards, terminated, truncated, infos = self._env.step(self.task.complete(actions, self._env))
        if begun.any():
            self.task.begin(self._env, begun)
        rewards, ended = self.task.step(self._env, rewards, terminated)
        rewards = np.where(begun if rewards.ndim == 1 else begun[:, None], 0.0, rewards)
        ended = ended & ~begun
        truncated = truncated & ~ended
        if (ended & ~terminated).any():
            self._env._batch.end_episodes(ended)
        self._over = ended | truncated
        infos = self._times(infos)
        if self._over.any():
            over = self._over.copy()
            for name, values in self.task.results(self._env).items():
                infos[name], infos["_" + name] = np.asarray(values, np.float64), over
            reasons = np.where(ended, "task", np.where(truncated, "max_steps", None)).astype(object)
            infos["ended_by"], infos["_ended_by"] = reasons, over
        return self._of_agents(observations), rewards, ended, truncated, infos

    def render(self):
        """Returns None: there is no render mode."""

    def close(self, **kwargs):
        """Releases the environments."""
        self._env.close(**kwargs)
        self.closed = True

    def close_extras(self, **kwargs):
        self._env.close(**kwargs)

    def __enter__(self):
        return self

    def __exit__(self, *args):
        self.close()

    def __repr__(self):
        return f"TaskEnv({self.task.name!r}, num_envs={self.num_envs})"

    def _of_agents(self, observations):
        return observations[:, :self.task.agents] if self._is_team else observations

    @staticmethod
    def _times(infos):
        return {name: infos[name] for name in ("step", "_step", "time_s", "_time_s")}
