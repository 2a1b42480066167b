"""What holds a file open until it is closed."""

from abc import ABC, abstractmethod
from typing import Self


class Closable(ABC):
    """A context manager that is closed at its end."""

    @abstractmethod
    def close(self) -> None:
        """Close what is open."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
