"""A small recurrent network as policy of the agents of a task."""
import numpy as np

HIDDEN = 16


class NetworkPolicy:
    """Network of one layer of 16 units that also receives their last values; the agents of a team share its weights.

    weights: float32, shape (networks, size): several networks act on equal parts of the environments, in their order.
    """

    name = "trained"

    def __init__(self, task, weights):
        self.task = task
        weights = np.atleast_2d(weights)
        inputs = (weights.shape[1] - HIDDEN * 2) // HIDDEN - HIDDEN
        first = (inputs + HIDDEN) * HIDDEN
        self._into_hidden = weights[:, :first].reshape(-1, inputs + HIDDEN, HIDDEN)
        self._into_action = weights[:, first:].reshape(-1, HIDDEN, 2)
        self._hidden = None

    @staticmethod
    def size(inputs):
        """Number of weights."""
        return (inputs + HIDDEN) * HIDDEN + HIDDEN * 2

    @classmethod
    def load(cls, task, file):
        """A policy of `python -m robosim.tasks.train`."""
        try:
            with np.load(file) as stored:
                return cls(task, stored["weights"])
        except FileNotFoundError:
            raise ValueError(f"there is no trained baseline of {task.name}; train one: "
                             f"python -m robosim.tasks.train {task.name}") from None

    def reset(self, num_envs):
        self._hidden = np.zeros((num_envs * self.task.agents, HIDDEN), np.float32)

    def forget(self, which):
        """Episodes have begun in these environments: their memory is empty."""
        self._hidden.reshape(len(which), self.task.agents, HIDDEN)[which] = 0

    def __call__(self, observations):
        """Actions of all environments."""
        features = self.task.features(observations.reshape(len(observations), self.task.agents, -1)).astype(np.float32)
        networks = len(self._into_hidden)
        inputs = np.concatenate([features.reshape(len(self._hidden), -1), self._hidden], axis=-1)
        hidden = np.tanh(inputs.reshape(networks, -1, inputs.shape[-1]) @ self._into_hidden)
        actions = np.tanh(hidden @ self._into_action)
        self._hidden = hidden.reshape(-1, HIDDEN)
        return actions.reshape((len(observations), self.task.agents, 2) if self.task.agents > 1 else (len(observations), 2))
