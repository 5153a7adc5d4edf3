"""The tasks by name."""
import os

from .._arguments import SEED_MAX, refuse, require_whole
from .network import NetworkPolicy
from .parallel import TaskParallelEnv
from .task import HELD_OUT_WORLDS, TRAINING_WORLDS, TaskEnv

_TASKS = {}


def register(task):
    _TASKS[task.name] = task


def names():
    """Names of all tasks."""
    return tuple(_TASKS)


def task_class(name):
    """The class of a task: its constants, worlds and rewards."""
    if not isinstance(name, str):
        refuse("the name of a task", name, f"one of {', '.join(_TASKS)}", '"gold-v1"')
    if name not in _TASKS:
        raise ValueError(f"there is no task {name!r}; the tasks are {', '.join(_TASKS)}")
    return _TASKS[name]


def make(name, num_envs=1, *, split="train", threads=1, seed=1, interface="vector"):
    """An environment of a task: robosim.tasks.TaskEnv, with the interface of Gymnasium's VectorEnv.

    name: "gold-v1", "coverage-v1", "foraging-v1", "pursuit-v1", "formation-v1" or "soccer-v1" (doc/tasks.md).
    split: "train": environment i is in world i modulo 32 of the training worlds; "test": in one of the 100 held-out worlds.
    seed: of noise, as for VectorEnv. threads: they do not affect the results.
    interface: "parallel": TaskParallelEnv, one environment with the interface of PettingZoo's ParallelEnv.
    """
    task = task_class(name)
    require_whole("num_envs", num_envs, 1, 2**31 - 1, 8)
    require_whole("threads", threads, 1, 1024, 2)
    require_whole("the seed", seed, 0, SEED_MAX)
    if split not in ("train", "test"):
        raise ValueError(f"split is {split!r}; it must be 'train' or 'test'")
    if interface not in ("vector", "parallel"):
        raise ValueError(f"interface is {interface!r}; it must be 'vector' or 'parallel'")
    if interface == "parallel" and num_envs != 1:
        raise ValueError(f"num_envs is {num_envs}; a parallel environment has 1")
    env = TaskEnv(task(), num_envs, TRAINING_WORLDS if split == "train" else HELD_OUT_WORLDS, threads, seed)
    return TaskParallelEnv(env) if interface == "parallel" else env


def baseline(name, kind="handwritten"):
    """A policy to compare with: "handwritten", or "trained" by `python -m robosim.tasks.train` (doc/tasks.md)."""
    task = task_class(name)
    if kind == "handwritten":
        return task.handwritten()
    if kind != "trained":
        raise ValueError(f"kind is {kind!r}; it must be 'handwritten' or 'trained'")
    return NetworkPolicy.load(task, os.path.join(os.path.dirname(__file__), "weights", name + ".npz"))
