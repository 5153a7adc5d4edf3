#!/usr/bin/python3
"""Trains a network for gold-v1 by proximal policy optimization, with PyTorch alone.

    ppo_gold.py [--iterations 50] [--num-envs 64] [--threads 2]

Requires python3-torch. Method: Schulman et al., "Proximal Policy Optimization Algorithms" (2017), with generalised advantages.
The environments begin the next episode in the step after an end, whose action has no effect: that step is left out."""
import argparse

import numpy as np

import robosim

STEPS = 128  # of each environment in each iteration
GAMMA, LAMBDA, CLIP = 0.99, 0.95, 0.2


def scaled(observations):
    """Numbers of similar size: near obstacles are near 1, far ones near 0."""
    sonar, heat, stalled = np.split(observations, [16, 17], axis=-1)
    return np.concatenate([np.exp(-sonar), np.log1p(np.maximum(heat, 0)) / 3, stalled], axis=-1).astype(np.float32)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--iterations", type=int, default=50, help="number of iterations (default 50)")
    parser.add_argument("--num-envs", type=int, default=64, help="number of environments (default 64)")
    parser.add_argument("--threads", type=int, default=2, help="threads of the engine (default 2)")
    arguments = parser.parse_args()
    import torch  # after --help, which needs none

    torch.manual_seed(1)
    env = robosim.make("gold-v1", arguments.num_envs, threads=arguments.threads)
    size = env.single_observation_space.shape[0]
    actor = torch.nn.Sequential(torch.nn.Linear(size, 32), torch.nn.Tanh(), torch.nn.Linear(32, 2))
    critic = torch.nn.Sequential(torch.nn.Linear(size, 32), torch.nn.Tanh(), torch.nn.Linear(32, 1))
    log_std = torch.nn.Parameter(torch.full((2,), -0.5))
    optimizer = torch.optim.Adam([*actor.parameters(), *critic.parameters(), log_std], lr=1e-3)

    def distribution(states):
        return torch.distributions.Normal(actor(states), log_std.exp())

    observations, _ = env.reset(seed=1)
    begins = np.zeros(env.num_envs, bool)  # environments whose next step begins an episode
    for iteration in range(arguments.iterations):
        states, actions, values, rewards, ends, counts = [], [], [], [], [], []
        found = episodes = 0
        for _ in range(STEPS):
            state = torch.from_numpy(scaled(observations))
            with torch.no_grad():
                action = distribution(state).sample()
                values.append(critic(state)[:, 0])
            observations, reward, terminated, truncated, infos = env.step(action.clamp(-1, 1).numpy())
            states.append(state)
            actions.append(action)
            rewards.append(torch.from_numpy(reward.astype(np.float32)))
            counts.append(torch.from_numpy(~begins))
            begins = terminated | truncated
            ends.append(torch.from_numpy(begins.astype(np.float32)))
            episodes += int(begins.sum())
            found += int(terminated.sum())
        with torch.no_grad():
            values.append(critic(torch.from_numpy(scaled(observations)))[:, 0])
        advantage, advantages = torch.zeros(env.num_envs), []
        for t in reversed(range(STEPS)):
            error = rewards[t] + GAMMA * values[t + 1] * (1 - ends[t]) - values[t]
            advantage = error + GAMMA * LAMBDA * (1 - ends[t]) * advantage
            advantages.insert(0, advantage)
        counted = torch.cat(counts)
        states, actions = torch.cat(states)[counted], torch.cat(actions)[counted]
        advantages, values = torch.cat(advantages)[counted], torch.cat(values[:-1])[counted]
        returns = advantages + values
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
        with torch.no_grad():
            before = distribution(states).log_prob(actions).sum(-1)
        for _ in range(4):
            for batch in torch.randperm(len(states)).split(1024):
                ratio = (distribution(states[batch]).log_prob(actions[batch]).sum(-1) - before[batch]).exp()
                gain = torch.min(ratio * advantages[batch], ratio.clamp(1 - CLIP, 1 + CLIP) * advantages[batch]).mean()
                loss = -gain + 0.5 * (critic(states[batch])[:, 0] - returns[batch]).pow(2).mean()
                optimizer.zero_grad()
                loss.backward()
                optimizer.step()
        print(f"iteration {iteration + 1}: reward per step {torch.cat(rewards).mean():.5f}, found {found} in {episodes} episodes",
              flush=True)

    def policy(observations):
        with torch.no_grad():
            return actor(torch.from_numpy(scaled(observations))).clamp(-1, 1).numpy()

    print(robosim.evaluate("gold-v1", policy, worlds=20))


if __name__ == "__main__":
    main()
