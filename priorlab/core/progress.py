"""How long work says how far it is, everywhere in the same way."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[int, int], None]
"""Called with the steps done and the steps to do. What it raises ends the work (an interrupt does the same): long work returns
a new record at its end and changes nothing before, so nothing half-made is left behind."""
