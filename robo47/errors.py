"""The exceptions that a person is meant to read."""


class Robo47Error(Exception):
    """What is wrong, what was expected and what to do next, in plain words."""


class FaultError(Robo47Error):
    """This machine failed, not the student; another run may fare better."""
