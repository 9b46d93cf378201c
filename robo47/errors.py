"""The exceptions that a person is meant to read."""


class Robo47Error(Exception):
    """An error for a person: what is wrong, what was expected and what to do next."""


class FaultError(Robo47Error):
    """A failure of this machine, not of the student; another run may succeed."""
