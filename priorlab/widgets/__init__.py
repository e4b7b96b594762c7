"""Floor 6: sliders and pictures for the notebooks. They compute nothing: whatever a slider does, one line of code can do."""

from priorlab.widgets.candidate_lab import CandidateLab as CandidateLab
from priorlab.widgets.density_lab import DensityLab as DensityLab
from priorlab.widgets.depth_lab import DepthLab as DepthLab
from priorlab.widgets.door_lab import DoorLab as DoorLab
from priorlab.widgets.field_lab import FieldLab as FieldLab
from priorlab.widgets.flip_lab import FlipLab as FlipLab
from priorlab.widgets.growth_lab import GrowthLab as GrowthLab
from priorlab.widgets.map_lab import MapLab as MapLab
from priorlab.widgets.motion_lab import MotionLab as MotionLab
from priorlab.widgets.one_cell import OneCellLab as OneCellLab
from priorlab.widgets.own_drawing import OwnDrawing as OwnDrawing
from priorlab.widgets.pair_lab import PairLab as PairLab
from priorlab.widgets.prior_lab import PriorLab as PriorLab
from priorlab.widgets.resample_lab import ResampleLab as ResampleLab
from priorlab.widgets.run_lab import RunLab as RunLab
from priorlab.widgets.step_lab import StepLab as StepLab
from priorlab.widgets.sweep_lab import SweepLab as SweepLab
from priorlab.widgets.time_lab import TimeLab as TimeLab
from priorlab.widgets.update_steps import UpdateSteps as UpdateSteps
from priorlab.widgets.walk_lab import WalkLab as WalkLab
