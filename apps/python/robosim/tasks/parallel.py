"""A task as PettingZoo's ParallelEnv."""
import numpy as np

from .._arguments import refuse
from .._farama import Box, ParallelEnvBase


class TaskParallelEnv(ParallelEnvBase):
    """One environment of a task, with the interface of pettingzoo.ParallelEnv. All agents' episodes end together.

    infos has, for each agent, always the same numbers, as TorchRL requires: "step", "time_s", and the metrics of the task, which
    are 0 until the episode ends.
    """

    metadata = {"render_modes": [], "name": "robosim_task", "is_parallelizable": True}
    render_mode = None

    def __init__(self, env):
        """env: TaskEnv of one environment."""
        self._env = env
        self.possible_agents = list(env.agent_names)
        self.agents = []
        low, high = (bound.reshape(len(self.possible_agents), -1)
                     for bound in (env.single_observation_space.low, env.single_observation_space.high))
        self.observation_spaces = {agent: Box(low[i], high[i], low[i].shape, np.float32)
                                   for i, agent in enumerate(self.possible_agents)}
        self.action_spaces = {agent: Box(-1, 1, (2,), np.float32) for agent in self.possible_agents}

    @property
    def num_agents(self):
        return len(self.agents)

    @property
    def max_num_agents(self):
        return len(self.possible_agents)

    def observation_space(self, agent):
        return self.observation_spaces[agent]

    def action_space(self, agent):
        return self.action_spaces[agent]

    def reset(self, seed=None, options=None):
        """Begins a new episode; returns observations and infos by agent. Options have no effect."""
        observations, infos = self._env.reset(seed=seed)
        self.agents = list(self.possible_agents)
        return self._by_agent(observations), self._infos(infos)

    def step(self, actions):
        """Takes a step; actions: by agent."""
        if not hasattr(actions, "keys"):
            refuse("actions", actions, "a dict of an action for each agent", '{"R1": [0.5, 0]}')
        if set(actions) != set(self.agents):
            raise ValueError(f"actions are of the agents {sorted(actions)}; they must be of {sorted(self.agents)}")
        if not self.agents:
            return {}, {}, {}, {}, {}
        of_all = np.array([actions[agent] for agent in self.agents], np.float32)
        observations, rewards, terminated, truncated, infos = self._env.step(of_all.reshape(self._env.action_space.shape))
        agents = self.agents
        of_step = (self._by_agent(observations), dict(zip(agents, map(float, np.ravel(rewards)))),
                   dict.fromkeys(agents, bool(terminated[0])), dict.fromkeys(agents, bool(truncated[0])),
                   self._infos(infos))
        if terminated[0] or truncated[0]:
            self.agents = []
        return of_step

    def render(self):
        """Returns None: there is no render mode."""

    def close(self):
        self._env.close()
        self.agents = []

    @property
    def unwrapped(self):
        return self

    def _by_agent(self, observations):
        rows = observations[0].reshape(len(self.possible_agents), -1)
        return {agent: rows[i].copy() for i, agent in enumerate(self.possible_agents)}

    def _infos(self, infos):
        info = {"step": int(infos["step"][0]), "time_s": float(infos["time_s"][0])}
        for name in self._env.task.metrics:
            info[name] = float(infos[name][0]) if name in infos else 0.0
        return {agent: dict(info) for agent in self.possible_agents}
