"""Base classes of the learning environments: those of Gymnasium and PettingZoo when these are installed, so that their
wrappers, spaces and checks accept the environments; otherwise stand-ins, since neither is required."""
from enum import Enum

try:
    from gymnasium.vector import VectorEnv as VectorEnvBase
except ImportError:
    class VectorEnvBase:
        """Stands for gymnasium.vector.VectorEnv."""

try:
    from gymnasium.vector import AutoresetMode  # since Gymnasium 1.1
except ImportError:
    class AutoresetMode(Enum):
        """When environments whose episode has ended are reset, as in Gymnasium."""

        NEXT_STEP = "NextStep"
        SAME_STEP = "SameStep"
        DISABLED = "Disabled"

try:
    from gymnasium.spaces import Box, Dict
except ImportError:
    from .spaces import Box, Dict

try:
    from pettingzoo import ParallelEnv as ParallelEnvBase
except ImportError:
    class ParallelEnvBase:
        """Stands for pettingzoo.ParallelEnv."""
