"""Trains the baseline of a task: by imitation of the hand-written one, then by an evolution strategy.

    python -m robosim.tasks.train gold-v1 --minutes 15 --threads 2 --out gold-v1.npz

The network first learns the actions of the hand-written baseline, which drives with random disturbances in training worlds.
The method afterwards is that of doc/examples/learn_gold.py (Salimans et al., "Evolution Strategies as a Scalable Alternative to
Reinforcement Learning", 2017): in each generation, pairs of opposite random changes of the weights are tried in the same
training worlds, and the weights move towards those of a higher return. Requires NumPy only.
"""
import argparse
import time

import numpy as np

from .evaluation import evaluate
from .network import HIDDEN, NetworkPolicy
from .registry import names, task_class
from .task import TRAINING_WORLDS, TaskEnv

SIGMA = 0.05
RATE = 0.1

# By task: pairs of candidates, training worlds of each generation, and steps of each candidate in each of them.
_SIZES = {"gold-v1": (16, 16, 400), "coverage-v1": (12, 8, 400), "pursuit-v1": (12, 8, 300), "formation-v1": (12, 8, 400),
          "foraging-v1": (8, 4, 400), "soccer-v1": (8, 4, 300)}


def imitate(name, rng, num_envs=32, steps=400, rounds=3000):
    """Weights of a network that acts nearly as the hand-written baseline, without memory."""
    task = task_class(name)
    expert = task.handwritten()
    env = TaskEnv(task(), num_envs, TRAINING_WORLDS)
    observations, _ = env.reset(seed=0)
    if hasattr(expert, "reset"):
        expert.reset(num_envs)
    inputs, actions = [], []
    noise = np.zeros(env.action_space.shape)
    for _ in range(steps):
        action = np.clip(expert(observations), -1, 1)
        inputs.append(task.features(observations.reshape(num_envs, task.agents, -1)).astype(np.float32))
        actions.append(action.reshape(num_envs, task.agents, 2))
        noise = 0.9 * noise + 0.1 * rng.normal(0, 1, noise.shape)
        observations = env.step(np.clip(action + noise, -1, 1))[0]
    env.close()
    inputs, actions = (np.concatenate(of).reshape(-1, of[0].shape[-1]) for of in (inputs, actions))
    weights = [rng.normal(0, 1 / np.sqrt(inputs.shape[1]), (inputs.shape[1], HIDDEN)), rng.normal(0, 0.1, (HIDDEN, 2))]
    first, second = [np.zeros_like(w) for w in weights], [np.zeros_like(w) for w in weights]
    for t in range(1, rounds + 1):  # Adam, of the squared error
        batch = rng.integers(len(inputs), size=1024)
        hidden = np.tanh(inputs[batch] @ weights[0])
        given = np.tanh(hidden @ weights[1])
        slope = (given - actions[batch]) * (1 - given**2) / len(batch)
        gradients = [inputs[batch].T @ (slope @ weights[1].T * (1 - hidden**2)), hidden.T @ slope]
        for w, m, v, gradient in zip(weights, first, second, gradients):
            m += 0.1 * (gradient - m)
            v += 0.001 * (gradient**2 - v)
            w -= 0.01 * (m / (1 - 0.9**t)) / (np.sqrt(v / (1 - 0.999**t)) + 1e-8)
    recurrent = np.zeros((HIDDEN, HIDDEN))
    return np.concatenate([np.concatenate([weights[0], recurrent]).ravel(), weights[1].ravel()]).astype(np.float32)


def _returns(env, weights, starts, steps):
    """Mean return of each network over its part of the environments, of at most one episode of at most so many steps.

    starts: seeds of the environments of each network.
    """
    policy = NetworkPolicy(type(env.task), weights)
    policy.reset(env.num_envs)
    observations, _ = env.reset(seed=[int(of) for of in np.tile(starts, len(weights))])
    returns, is_open = np.zeros(env.num_envs), np.ones(env.num_envs, bool)
    for _ in range(steps):
        observations, rewards, terminated, truncated, _ = env.step(policy(observations))
        returns += np.where(is_open, rewards if rewards.ndim == 1 else rewards.mean(axis=1), 0)
        is_open &= ~(terminated | truncated)
        if not is_open.any():
            break
    return returns.reshape(len(weights), -1).mean(axis=1)


def train(name, minutes, threads=1, seed=1, log=print):
    """The weights after so many minutes, and a dict of what it took."""
    task = task_class(name)
    pairs, worlds, steps = _SIZES[name]
    candidates = 2 * pairs
    rng = np.random.default_rng(seed)
    env = TaskEnv(task(), candidates * worlds, list(TRAINING_WORLDS)[:worlds], threads)
    begin, processor = time.monotonic(), time.process_time()
    start = imitate(name, rng)
    mean, momentum = start.copy(), np.zeros_like(start)
    generation = 0
    while time.monotonic() - begin < 60 * minutes:
        half = rng.normal(0, 1, (pairs, mean.size)).astype(np.float32)
        changes = np.concatenate([half, -half])
        starts = rng.integers(2**31, size=worlds)  # the same for all candidates
        fitness = _returns(env, mean + SIGMA * changes, starts, steps)
        ranks = fitness.argsort().argsort() / (candidates - 1) - 0.5  # robust against outliers
        momentum = 0.9 * momentum + 0.1 * (ranks @ changes) / (candidates * SIGMA)
        mean += RATE * momentum
        generation += 1
        if generation % 10 == 0:
            log(f"generation {generation}, {time.monotonic() - begin:.0f} s: mean return {fitness.mean():.3f}", flush=True)
    env.close()
    # The better one in whole episodes of all training worlds.
    both = TaskEnv(task(), 2 * len(TRAINING_WORLDS), TRAINING_WORLDS, threads)
    imitated, trained = _returns(both, np.stack([start, mean]), np.arange(len(TRAINING_WORLDS)), task.max_steps)
    both.close()
    log(f"return in the training worlds: imitated {imitated:.3f}, trained {trained:.3f}")
    taken = {"generations": generation, "agent_steps": generation * steps * candidates * worlds * task.agents,
             "real_s": time.monotonic() - begin, "processor_s": time.process_time() - processor,
             "is_imitated_only": bool(imitated >= trained)}
    return (start if imitated >= trained else mean), taken


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python -m robosim.tasks.train", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("task", choices=names())
    parser.add_argument("--minutes", type=float, default=15, help="time for training (default 15)")
    parser.add_argument("--threads", type=int, default=1, help="threads of the engine (default 1)")
    parser.add_argument("--out", help="file for the weights (default TASK.npz)")
    parser.add_argument("--worlds", type=int, default=100, help="held-out worlds of the evaluation afterwards (default 100)")
    options = parser.parse_args(arguments)
    weights, taken = train(options.task, options.minutes, options.threads)
    np.savez(options.out or options.task + ".npz", weights=weights)
    print(", ".join(f"{name} {value:.0f}" for name, value in taken.items()))
    print(evaluate(options.task, NetworkPolicy(task_class(options.task), weights), worlds=options.worlds))


if __name__ == "__main__":
    main()
