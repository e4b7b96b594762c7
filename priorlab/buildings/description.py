"""TOML text -> `Description`; every mistake gets a sentence that says which part it is in."""

from __future__ import annotations

import dataclasses
import math
import tomllib
import types
import typing
from pathlib import Path
from typing import Any

from priorlab.buildings import parts
from priorlab.buildings.parts import Description, WallStyle
from priorlab.core.shipped import nearest_name


def read_description(path: str | Path) -> Description:
    """Read a building's description from a TOML file.

    Raises
    ------
    ValueError
        One sentence with the file, the part, the rule and the value.
    FileNotFoundError
        When there is no such file.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"a building's description must be a TOML file, got {path}, which does not exist")
    try:
        return parse_description(path.read_text(encoding="utf-8"), name=path.stem)
    except (ValueError, TypeError) as error:
        raise ValueError(f"{path.name}: {error}") from error


def parse_description(text: str, name: str = "building") -> Description:
    """A description from TOML text; `name` is taken when the text gives none.

    >>> parse_description('''
    ... metres_per_pixel = 0.05
    ... walls = [{ style = "outer", outline = [[0, 0], [4, 0], [4, 3], [0, 3]] }]
    ... ''', name="hut").walls[0].outline[2]
    (4.0, 3.0)
    """
    table = {"name": name, **tomllib.loads(text)}
    if "styles" in table:
        styles = table.pop("styles")
        table["styles"] = {key: record_of(WallStyle, value, f"styles.{key}") for key, value in styles.items()}
    description = typing.cast(Description, record_of(Description, table, "the building"))
    for key, style in description.styles.items():
        if style.look != "single" and style.thickness < description.metres_per_pixel:
            raise ValueError(
                f"styles.{key}: thickness must be at least a pixel, {description.metres_per_pixel:g} m, got {style.thickness:g}"
            )
    for number, wall in enumerate(description.walls, start=1):
        _check_wall(wall, description.styles, f"walls {number}")
    for number, chosen in enumerate(description.rooms, start=1):
        if description.rooms[number:] and chosen.name in {room.name for room in description.rooms[number:]}:
            raise ValueError(f"rooms {number}: name must be different for every room, got {chosen.name!r} twice")
    if description.start is not None:
        nearest_name("start", description.start, [room.name for room in description.rooms])
    return description


def _check_wall(wall: parts.Wall, styles: dict[str, WallStyle], where: str) -> None:
    """Say what is wrong with a wall's style or points."""
    if wall.style not in styles:
        raise ValueError(f"{where}: style must be one of {', '.join(styles)}, got {wall.style!r}")
    if bool(wall.path) == bool(wall.outline):
        raise ValueError(f"{where}: exactly one of path and outline must be given, got {'both' if wall.path else 'none'}")
    points = wall.outline or wall.path
    if len(points) < (3 if wall.outline else 2):
        raise ValueError(f"{where}: path needs at least 2 points and outline 3, got {len(points)}")
    closed = points + points[:1] if wall.outline else points
    for start, end in zip(closed, closed[1:], strict=False):
        if math.dist(start, end) < 1e-6:
            raise ValueError(f"{where}: a wall must have a length, got {list(start)} twice in a row")


def record_of(kind: type, table: Any, where: str) -> Any:
    """A record of `kind` from a TOML table whose keys are its fields."""
    if not isinstance(table, dict):
        raise ValueError(f"{where} must be a table {{ key = value }}, got {table!r}")
    types_of = typing.get_type_hints(kind)
    fields = {field.name: field for field in dataclasses.fields(kind)}
    for key in table:
        try:
            nearest_name("key", key, list(fields))
        except ValueError as error:
            raise ValueError(f"{where}: {error}") from None
    for name, field in fields.items():
        required = field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
        if required and name not in table:
            raise ValueError(f"{where}: {name} must be given, got only {', '.join(table) or 'nothing'}")
    values = {key: _value(types_of[key], value, f"{where}: {key}", key) for key, value in table.items()}
    try:
        return kind(**values)
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from None


def _value(kind: Any, value: Any, where: str, key: str) -> Any:
    """A TOML value as the type that the record's field has, or a sentence."""
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if origin is types.UnionType or origin is typing.Union:
        return _value(next(argument for argument in arguments if argument is not type(None)), value, where, key)
    if origin is typing.Literal:
        if value not in arguments:
            raise ValueError(f"{where} must be one of {', '.join(map(str, arguments))}, got {value!r}")
        return value
    if origin is tuple:
        if not isinstance(value, list):
            raise ValueError(f"{where} must be a list, got {value!r}")
        if arguments[-1] is not Ellipsis and len(value) != len(arguments):
            raise ValueError(f"{where} must be a list of {len(arguments)}, got {value!r}")
        kinds = [arguments[0]] * len(value)
        plain = typing.get_origin(arguments[0]) is tuple or not dataclasses.is_dataclass(arguments[0])
        return tuple(
            _value(one, item, where if plain else f"{key} {number}", key)
            for number, (one, item) in enumerate(zip(kinds, value, strict=True), start=1)
        )
    if dataclasses.is_dataclass(kind):
        return value if isinstance(value, typing.cast(type, kind)) else record_of(typing.cast(type, kind), value, where)
    if origin is dict:
        return value
    if kind is float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            raise ValueError(f"{where} must be a number, got {value!r}")
        return float(value)
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        names = {str: "text in quotes", int: "a whole number", bool: "true or false"}
        raise ValueError(f"{where} must be {names[kind]}, got {value!r}")
    return value
