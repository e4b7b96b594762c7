"""Insides of walls that are drawn in one weight: white cells, long and narrow all along, between two lines.

Where walls, doors and furniture are drawn with one pen, no weight tells them apart; but hardly a piece of furniture is eight
times longer than it is wide, as narrow as a wall, and straight or as large as a room.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.faces import long_runs, thin_cells
from priorlab.drawing.strokes import thinner_run
from priorlab.drawing.wall_sizes import WallSizes

ELONGATED = 8.0
"""Length of such a cell, in widths."""

STRAIGHT = 1.6
"""A straight cell lies in a box so many times wider than itself."""

SPANS = 0.1
"""A cell that is not straight spans so much of M, like the walls round a room."""
