"""Every figure and table of the thesis that is made anew, by its number."""

from __future__ import annotations

from priorlab.core.shipped import nearest_name
from priorlab.figures.chapter2 import FIGURE_2_9
from priorlab.figures.chapter3 import TABLE_3_1
from priorlab.figures.chapter3_drawings import DRAWING_FIGURES
from priorlab.figures.chapter6 import FIGURE_6_6, FIGURE_6_8
from priorlab.figures.chapter6_added import ADDED
from priorlab.figures.chapter6_as_is import FIGURE_6_9
from priorlab.figures.chapter6_floor import FIGURE_6_3, FIGURE_6_4, FIGURE_6_5, FIGURE_6_7
from priorlab.figures.chapter6_models import FIGURE_6_1, FIGURE_6_2
from priorlab.figures.chapter6_studies import FILTERS, UPDATES, WORLDS
from priorlab.figures.chapter6_table import TABLE as TABLE_6_1
from priorlab.figures.depth_camera import FIGURE_5_12, FIGURE_5_13
from priorlab.figures.depth_camera_maps import FIGURE_5_14, FIGURE_5_18, FIGURE_5_21, OPTIMUM_5_3
from priorlab.figures.depth_camera_zooms import FIGURE_5_15, FIGURE_5_16, FIGURE_5_17, FIGURE_5_19, FIGURE_5_20
from priorlab.figures.figure import Entry
from priorlab.figures.prior_figures import PRIOR_FIGURES
from priorlab.figures.scaling import SCALING
from priorlab.figures.scan_matching import SCAN_MATCHING

DEPTH_CAMERA = (
    *(FIGURE_5_12, FIGURE_5_13, FIGURE_5_14, FIGURE_5_15, FIGURE_5_16, FIGURE_5_17, FIGURE_5_18, FIGURE_5_19, FIGURE_5_20),
    *(FIGURE_5_21, OPTIMUM_5_3),
)

SIMULATED_FLOOR = (
    *(FIGURE_6_1, FIGURE_6_2, FIGURE_6_3, FIGURE_6_4, FIGURE_6_5, FIGURE_6_6, FIGURE_6_7, FIGURE_6_8, FIGURE_6_9),
    *(TABLE_6_1, ADDED, WORLDS, FILTERS, UPDATES),
)

NOT_COMPUTABLE = {"fig-5-11": "photographs of the arena and of the robot"}
"""Figures of the thesis that no computation can make, and why."""

FIGURES: dict[str, Entry] = {
    entry.name: entry
    for entry in (
        FIGURE_2_9,
        *DRAWING_FIGURES,
        TABLE_3_1,
        *PRIOR_FIGURES,
        *DEPTH_CAMERA,
        *SIMULATED_FLOOR,
        SCAN_MATCHING,
        SCALING,
    )
}


def figure_named(name: str) -> Entry:
    """The entry of that name, or a sentence with the nearest one.

    >>> figure_named("fig-2-9").title
    'log odds over probability'
    >>> figure_named("fig-5-11")
    Traceback (most recent call last):
    ValueError: fig-5-11 cannot be computed: it shows photographs of the arena and of the robot
    """
    if name in NOT_COMPUTABLE:
        raise ValueError(f"{name} cannot be computed: it shows {NOT_COMPUTABLE[name]}")
    return FIGURES[nearest_name("figure", name, list(FIGURES))]
