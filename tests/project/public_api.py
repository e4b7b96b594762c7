"""Prints the public names with their signatures; `make api` keeps the result in public_api.txt."""

import dataclasses
import inspect

import priorlab


def describe(name: str) -> str:
    """One line: the name and what a caller must know of it."""
    thing = getattr(priorlab, name)
    if inspect.ismodule(thing):
        return f"{name}: module"
    if inspect.isclass(thing):
        public = sorted(member for member in vars(thing) if not member.startswith("_"))
        fields = [field.name for field in dataclasses.fields(thing) if field.init] if dataclasses.is_dataclass(thing) else []
        return f"{name}({', '.join(fields)}): {', '.join(m for m in public if m not in fields)}"
    if callable(thing):
        parameters = inspect.signature(thing).parameters.values()
        return f"{name}({', '.join(parameter(p) for p in parameters)})"
    return f"{name}: {type(thing).__name__}"


def parameter(p: inspect.Parameter) -> str:
    """A parameter with its default; a preset goes by its name."""
    if not dataclasses.is_dataclass(p.default) or inspect.isclass(p.default):
        return str(p.replace(annotation=p.empty))
    presets = [name for name in priorlab.__all__ if name.isupper() and getattr(priorlab, name) == p.default]
    return f"{p.name}={presets[0] if presets else type(p.default).__name__ + '(...)'}"


def public_api() -> str:
    """All public names, one a line."""
    return "\n".join(describe(name) for name in sorted(priorlab.__all__))


if __name__ == "__main__":
    print(public_api())
