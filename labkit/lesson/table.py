"""A dataclass filled from a TOML table: what is missing, empty or misspelt is named."""

import dataclasses
import tomllib
import typing
from functools import lru_cache
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.paths import shown

_EXPECTED = {
    str: "a text",
    int: "a whole number",
    float: "a number",
    bool: "true or false",
    list: "a list",
    dict: "a table",
}


def entry(default: Any = dataclasses.MISSING, **how: Any) -> Any:
    """Return a field that is more than an entry of its name.

    Args:
        default: where the entry is left out; without one it has to be there.
        how: at="figure.path", an entry of an inner table; needed=True, it has to be
            there if its table is; least=2, how many a list holds.
    """
    return dataclasses.field(default=default, metadata=how)


def load(kind: Any, manifest: Path, **given: Any) -> Any:
    """Return a dataclass of a TOML file's entries, read again once it changes."""
    stat = manifest.stat() if manifest.is_file() else None
    return _load(kind, manifest, stat and (stat.st_mtime_ns, stat.st_size), **given)


@lru_cache(128)  # one command asks for the same manifests many times
def _load(kind: Any, manifest: Path, _state: Any, **given: Any) -> Any:
    try:
        return fill(kind, tomllib.loads(manifest.read_text("utf-8")), **given)
    except (OSError, ValueError) as error:
        raise Robo47Error(f"{shown(manifest)} cannot be read: {error}") from None
    except Robo47Error as error:
        raise Robo47Error(f"{shown(manifest)}{error}") from None


def fill(kind: Any, table: dict[str, Any], where: str = "", **given: Any) -> Any:
    """Return a dataclass with the entries of a table.

    Args:
        kind: its fields are texts, numbers, bools, tuples of texts or whole numbers,
            and tuples of dataclasses, whose tables are called by their `id` or place.
        table: as tomllib reads it.
        where: what to call it in an error, behind the file's name.
        given: fields that are no entries.

    Raises:
        Robo47Error: an entry is missing, empty, of a wrong type or unknown: a typo
            would be a rule that is off.
    """
    wanted = {f.metadata.get("at", f.name): f for f in dataclasses.fields(kind)}
    wanted = {name: f for name, f in wanted.items() if f.name not in given}
    known: dict[str, list[str]] = {"": []}
    for name in wanted:
        known.setdefault(name.rpartition(".")[0], []).append(name.rpartition(".")[2])
    known[""] += filter(None, known)
    tables = {"": (table, where)}
    for name in set(known) & set(table):
        tables[name] = _right(table[name], name, dict, where), f"{where}, {name}"
    for path, field in wanted.items():
        inner, _, name = path.rpartition(".")
        entries, place = tables.get(inner, ({}, where))
        optional = field.default is not dataclasses.MISSING
        if field.metadata.get("needed") and inner in tables:
            optional = False
        if name in entries or not optional:
            least = field.metadata.get("least", 0 if optional else 1)
            given[field.name] = _read(entries.get(name), name, field.type, least, place)
    for inner, (entries, place) in tables.items():
        if unknown := sorted(set(entries) - set(known[inner])):
            there = ", ".join(sorted(known[inner]))
            why = f"no entry is called {unknown[0]}; there are {there}"
            raise Robo47Error(f"{place}: {why}")
    return kind(**given)


def _read(value: Any, name: str, kind: Any, least: int, where: str) -> Any:
    """Return an entry as its field holds it; None is one that is not there."""
    parts = typing.get_args(kind)
    if typing.get_origin(kind) is not tuple:
        value = _right(value, name, parts[0] if parts else kind, where)
        return float(value) if float in (kind, *parts) else value
    tables = dataclasses.is_dataclass(parts[0])
    right: Any = dict if tables else parts[0]
    found = _right([] if tables and value is None else value, name, list, where)
    if len(found) < least:
        size = "is empty" if tables else f"has {len(found)} entries; expected {least}"
        raise Robo47Error(f"{where}: {name} {size}")
    for one in found:
        blank = isinstance(one, str) and not one.strip()
        if not isinstance(one, right) or isinstance(one, bool) or blank:
            what = _EXPECTED[right].partition(" ")[2]
            raise Robo47Error(f"{where}: {name} holds {one!r}, not a {what}")
    if not tables:
        return tuple(" ".join(o.split()) if isinstance(o, str) else o for o in found)
    names = (f"{where}, {name} {t.get('id', i)}" for i, t in enumerate(found, 1))
    return tuple(fill(parts[0], *pair) for pair in zip(found, names, strict=True))


def _right(value: Any, name: str, kind: type, where: str) -> Any:
    """Return a value of the right type that is not empty."""
    # bool passes for int, and an integer is a fine float
    right = isinstance(value, (int, float) if kind is float else kind)
    if not right or isinstance(value, bool) != (kind is bool) or value in ("", {}):
        raise Robo47Error(f"{where}: {name} is {value!r}; expected {_EXPECTED[kind]}")
    return value
