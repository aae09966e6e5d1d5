"""What goes wrong, as exceptions: the messages are those of the command line."""
from typing import NamedTuple, Optional, Tuple


class Problem(NamedTuple):
    """One finding in an input: in a file its line and column, in a dict the path of its key ("hose.length")."""
    file: str
    line: Optional[int]
    column: Optional[int]
    path: Optional[str]
    message: str  # the key, its value, and the rule that it breaks
    severity: str  # "error" or "warning"
    source_line: str


class Error(Exception):
    """Of all that this package raises by itself."""


class InputError(Error, ValueError):
    """An input that can be read but not used; `problems` has all that is wrong with it."""

    def __init__(self, text: str, problems: Tuple[Problem, ...] = ()):
        super().__init__(text)
        self.problems = problems


class MissingInput(Error, FileNotFoundError):
    """A file, or a rig of that name, that is not there."""

    def __init__(self, text: str, problems: Tuple[Problem, ...] = ()):
        super().__init__(text)
        self.problems = problems


class UnfitData(InputError):
    """Measured data that mean nothing as they are called; `problems` says of which quantity."""


class NumericalFailure(Error, ArithmeticError):
    """The equations could not be carried on: when, where, by which solver and likely why."""


class InputWarning(UserWarning):
    """What is odd in an input or a result, but can be used."""
