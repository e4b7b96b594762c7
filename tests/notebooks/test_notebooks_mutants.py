"""Wrong code turns a notebook red: a copy of priorlab with one planted mistake runs through strict nbval.

Each mutant names the objective of the notebook whose printed number it breaks first.
"""

from __future__ import annotations

import re

import pytest

pytestmark = pytest.mark.mutant

START, DOORS, WALLS = "00_start_here", "01_doors", "02_walls"
PRIORS, LOG_ODDS, SWEEP = "03_priors", "04_log_odds", "05_pareto_sweep"
WORTH, DEPTH = "06_worth_it", "07_depth_camera"
LOCALIZE = "08_localization"
FASTSLAM = "09_fastslam"
CLOSED_FORM = "l_0 + total - lam * looks * l_0"
MUTANTS = {  # notebook, file, right, wrong, objective whose number turns red first
    "log10 for ln": (LOG_ODDS, "core/log_odds.py", "np.log(p / (1.0 - p))", "np.log10(p / (1.0 - p))", 1),
    "l0 added in the recursion": (LOG_ODDS, "mapping/recursion.py", "previous - lam * prior", "previous + lam * prior", 2),
    "l0 added in the closed form": (LOG_ODDS, "mapping/update.py", CLOSED_FORM, "l_0 + total + lam * looks * l_0", 2),
    "lam ignored": (LOG_ODDS, "mapping/update.py", CLOSED_FORM, "l_0 + total - looks * l_0", 3),
    "threshold 0.1": (LOG_ODDS, "core/grid_map.py", "threshold: float = 0.2", "threshold: float = 0.1", 4),
    "F1 for F2": (LOG_ODDS, "core/score.py", "DETECTED_WALL, beta: float = 2.0", "DETECTED_WALL, beta: float = 1.0", 5),
    "factor 1": (START, "core/grid_map.py", "factor: float = 0.9", "factor: float = 1.0", 2),
    "lam 0 by default": (START, "mapping/update.py", "lam: float = 1.0) -> GridMap", "lam: float = 0.0) -> GridMap", 3),
    "no trace": (DOORS, "drawing/corners.py", "HARRIS_K = 0.04", "HARRIS_K = 0.0", 1),
    "eq. 3.5 as printed": (DOORS, "drawing/geometry.py", "np.minimum(lengths, other) / np.maximum(", "lengths / np.minimum(", 2),
    "the farthest dark one": (DOORS, "drawing/connectivity.py", "x, y = min(dark, key", "x, y = max(dark, key", 3),
    "of the larger area": (DOORS, "drawing/overlap.py", "smaller = min(", "smaller = max(", 4),
    "every order counts": (
        DOORS,
        "drawing/candidates.py",
        "math.comb(len(self.corners), 3)",
        "math.perm(len(self.corners), 3)",
        5,
    ),
    "v for h": (WALLS, "drawing/sweeps.py", 'return "h" if across > down', 'return "h" if across < down', 1),
    "don't-care counted": (WALLS, "core/score.py", "counted = ~truth.ignore", "counted = np.ones_like(truth.ignore)", 2),
    "a larger square": (
        WALLS,
        "drawing/baselines.py",
        "opened(ink_of(drawing, darkness), side)",
        "opened(ink_of(drawing), side + 1)",
        3,
    ),
    "tiles from the left": (WALLS, "drawing/tiles.py", "+ (x0, y0))", "+ (x0, 0))", 4),
    "notes kept back": (WALLS, "study/own_drawing.py", "OwnResult(found, found.notes)", "OwnResult(found, ())", 5),
    "another factor": (PRIORS, "core/grid_map.py", "factor: float = 0.9", "factor: float = 0.95", 1),
    "eq. 2.22 upside down": (PRIORS, "mapping/overruled.py", "if not is_overruled(", "if is_overruled(", 2),
    "survey of another density": (PRIORS, "buildings/floor_plans.py", "if survey_spacing is None else", "if True else", 3),
    "lam ignored, wrong plans": (PRIORS, "mapping/update.py", CLOSED_FORM, "l_0 + total - looks * l_0", 4),
    "light grey is dark": (PRIORS, "mapping/other_priors.py", "DARK = 127", "DARK = 240", 5),
    "n for n - 1": (SWEEP, "optimize/experiment.py", "astype(np.float64) - 1.0", "astype(np.float64)", 1),
    "another floor": (SWEEP, "optimize/front.py", "FLOOR = 0.4", "FLOOR = 0.55", 2),
    "steps for lines": (SWEEP, "optimize/interpolation.py", "first + share * (second - first)", "first + 0 * share * second", 3),
    "threshold of the score fixed": (SWEEP, "core/log_odds.py", "min(float(log_odds(threshold))", "min(float(log_odds(0.2))", 4),
    "twice is three times": (SWEEP, "study/recall_reasons.py", "pixels[(n >= 2) &", "pixels[(n >= 3) &", 5),
    "unseen is seen": (WORTH, "study/worth.py", "score_map(informed, only_unseen", "score_map(informed, only_seen", 1),
    "readings without news": (WORTH, "mapping/over_time.py", "(looks.total + looks.added)", "looks.total", 2),
    "the farthest poses": (WORTH, "study/surveys.py", "nearest = np.argsort(np.hypot", "nearest = np.argsort(-np.hypot", 3),
    "points for per cent": (
        WORTH,
        "widgets/density_lab.py",
        "self.with_plan / self.without - 1",
        "self.with_plan - self.without",
        4,
    ),
    "half as much missing": (WORTH, "study/damaged_walls.py", "to_lose = round(share", "to_lose = round(0.5 * share", 5),
    "depth for range": (DEPTH, "robot/strip.py", "depth_m / np.cos(camera.bearings), np.inf", "depth_m, np.inf", 1),
    "zeros averaged in": (DEPTH, "robot/strip.py", "np.maximum(count, 1) / 1000.0", "len(strip) / 1000.0", 2),
    "walls without a top": (
        DEPTH,
        "robot/depth_image.py",
        "np.where(below < 0, drop / below, np.inf)",
        "np.inf + below",
        3,
    ),
    "no reading is free": (DEPTH, "robot/strip.py", "image_shape, valid)", "image_shape)", 2),
    "one image three times": (DEPTH, "study/depth_survey.py", "for repeat in range(repeats)]", "for repeat in [0] * repeats]", 4),
    "sensor model ignored": (DEPTH, "study/depth_survey.py", "wall_thickness, p_free, p_occupied)", "wall_thickness)", 5),
    "variance for deviation": (LOCALIZE, "slam/motion.py", 'if parameters.noise == "variance" else', "if True else", 1),
    "walls hinder nobody": (
        LOCALIZE,
        "slam/impassable.py",
        "np.where(entered, math.log(self.p_through_wall), 0.0)",
        "np.zeros(len(after))",
        1,
    ),
    "a wall is near to itself": (LOCALIZE, "slam/likelihood_field.py", "1 - (filled - inner)", "1 - filled", 2),
    "one over the heaviest": (
        LOCALIZE,
        "slam/particles.py",
        "1.0 / np.square(self.weights).sum()",
        "1.0 / self.weights.max()",
        3,
    ),
    "the mean of two rooms": (LOCALIZE, "slam/estimate.py", "heaviest = cluster ==", "heaviest = cluster >= 0 *", 4),
    "weights forgotten": (LOCALIZE, "slam/localization.py", "particles.log_weights + log_weights(", "log_weights(", 5),
    "squares summed, not averaged": (
        FASTSLAM,
        "slam/trajectory_error.py",
        "np.sqrt(np.mean(np.square(position_errors_m(",
        "np.sqrt(np.sum(np.square(position_errors_m(",
        1,
    ),
    "l0 added in eq. 6.2": (FASTSLAM, "slam/map_update.py", "- parameters.lam * looked", "+ parameters.lam * looked", 2),
    "a deviation for a variance": (FASTSLAM, "slam/motion.py", 'if parameters.noise == "variance" else', "if True else", 3),
    "one pen for all": (
        FASTSLAM,
        "slam/run_evidence.py",
        "parameters = parameters or run.parameters",
        "parameters = run.parameters",
        4,
    ),
    "what nobody saw": (FASTSLAM, "study/worth.py", "float(seen[walls].mean())", "float((~seen)[walls].mean())", 5),
}


@pytest.mark.parametrize("name", MUTANTS)
def test_notebook_goes_red(name, run_changed):
    stem, file, right, wrong, objective = MUTANTS[name]
    done, code = run_changed(stem, file, right, wrong, last_tag=f"objective-{objective}")
    assert done.returncode == 1, done.stdout
    assert "mismatch '" in done.stdout, done.stdout
    red = int(re.search(r"FAILED .*::Cell (\d+)", done.stdout).group(1))
    assert f"objective-{objective}" in code[red].metadata.get("tags", []), (red, code[red].source)
