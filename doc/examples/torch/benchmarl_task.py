#!/usr/bin/env python3
"""Trains a team for a task of RoboSim by an algorithm of BenchMARL.

    benchmarl_task.py [TASK]"""
import sys

from benchmarl.algorithms import MappoConfig
from benchmarl.environments.common import TaskClass
from benchmarl.experiment import Experiment, ExperimentConfig
from benchmarl.models.mlp import MlpConfig
from torchrl_env import RoboSimEnv


class RoboSimTask(TaskClass):
    """name: such as "pursuit-v1"; config: further arguments of RoboSimEnv."""

    def get_env_fun(self, num_envs, continuous_actions, seed, device):
        return lambda: RoboSimEnv(self.name, num_envs, seed=seed or 1, device=device, **self.config)

    def supports_continuous_actions(self):
        return True

    def supports_discrete_actions(self):
        return False

    def max_steps(self, env):
        return env.task_env.task.max_steps

    def has_render(self, env):
        return False

    def group_map(self, env):
        return {"agents": list(env.task_env.agent_names)}

    def observation_spec(self, env):
        return env.observation_spec.clone()

    def info_spec(self, env):
        return None

    def state_spec(self, env):
        return None

    def action_spec(self, env):
        return env.full_action_spec

    def action_mask_spec(self, env):
        return None

    @staticmethod
    def env_name():
        return "robosim"


def main():
    task = RoboSimTask(sys.argv[1] if len(sys.argv) > 1 else "pursuit-v1", {"threads": 2})
    config = ExperimentConfig.get_from_yaml()
    config.prefer_continuous_actions = True
    config.render = False
    Experiment(task=task, algorithm_config=MappoConfig.get_from_yaml(), model_config=MlpConfig.get_from_yaml(),
               critic_model_config=MlpConfig.get_from_yaml(), seed=0, config=config).run()


if __name__ == "__main__":
    main()
