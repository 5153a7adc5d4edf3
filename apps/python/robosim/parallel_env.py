"""A team of agents in one world, with the interface of PettingZoo's ParallelEnv."""
import numpy as np

from ._arguments import SEED_MAX, refuse, require_whole
from ._farama import ParallelEnvBase
from ._learning import (Copyable, Results, end_reason, make_batch, numbers_of, parts_of, size_of, spaces_of, worlds_of)


class ParallelEnv(Copyable, ParallelEnvBase):
    """The robots of a world as agents that act at the same time, with the interface of pettingzoo.ParallelEnv. It is
    one, with Gymnasium's spaces, when these packages are installed.

    world: World or file, or a WorldGenerator, which makes a new world for each episode.
    robots: the first robots of the world, which are the agents; 0: all. They may be of different types: each has the
        observation and action spaces of its own sensors, and leaves out parts of `observations` that only others have.
    Other arguments, observations (float32, shape (size,)), actions (shape (2,) or (3,)) and rewards are those of VectorEnv.
    infos has, for each agent, "step" (number of steps since the episode's beginning), "time_s" (simulated time since
    then), "gold_found" (whether a robot has found the gold), and in the step in which the episode ends "ended_by" ("win"
    or "max_steps") and "winner" (name of the robot that has won; None). All agents' episodes end together.
    Observations are copies. It can be pickled and deep-copied as a VectorEnv.
    """

    metadata = {"render_modes": [], "name": "robosim", "is_parallelizable": True}
    render_mode = None

    def __init__(self, world, robots=0, observations=("sonar", "heat"), reward=None, max_steps=1000, period_s=0.1,
                 random_starts=True, seed=1, start_distance_m=None, others="controllers"):
        worlds = worlds_of(world, "world")
        if isinstance(worlds, list) and len(worlds) != 1:
            raise ValueError(f"world is a list of {len(worlds)}; it must be one World or file, or a WorldGenerator")
        self._made_of = (worlds, 1, robots, observations, reward, period_s, max_steps, random_starts,
                         start_distance_m, 1, seed, others)
        self._batch = make_batch(*self._made_of)
        self.possible_agents = list(self._batch.agent_names)
        self.agents = []
        self.observation_spaces, self.action_spaces = {}, {}
        self._sizes = {}
        for index, agent in enumerate(self.possible_agents):
            self.observation_spaces[agent], self.action_spaces[agent] = spaces_of(self._batch, index)
            self._sizes[agent] = size_of(self._batch, index)
        self._results = Results(self._batch, 1)
        self._has_episode = False

    @property
    def world_seed(self):
        """Seed of the generated world; 0 before the first reset, and of a world that is not generated."""
        self._require_open()
        return int(self._batch.world_seeds[0])

    @property
    def num_agents(self):
        return len(self.agents)

    @property
    def max_num_agents(self):
        return len(self.possible_agents)

    def observation_space(self, agent):
        return self.observation_spaces[self._known(agent)]

    def action_space(self, agent):
        return self.action_spaces[self._known(agent)]

    def observation_parts(self, agent):
        """Slice of an agent's observation by the name of its part."""
        self._require_open()
        return parts_of(self._batch, self.possible_agents.index(self._known(agent)))

    def reset(self, seed=None, options=None):
        """Begins a new episode; returns observations and infos by agent. Without a seed, the next episode follows.

        options: any are accepted and none has an effect, as PettingZoo's tests require.
        """
        self._require_open()
        if seed is not None:
            require_whole("the seed", seed, 0, SEED_MAX)
            self._batch.set_seed(0, seed)
        self._batch.reset(self._results.observations)
        self._results.take_pictures(self._batch)
        self.agents = list(self.possible_agents)
        self._has_episode = True
        return self._observed(), self._infos(self.agents)

    def step(self, actions):
        """Takes a step; actions: by agent. Returns observations, rewards, terminations, truncations, infos by agent."""
        self._require_open()
        if not self._has_episode:
            raise RuntimeError("call reset() before the first step")
        if not hasattr(actions, "keys"):
            refuse("actions", actions, "a dict of an action for each agent", '{"R1": [0.5, 0]}')
        if set(actions) != set(self.agents):
            raise ValueError(f"actions are of the agents {sorted(actions)}; they must be of {sorted(self.agents)}")
        if not self.agents:
            return {}, {}, {}, {}, {}
        of_all = [numbers_of(actions[agent], f"the numbers of the action of agent '{agent}'", (self._batch.action_size,))
                  for agent in self.agents]
        for agent, action in zip(self.agents, of_all):
            if not np.all(np.isfinite(action)):
                raise ValueError(f"the action of agent '{agent}' is not finite; it must be in [-1, 1], for example [0.5, 0]")
        results = self._results
        self._batch.step([of_all], results.observations, results.rewards, results.terminated, results.truncated)
        results.take_pictures(self._batch)
        agents = self.agents
        rewards = dict(zip(agents, results.rewards[0].tolist()))
        terminated, truncated = bool(results.terminated[0]), bool(results.truncated[0])
        observed = self._observed()
        infos = self._infos(agents)
        if terminated or truncated:
            end = {"ended_by": end_reason(terminated, truncated), "winner": self._batch.winners[0]}
            for info in infos.values():
                info.update(end)
            self.agents = []
        return (observed, rewards, dict.fromkeys(agents, terminated), dict.fromkeys(agents, truncated), infos)

    def render(self):
        """Returns None: there is no render mode."""

    def close(self):
        self._batch = None
        self.agents = []

    @property
    def unwrapped(self):
        return self

    def _known(self, agent):
        if agent in self.possible_agents:
            return agent
        raise KeyError(f"there is no agent {agent!r}; the agents are {self.possible_agents}")

    def _require_open(self):
        if self._batch is None:
            raise ValueError("the environment is closed; make another one")

    def _infos(self, agents):
        step = int(self._batch.steps[0])
        info = {"step": step, "time_s": step * self._batch.period_s, "gold_found": bool(self._batch.gold_found[0])}
        return {agent: dict(info) for agent in agents}

    def _observed(self):
        def of_agent(index, agent):
            observed = self._results.observed(self._batch, lambda array: array[0, index].copy())
            if not isinstance(observed, dict):
                return observed[:self._sizes[agent]]
            if "numbers" in observed:
                observed["numbers"] = observed["numbers"][:self._sizes[agent]]
            return {name: observed[name] for name in self.observation_spaces[agent]}

        return {agent: of_agent(index, agent) for index, agent in enumerate(self.agents)}
