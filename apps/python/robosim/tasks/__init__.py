"""Ready tasks for learning and comparison, with fixed worlds, observations, rewards and seeds (doc/tasks.md).

    env = robosim.make("gold-v1", num_envs=64)
    print(robosim.evaluate("gold-v1", robosim.tasks.baseline("gold-v1", "handwritten")))

A version never changes: what would change results gets the next one.
"""
from .coverage import Coverage
from .evaluation import Evaluation, evaluate
from .foraging import Foraging
from .formation import Formation
from .gold import Gold
from .network import NetworkPolicy
from .parallel import TaskParallelEnv
from .pursuit import Pursuit
from .registry import baseline, make, names, register, task_class
from .soccer import Soccer
from .task import Task, TaskEnv

for _task in (Gold, Coverage, Foraging, Pursuit, Formation, Soccer):
    register(_task)

__all__ = ["Evaluation", "NetworkPolicy", "Task", "TaskEnv", "TaskParallelEnv", "baseline", "evaluate", "make", "names",
           "task_class"]
