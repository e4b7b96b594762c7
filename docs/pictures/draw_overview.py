"""Draws docs/pictures/overview.png anew: python docs/pictures/draw_overview.py"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import priorlab as pl  # noqa: E402


def draw() -> None:
    """Write the picture beside this file."""
    plan = pl.load_floor_plan("office_wing")
    walls = pl.extract_walls(plan.drawing).walls
    readings = pl.explore(plan.truth, plan.survey, pl.RangeSensor(max_range=40))
    maps = {}
    for prior in (pl.Prior.uninformed(), pl.Prior(p_wall=0.2, p_space=0.9)):
        prior_map = pl.build_prior_map(walls, prior, cell_size=3)
        maps[prior] = pl.update_map(prior_map, pl.gather_evidence(readings, prior_map.grid))
    without, with_plan = maps.values()
    f2 = [pl.score_map(grid_map, plan.truth).f_beta for grid_map in (without, with_plan)]
    pictures = [
        ("An architect's drawing", plan.drawing.grey / 255),
        ("The walls found in it", 1.0 - walls.mask),
        (f"A quick look, no plan: F2 {f2[0]:.2f}", without.grid.to_image(without.p_empty)),
        (f"The same look, with the plan: F2 {f2[1]:.2f}", with_plan.grid.to_image(with_plan.p_empty)),
    ]
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.6))
    for ax, (title, p_empty) in zip(axes.flat, pictures, strict=True):
        ax.imshow(p_empty, cmap="gray", vmin=0, vmax=1)
        ax.set_title(title, fontsize=11)
        ax.set(xticks=[], yticks=[])
    figure.tight_layout()
    figure.savefig(Path(__file__).with_name("overview.png"), dpi=100)


if __name__ == "__main__":  # the tests import this file: they must not draw
    draw()
