"""RoboSim: a simulator of cooperating mobile robots.

The engine and NumPy are loaded when they are first used, so that `import robosim` takes little time.
"""
import importlib

from ._errors import ConfigError, ControllerError, Error, RecordingError, RemoteError

_MODULE_OF = {
    "World": "_robosim",
    "WorldBuilder": "world_builder",
    "WorldGenerator": "_robosim",
    "Simulation": "_robosim",
    "Robot": "_robosim",
    "VectorEnv": "vector_env",
    "AutoresetMode": "_farama",
    "ParallelEnv": "parallel_env",
    "Box": "_farama",
    "Dict": "_farama",
    "check_env": "conformance",
    "make": "tasks",
    "evaluate": "tasks",
    "RemoteRobots": "remote",
    "read_rawlog": "recording",
    "Recording": "recording",
    "Controller": "controller",
    "Message": "controller",
    "RobotInfo": "_robosim",
    "SensorInfo": "_robosim",
    "WorldObject": "_robosim",
    "load_plugin": "_robosim",
    "__version__": "_robosim",
}

__all__ = ["ConfigError", "ControllerError", "Error", "RecordingError", "RemoteError",
           *(name for name in _MODULE_OF if not name.startswith("__"))]


def __getattr__(name):
    if name == "tasks":
        return importlib.import_module(".tasks", __name__)
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'robosim' has no attribute '{name}'")
    value = getattr(importlib.import_module("." + _MODULE_OF[name], __name__), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted({*globals(), *_MODULE_OF})
