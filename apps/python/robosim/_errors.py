"""Exceptions of RoboSim. Misuse of a function raises ValueError, TypeError or RuntimeError."""


class Error(Exception):
    """Base of RoboSim's exceptions."""


class ConfigError(Error, ValueError):
    """An invalid file or argument: what is wrong, where, and how to fix it.

    The text has one error per line; errors in files begin with file:line.
    """

    @property
    def errors(self):
        """The errors, as a list of str."""
        return str(self).split("\n")


class ControllerError(Error, RuntimeError):
    """A controller raised an exception. The text names it and its robot; a controller in Python gives the __cause__."""


class RemoteError(Error, ConnectionError):
    """A server refuses a connection or a message, or a connection is lost."""

    def __init__(self, text, status):
        super().__init__(text)
        self._status = status

    @property
    def status(self):
        """Name of gRPC's status, such as "NOT_FOUND" (doc/protocol.md, "Errors")."""
        return self._status


class RecordingError(Error, OSError):
    """A recording cannot be written, or does not fit a request."""
