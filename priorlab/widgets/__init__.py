"""Floor 6: sliders and pictures for the notebooks. They compute nothing: whatever a slider does, one line of code can do."""

from priorlab.widgets.map_lab import MapLab as MapLab
from priorlab.widgets.one_cell import OneCellLab as OneCellLab
from priorlab.widgets.update_steps import UpdateSteps as UpdateSteps
