"""Draws docs/pictures/conventions.png anew: python docs/pictures/draw_conventions.py"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from priorlab.plot.frame import frame, thresholds  # noqa: E402


def draw() -> None:
    """Write the picture beside this file."""
    figure, (above, below) = plt.subplots(2, 1, figsize=(8, 6.2), height_ratios=[4, 1.4])
    frame(above)
    thresholds(below)
    figure.tight_layout()
    figure.savefig(Path(__file__).with_name("conventions.png"), dpi=110)


if __name__ == "__main__":  # the tests import this file: they must not draw
    draw()
