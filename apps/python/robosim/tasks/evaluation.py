"""The evaluation of a policy on the held-out worlds of a task."""
import numpy as np

from .._arguments import refuse, require_whole
from .task import HELD_OUT_WORLDS

EVALUATION_SEED = 100_001  # environment i has the seed EVALUATION_SEED + i, and the i-th held-out world


class Evaluation:
    """Results of one episode in each of the held-out worlds.

    metrics: mean and its 95 % confidence interval by name: of a share Wilson's, otherwise ±1.96 standard errors.
    episodes: the values of each metric: float64, shape (worlds,).
    """

    def __init__(self, task, policy, episodes, kinds):
        self.task = task
        self.policy = policy
        self.episodes = episodes
        self.metrics = {name: (_share if kinds.get(name) == "share" else _mean)(values) for name, values in episodes.items()}

    def table(self):
        """The metrics as a table in Markdown."""
        count = len(next(iter(self.episodes.values())))
        lines = [f"| {self.task}, {count} held-out worlds | {self.policy} | 95 % confidence |", "|---|---|---|"]
        lines += [f"| {name} | {mean:.3f} | {low:.3f} to {high:.3f} |" for name, (mean, low, high) in self.metrics.items()]
        return "\n".join(lines)

    __str__ = table

    def __repr__(self):
        name, (mean, low, high) = next(iter(self.metrics.items()))
        return f"<Evaluation of {self.policy} on {self.task}: {name} {mean:.3f} ({low:.3f} to {high:.3f})>"


def _mean(values):
    error = 1.96 * values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.inf
    return float(values.mean()), float(values.mean() - error), float(values.mean() + error)


def _share(values):
    """Wilson, "Probable Inference, the Law of Succession, and Statistical Inference" (1927)."""
    n, p, z = len(values), float(values.mean()), 1.96
    centre = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * np.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return p, max(0.0, float(centre - half)), min(1.0, float(centre + half))


def evaluate(task, policy, *, worlds=100, threads=1):
    """Runs a policy for one episode in each of the first `worlds` held-out worlds of a task; returns an Evaluation.

    task: name, such as "gold-v1". policy: function of the observations of all environments (num_envs, …) that returns
        their actions; or the name of a baseline, "handwritten" or "trained". A policy with memory also has a method
        reset(num_envs), which is called before the first step.
    The seeds are fixed, so that a policy without random numbers of its own always has the same result.
    """
    from .registry import baseline, make, task_class
    of = task_class(task)
    require_whole("worlds", worlds, 1, len(HELD_OUT_WORLDS), len(HELD_OUT_WORLDS))
    label = policy if isinstance(policy, str) else getattr(policy, "name", type(policy).__name__)
    if isinstance(policy, str):
        policy = baseline(task, policy)
    if not callable(policy):
        refuse("policy", policy, "a function from observations to actions", '"handwritten"')
    results = {name: np.full(worlds, np.nan) for name in ("return", *of.metrics)}
    with make(task, worlds, split="test", threads=threads) as env:
        observations, _ = env.reset(seed=EVALUATION_SEED)
        if hasattr(policy, "reset"):
            policy.reset(worlds)
        returns, is_open = np.zeros(worlds), np.ones(worlds, bool)
        while is_open.any():
            observations, rewards, terminated, truncated, infos = env.step(policy(observations))
            returns += np.where(is_open, rewards if rewards.ndim == 1 else rewards.mean(axis=1), 0)
            ended = (terminated | truncated) & is_open
            if ended.any():
                results["return"][ended] = returns[ended]
                for name in of.metrics:
                    results[name][ended] = infos[name][ended]
                is_open &= ~ended
    ordered = {name: results[name] for name in (*of.metrics, "return")}
    return Evaluation(task, label, ordered, of.metrics)
