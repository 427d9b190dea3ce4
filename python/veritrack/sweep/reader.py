"""Messages about a specification that name its lines."""

from __future__ import annotations

import re
from typing import Any, Mapping, NoReturn

from ..errors import InputError


class Reader:
    """Values of a specification, and messages that name its lines."""

    def __init__(self, text: str, file: str) -> None:
        self.text = text
        self.file = file

    def fail(self, message: str, key: str = "", table: str = "", number: int = 0) -> NoReturn:
        """Throws InputError at a key of a table, the `number`-th of that name."""
        raise InputError(self.file, *self._place(key, table, number), message)

    def _place(self, key: str, table: str, number: int) -> tuple[int, int]:
        current, times, heading = "", -1, (0, 0)
        for line_number, line in enumerate(self.text.splitlines(), 1):
            header = re.match(r"\s*\[+\s*([^\]]+?)\s*\]+", line)
            if header:
                current = header[1]
                times += current == table
                if current == table and times == number:
                    heading = (line_number, line.index("[") + 1)
            elif current == table and (not table or times == number):
                found = re.match(rf"\s*\"?({re.escape(key)})\"?\s*=", line)
                if key and found:
                    return line_number, found.start(1) + 1
        return heading

    def known(self, table: Any, names: set[str], where: str = "", number: int = 0) -> None:
        """Throws InputError unless it is a table without other keys."""
        if not isinstance(table, Mapping):
            self.fail(f"{where} is no table; allowed: a table with {', '.join(sorted(names))}", where)
        for key in table:
            if key not in names:
                self.fail(f"unknown key {key}; allowed: {', '.join(sorted(names))}", key, where, number)
