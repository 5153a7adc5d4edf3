"""Tasks of RoboSim as environments of TorchRL: RoboSimEnv, with a batch of environments in one process.

    env = RoboSimEnv("pursuit-v1", num_envs=64)
    data = env.rollout(100, break_when_any_done=False)

A team is one group "agents" with the keys ("agents", "observation"), ("agents", "action") and ("agents", "reward"). Ends are those of
the environment."""
import numpy as np
import torch
from tensordict import TensorDict
from torchrl.data import Bounded, Categorical, Composite, Unbounded
from torchrl.envs import EnvBase

import robosim


class RoboSimEnv(EnvBase):
    def __init__(self, task, num_envs=1, *, split="train", threads=1, seed=1, device="cpu"):
        super().__init__(device=device, batch_size=torch.Size([num_envs]))
        self.task_env = robosim.make(task, num_envs, split=split, threads=threads, seed=seed)
        self.agents = len(self.task_env.agent_names)
        size = self.task_env.single_observation_space.shape[-1]
        team = (num_envs, self.agents)

        def grouped(**specs):
            return Composite(agents=Composite(specs, shape=team), shape=(num_envs,)).to(device)

        self.observation_spec = grouped(observation=Unbounded((*team, size), dtype=torch.float32))
        self.action_spec = grouped(action=Bounded(-1.0, 1.0, (*team, 2), dtype=torch.float32))
        self.reward_spec = grouped(reward=Unbounded((*team, 1), dtype=torch.float32))
        self.done_spec = Composite({name: Categorical(2, shape=(num_envs, 1), dtype=torch.bool)
                                    for name in ("done", "terminated", "truncated")}, shape=(num_envs,)).to(device)
        self._next_seed = None

    def _observed(self, observations):
        # A copy: RoboSim writes the step after the next one into the same array.
        return torch.tensor(observations.reshape(*self.batch_size, self.agents, -1), device=self.device)

    def _reset(self, tensordict=None, **kwargs):
        mask = np.ones(self.batch_size[0], bool)
        if tensordict is not None and "_reset" in tensordict.keys():
            mask = tensordict["_reset"].reshape(-1).cpu().numpy()
        # The environments of the mask begin their next episode; the others keep their observations.
        options = {"reset_mask": mask} if not mask.all() else None
        observations, _ = self.task_env.reset(seed=self._next_seed, options=options)
        self._next_seed = None
        return TensorDict({"agents": {"observation": self._observed(observations)}}, self.batch_size, device=self.device)

    def _step(self, tensordict):
        actions = tensordict["agents", "action"].clamp(-1, 1).cpu().numpy().reshape(self.task_env.action_space.shape)
        observations, rewards, terminated, truncated, _ = self.task_env.step(actions)
        flags = {"terminated": terminated, "truncated": truncated, "done": terminated | truncated}
        of_step = {name: torch.tensor(flag, device=self.device)[:, None] for name, flag in flags.items()}
        reward = torch.tensor(rewards, dtype=torch.float32, device=self.device).reshape(*self.batch_size, self.agents, 1)
        of_step["agents"] = {"observation": self._observed(observations), "reward": reward}
        return TensorDict(of_step, self.batch_size, device=self.device)

    def _set_seed(self, seed):
        self._next_seed = seed
        return seed
