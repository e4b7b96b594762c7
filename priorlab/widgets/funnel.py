"""The funnel of tests as a small drawing (SVG): one bar for each test, as long as the logarithm of what it leaves."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

import numpy as np

WIDTH, ROW, LEFT, RIGHT, TOP = 430, 24, 128, 74, 24
KEPT, EMPTY_BAR, MARKED = "#009e73", "#d55e00", "#0072b2"


def funnel_svg(left: Mapping[str, int], marked: str | None = None, title: str = "left after each test (logarithmic)") -> str:
    """Draw how many candidates each stage leaves.

    Parameters
    ----------
    left : stage -> how many are left after it, from the first to the last
    marked : a stage to point at

    >>> funnel_svg({"wedges": 100, "geometry": 0}, marked="geometry").count("<rect")
    3
    """
    top = max(1.0, float(np.log10(1 + max(left.values(), default=1))))
    height = TOP + ROW * len(left) + 8
    parts = [
        f"<rect width='{WIDTH}' height='{height}' fill='#fff'/>",
        f"<text x='{LEFT}' y='15' fill='#444'>{escape(title)}</text>",
    ]
    for place, (name, count) in enumerate(left.items()):
        y = TOP + ROW * place
        length = max(1.0, (WIDTH - LEFT - RIGHT) * float(np.log10(1 + count)) / top)
        colour = EMPTY_BAR if count == 0 else MARKED if name == marked else KEPT
        weight = " font-weight='bold'" if name == marked else ""
        arrow = "\u25b8 " if name == marked else ""
        parts += [
            f"<text x='{LEFT - 8}' y='{y + 16}' text-anchor='end'{weight}>{arrow}{escape(name)}</text>",
            f"<rect x='{LEFT}' y='{y + 3}' width='{length:.1f}' height='{ROW - 6}' fill='{colour}'/>",
            f"<text x='{LEFT + length + 6:.1f}' y='{y + 16}'{weight}>{count:,}{'' if count else ' none left'}</text>",
        ]
    size = f"width='{WIDTH}' height='{height}' viewBox='0 0 {WIDTH} {height}'"
    return f"<svg xmlns='http://www.w3.org/2000/svg' {size} font-family='sans-serif' font-size='12.5'>{''.join(parts)}</svg>"
