"""Errors that have no class in Python."""

from typing import Optional


class InputError(ValueError):
    """A file that is not what its format says. The message is one line, `FILE:LINE:COLUMN: what is wrong; what to do`.

    `line` and `column` count from 1 and are None where the error is in binary data; `byte` counts from 0 and is None
    where it is in text; all are None where no place is to blame.
    """

    __module__ = "sightline"

    file: str
    line: Optional[int]
    column: Optional[int]
    byte: Optional[int]

    def __init__(
        self,
        message: str,
        file: str = "",
        line: Optional[int] = None,
        column: Optional[int] = None,
        byte: Optional[int] = None,
    ) -> None:
        super().__init__(message)
        self.file, self.line, self.column, self.byte = file, line, column, byte


class OutOfBudget(TimeoutError):
    """The seconds of `budget` ran out before there was an answer: undecided."""

    __module__ = "sightline"
