"""Who draws which piece of furniture in which hand: four families of symbols, as four offices have them."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

from priorlab.buildings import symbols_angular, symbols_atelier, symbols_fixtures, symbols_furniture, symbols_soft
from priorlab.buildings.parts import FURNITURE_SIZES
from priorlab.buildings.pen import Pen

Symbol = Callable[[Pen], None]


def _family(*modules: ModuleType) -> dict[str, Symbol]:
    """The `draw_KIND` functions of a hand; an armchair is a short sofa."""
    names = {kind: "draw_sofa" if kind == "armchair" else f"draw_{kind}" for kind in FURNITURE_SIZES}
    found = {kind: [getattr(module, name) for module in modules if hasattr(module, name)] for kind, name in names.items()}
    return {kind: functions[0] for kind, functions in found.items()}


FAMILIES: dict[str, dict[str, Symbol]] = {
    "plain": _family(symbols_furniture, symbols_fixtures),
    "soft": _family(symbols_soft),
    "angular": _family(symbols_angular),
    "atelier": _family(symbols_atelier),
}
"""Every family draws every kind."""
