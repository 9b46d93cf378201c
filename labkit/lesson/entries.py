"""The tables of a manifest: entries fetched by name and type, unknown ones refused."""

import tomllib
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.paths import shown

_NAMES = {
    str: "text",
    int: "whole number",
    float: "number",
    list: "list",
    dict: "table",
}


class Entries:
    """One table of a manifest; every error names the file and the entry."""

    def __init__(self, table: dict[str, Any], where: str) -> None:
        """Keep the table.

        Args:
            table: as tomllib reads it.
            where: what to call it in an error.
        """
        self.table, self.where = table, where
        self._asked: set[str] = set()

    def refuse(self, why: str) -> Robo47Error:
        """Return the error that names this table."""
        return Robo47Error(f"{self.where}: {why}")

    def get(self, name: str, kind: type) -> Any:
        """Return an entry that has to be there.

        Raises:
            Robo47Error: it is missing, empty, or of another type.
        """
        self._asked.add(name)
        value = self.table.get(name)
        # bool passes for int, and an integer is a fine float
        right = isinstance(value, (int, float) if kind is float else kind)
        if kind is bool:
            right = isinstance(value, bool)
        elif isinstance(value, bool):
            right = False
        if not right or value in ("", {}):
            expected = "true or false" if kind is bool else f"a {_NAMES[kind]}"
            raise self.refuse(f"{name} is {value!r}; expected {expected}")
        return value

    def maybe(self, name: str, kind: type, default: Any = None) -> Any:
        """Return an entry, or a default where it is left out."""
        self._asked.add(name)
        return self.get(name, kind) if name in self.table else default

    def texts(self, name: str, *, at_least: int = 1) -> tuple[str, ...]:
        """Return a list of texts, line breaks and double spaces folded."""
        values = self.get(name, list) if at_least else self.maybe(name, list, [])
        if len(values) < at_least:
            raise self.refuse(f"{name} has {len(values)} entries; expected {at_least}")
        for value in values:
            if not isinstance(value, str) or not value.strip():
                raise self.refuse(f"{name} holds {value!r}, not a text")
        return tuple(" ".join(value.split()) for value in values)

    def tables(self, name: str, *, at_least: int = 0) -> list["Entries"]:
        """Return a list of tables; a table is called by its `id` or its place."""
        found = self.maybe(name, list, [])
        if len(found) < at_least:
            raise self.refuse(f"{name} is empty")
        for table in found:
            if not isinstance(table, dict):
                raise self.refuse(f"{name} holds {table!r}, not a table")
        return [
            Entries(table, f"{self.where}, {name} {table.get('id', i + 1)}")
            for i, table in enumerate(found)
        ]

    def inner(self, name: str) -> "Entries | None":
        """Return a table, or None where it is left out."""
        table = self.maybe(name, dict)
        return None if table is None else Entries(table, f"{self.where}, {name}")

    def finish(self) -> None:
        """Refuse entries that nobody asked for: a typo would be a rule that is off.

        Raises:
            Robo47Error: there is one; names those that exist.
        """
        if unknown := sorted(set(self.table) - self._asked):
            known = ", ".join(sorted(self._asked))
            raise self.refuse(f"no entry is called {unknown[0]}; there are {known}")


def read(path: Path) -> Entries:
    """Return a manifest's top table.

    Args:
        path: of a TOML file.

    Raises:
        Robo47Error: it cannot be read, or is no TOML.
    """
    try:
        return Entries(tomllib.loads(path.read_text("utf-8")), shown(path))
    except (OSError, ValueError) as error:
        raise Robo47Error(f"{shown(path)} cannot be read: {error}") from None
