"""The way of one cell's log odds, reading by reading, as a small line drawing (SVG: sharp text, 1 ms, no Matplotlib)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from priorlab.core.log_odds import DETECTED_WALL, log_odds

WIDTH, HEIGHT = 480, 300
LEFT, RIGHT, TOP, BOTTOM = 52, 66, 14, 40
MAIN, OTHER = "#0072b2", "#777777"


def track_svg(track: ArrayLike, seen_free: Sequence[bool], other: ArrayLike, threshold: float = DETECTED_WALL) -> str:
    """Draw log odds against the number of readings.

    Parameters
    ----------
    track : (n + 1,) log odds before the first and after every reading
    seen_free : (n,) what each reading said; a ring for free, a filled square for wall
    other : (n + 1,) a second way to compare with, dashed
    threshold : P(empty) at or below which a cell counts as wall; shaded

    >>> track_svg([0.0, 2.2], [True], [0.0, 2.2]).startswith("<svg")
    True
    """
    main, dashed = np.asarray(track, dtype=np.float64), np.asarray(other, dtype=np.float64)
    reach = max(4.8, 1.1 * float(np.abs(np.concatenate([main, dashed])).max()))

    def x(k: float) -> float:
        """Reading k on the paper."""
        return LEFT + 8 + k * (WIDTH - LEFT - RIGHT - 16) / max(1, len(main) - 1)

    def y(value: float) -> float:
        """Log odds on the paper."""
        return TOP + (reach - value) * (HEIGHT - TOP - BOTTOM) / (2 * reach)

    edge, right, floor = y(float(log_odds(threshold))), WIDTH - RIGHT, HEIGHT - BOTTOM
    parts = [
        f"<rect width='{WIDTH}' height='{HEIGHT}' fill='#fff'/>",
        f"<rect x='{LEFT}' y='{edge:.1f}' width='{right - LEFT}' height='{floor - edge:.1f}' fill='#e4e4e4'/>",
        f"<path d='M{LEFT} {y(0):.1f}H{right}' stroke='#000'/>",
        f"<path d='M{LEFT} {edge:.1f}H{right}' stroke='#555' stroke-dasharray='2 3'/>",
        f"<rect x='{LEFT}' y='{TOP}' width='{right - LEFT}' height='{floor - TOP}' fill='none' stroke='#999'/>",
        _text(LEFT + 6, floor - 6, f"shaded: detected as wall, P \u2264 {threshold:g}", "start"),
    ]
    for p in (0.001, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999):
        if abs(log_odds(p)) < reach:
            parts.append(_text(right + 6, y(float(log_odds(p))) + 4, f"P {p:g}", "start"))
    for value in range(-int(reach), int(reach) + 1):
        if value % max(2, int(reach) // 4) == 0:
            parts.append(_text(LEFT - 6, y(value) + 4, f"{value:d}", "end"))
    for k in range(0, len(main), 1 + len(main) // 12):
        parts.append(_text(x(k), floor + 15, f"{k}", "middle"))
    parts += [
        _text((LEFT + right) / 2, HEIGHT - 8, "readings of this cell", "middle"),
        f"<g transform='rotate(-90 14 {(TOP + floor) / 2:.1f})'>{_text(14, (TOP + floor) / 2, 'log odds l', 'middle')}</g>",
        _way(x, y, dashed, f"stroke='{OTHER}' stroke-dasharray='5 4'"),
        _way(x, y, main, f"stroke='{MAIN}' stroke-width='2'"),
        f"<path d='M{x(0):.1f} {y(main[0]) - 7:.1f}l7 7l-7 7l-7 -7z' fill='{MAIN}'/>",
    ]
    for k, free in enumerate(seen_free, start=1):
        at_x, at_y = x(k), y(main[k])
        parts.append(
            f"<circle cx='{at_x:.1f}' cy='{at_y:.1f}' r='5' fill='#fff' stroke='{MAIN}' stroke-width='2'/>"
            if free
            else f"<rect x='{at_x - 5:.1f}' y='{at_y - 5:.1f}' width='10' height='10' fill='{MAIN}'/>"
        )
    size = f"width='{WIDTH}' height='{HEIGHT}' viewBox='0 0 {WIDTH} {HEIGHT}'"
    return f"<svg xmlns='http://www.w3.org/2000/svg' {size} font-family='sans-serif' font-size='12'>{''.join(parts)}</svg>"


def _text(x: float, y: float, words: str, anchor: str) -> str:
    """A label."""
    return f"<text x='{x:.1f}' y='{y:.1f}' text-anchor='{anchor}'>{words}</text>"


def _way(x, y, values: np.ndarray, style: str) -> str:  # type: ignore[no-untyped-def]
    """A line through the values."""
    points = " ".join(f"{x(k):.1f},{y(value):.1f}" for k, value in enumerate(values))
    return f"<polyline points='{points}' fill='none' {style}/>"
