"""Everything of chapters 4 and 5 up to the depth camera: figures, tables, claims and studies of the five drawings, in order."""

from __future__ import annotations

from priorlab.figures.chapter4 import FIGURE_4_5, FIGURE_4_7, FIGURE_4_8
from priorlab.figures.chapter4_claims import CLAIM_INTERPOLATION, CLAIM_RATES, CLAIM_THRESHOLD
from priorlab.figures.chapter4_maps import FIGURE_4_6, FIGURE_4_9, FIGURE_4_10, FIGURE_4_11
from priorlab.figures.chapter4_tables import TABLE_4_1, TABLE_4_2
from priorlab.figures.chapter5 import FIGURE_5_8, FIGURE_5_9, FIGURE_5_10
from priorlab.figures.chapter5_maps import FIGURE_5_1, FIGURE_5_2, FIGURE_5_7, FIGURES_5_3_TO_5_6
from priorlab.figures.chapter5_studies import STUDY_CELLS, STUDY_EXPLORATION, STUDY_PRIORS, STUDY_SENSORS, STUDY_UPDATES

PRIOR_FIGURES = (
    *(FIGURE_4_5, TABLE_4_1, TABLE_4_2, FIGURE_4_6, FIGURE_4_7, FIGURE_4_8, FIGURE_4_9, FIGURE_4_10, FIGURE_4_11),
    *(CLAIM_RATES, CLAIM_INTERPOLATION, CLAIM_THRESHOLD),
    *(FIGURE_5_1, FIGURE_5_2, *FIGURES_5_3_TO_5_6, FIGURE_5_7, FIGURE_5_8, FIGURE_5_9, FIGURE_5_10),
    *(STUDY_CELLS, STUDY_EXPLORATION, STUDY_PRIORS, STUDY_SENSORS, STUDY_UPDATES),
)
