"""Pictures show the data they were given: read back from the artists, never from pixels of a text."""

import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure

import priorlab as pl
from priorlab import plot
from priorlab.core.grid import Grid
from priorlab.core.readings import Evidence
from priorlab.optimize.front import Front
from priorlab.plot.extraction import FOUND, IGNORED, INVENTED, MISSED, scored_image


@pytest.fixture
def ax():
    return Figure().add_subplot()


@pytest.fixture
def grid():
    """4 x 6 pixels in cells of 2, half a metre a pixel."""
    return Grid((4, 6), 2, 0.5)


@pytest.fixture
def grid_map(grid):
    return pl.GridMap(pl.log_odds(np.array([[0.1, 0.5, 0.9], [0.2, 0.4, 0.8]])), grid)


def xy_of(line):
    """Points of a line."""
    return np.column_stack(line.get_data())


def test_import_of_priorlab_loads_no_matplotlib():
    loaded = "import sys, priorlab, priorlab.plot; print(sorted({'matplotlib', 'sklearn', 'pymoo', 'PIL'} & set(sys.modules)))"
    said = subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "[]"


def test_plot_lists_its_pictures():
    assert {"map", "drawing", "doors", "walls", "sweep", "front", "clusters", "particles", "log_odds_curve"} <= set(plot.__all__)
    assert all(callable(getattr(plot, name)) for name in plot.__all__)


def test_map_shows_p_empty_with_row_0_on_top_in_pixels(grid_map, ax):
    assert plot.map(grid_map, ax) is ax
    image = ax.images[0]
    assert np.allclose(image.get_array(), [[0.1, 0.5, 0.9], [0.2, 0.4, 0.8]])
    assert tuple(image.get_extent()) == (0, 6, 0, 4) and image.origin == "upper"  # y up: row 0 lies at y = 4
    assert image.get_clim() == (0, 1) and image.get_cmap()(1.0) == (1, 1, 1, 1)  # white is empty
    assert ax.get_xlabel() == "x, pixels" and ax.get_ylim() == (0, 4)


def test_map_with_a_trajectory_is_in_metres(grid_map, ax):
    way = np.array([[0.2, 0.3, 0.0], [1.0, 1.5, 0.1]])
    plot.map(grid_map, ax, trajectory=way, truth=way + 0.1, poses=[[2.0, 2.0, 0.0]])
    assert tuple(ax.images[0].get_extent()) == (0, 3, 0, 2)
    assert ax.get_xlabel() == "x, m" and ax.get_xlim() == (0, 3)
    lines = {line.get_label(): xy_of(line) for line in ax.lines}
    assert lines["estimated way"] == pytest.approx(way[:, :2])
    assert lines["true way"] == pytest.approx(way[:, :2] + 0.1)
    assert lines["survey poses"] == pytest.approx(np.array([[1.0, 1.0]]))  # poses come in pixels


def test_map_whose_cells_stick_out_ends_with_the_drawing(ax):
    grid_map = pl.GridMap(np.zeros((2, 3)), Grid((5, 8), 3))
    plot.map(grid_map, ax)
    assert tuple(ax.images[0].get_extent()) == (0, 9, 0, 6)
    assert ax.get_xlim() == (0, 8) and ax.get_ylim() == (0, 5)


def test_map_without_an_ax_makes_a_figure(grid_map):
    ax = plot.map(grid_map)
    assert ax.figure.number in plt.get_fignums()
    plt.close(ax.figure)


def test_looks_leaves_unseen_cells_out(grid, ax):
    looks = np.array([[0, 1, 2], [3, 0, 5]])
    plot.looks(Evidence(looks * 1.0, looks, grid, pl.RangeSensor()), ax)
    assert ax.images[0].get_array().mask.tolist() == (looks == 0).tolist()
    assert "67 % of the cells" in ax.get_title() and "2.75" in ax.get_title()


def test_readings_dots_lie_where_the_rays_ended(grid_map, ax):
    readings = pl.Readings([[1.0, 2.0, 0.0]], [[2.0, np.inf]], [0.0, np.pi / 2], pl.RangeSensor(max_range=3), (4, 6))
    plot.readings(readings, grid_map, ax)
    hits, poses = ax.lines
    assert xy_of(hits) == pytest.approx(np.array([[3.0, 2.0]]))
    assert xy_of(poses) == pytest.approx(np.array([[1.0, 2.0]]))


def test_readings_draw_no_ray_where_there_is_no_reading(grid_map, ax):
    lost, nothing_met = [[np.nan, 2.0, 2.0, 2.0, 1.0]], [[np.inf, 2.0, 2.0, 2.0, 1.0]]
    bearings, sensor = np.linspace(-1, 1, 5), pl.RangeSensor(max_range=3)
    plot.readings(pl.Readings([[1.0, 2.0, 0.0]], lost, bearings, sensor, (4, 6), np.isfinite(lost)), grid_map, ax)
    assert len(ax.collections[0].get_segments()) == 1 and len(xy_of(ax.lines[0])) == 4
    plot.readings(pl.Readings([[1.0, 2.0, 0.0]], nothing_met, bearings, sensor, (4, 6)), grid_map, ax)
    assert len(ax.collections[1].get_segments()) == 2


def test_scored_image_tells_all_four_kinds():
    truth = pl.Truth(np.array([[True, True, False, False, True]]), np.array([[False, False, False, False, True]]))
    image = scored_image([[True, False, True, False, True]], truth)
    assert image[0].tolist() == [list(kind) for kind in (FOUND, MISSED, INVENTED, (255, 255, 255), IGNORED)]


def test_scored_colours_differ_in_lightness_too():
    grey = sorted(float(np.dot(colour, (0.2126, 0.7152, 0.0722))) for colour in (FOUND, MISSED, INVENTED, IGNORED, (255,) * 3))
    assert np.diff(grey).min() > 20  # told apart without any hue


def test_walls_and_drawing_keep_image_axes_y_down(ax):
    walls = pl.Walls(np.array([[1, 0, 0], [0, 0, 1]]))
    plot.walls(walls, None, ax)
    assert ax.images[0].get_array()[:, :, 0].tolist() == [[0, 255, 255], [255, 255, 0]]
    assert ax.get_ylim() == (1.5, -0.5)


def test_doors_are_triangles_with_their_open_side(ax):
    door = pl.Door((1, 2), (5, 2), (1, 6))
    plot.doors([door], pl.Drawing(np.full((9, 9), 255, dtype=np.uint8)), ax)
    assert ax.patches[0].get_xy()[:3].tolist() == [[1, 2], [5, 2], [1, 6]]
    assert xy_of(ax.lines[0]).tolist() == [[1, 2], [5, 2]] and ax.lines[0].get_linestyle() == "--"
    assert ax.get_title() == "1 doors"


def test_funnel_writes_every_count_and_marks_the_stage_that_lost_all(ax):
    plot.funnel({"corners": 1200, "geometry": 30, "dark_share": 0}, "dark_share", ax)
    assert [text.get_text() for text in ax.texts] == ["1,200", "30", "0  none left"]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["corners", "geometry", "dark share"]
    assert xy_of(ax.lines[0]).tolist() == [[0, 2]]


def test_front_shows_recall_across_and_precision_up(ax):
    front = Front(np.array([0.2, 0.3]), np.array([0.9, 0.8]), np.array([0.9, 0.7]), np.array([0.5, 0.8]), "exact")
    plot.front({"one": front, "two": front}, ax, prior=(0.6, 0.7))
    one, two, prior = ax.lines
    assert xy_of(one).tolist() == [[0.5, 0.9], [0.8, 0.7]]
    assert xy_of(prior).tolist() == [[0.7, 0.6]]
    assert one.get_marker() != two.get_marker() and one.get_linestyle() != two.get_linestyle()  # not by colour alone


def test_sweep_has_p_wall_across_and_p_space_up(ax):
    walls = pl.Walls(np.array([[1, 1, 0, 0]] * 2))
    truth = pl.Truth(walls.mask, np.zeros((2, 4)))
    sweep = pl.Experiment(walls, Evidence.none(Grid((2, 4))), truth).sweep()
    plot.sweep(sweep, "recall", ax, n=10)
    shown = ax.images[0].get_array()
    for i, p_wall in enumerate(np.linspace(0.1, 1, 10)):
        assert shown[5, i] == (1.0 if 0.9 * p_wall <= 0.2 else 0.0)  # nothing seen: the prior decides alone
    with pytest.raises(ValueError, match="measure must be one of precision"):
        plot.sweep(sweep, "accuracy", ax)


def test_f_over_time_has_three_lines_that_differ_in_more_than_colour(ax):
    plot.f_over_time([0, 10, 20], [0.9, 0.8, 0.8], [0, 0.2, 0.4], 0.9, ax)
    informed, uninformed, alone = ax.lines
    assert xy_of(uninformed).tolist() == [[0, 0], [10, 0.2], [20, 0.4]]
    assert set(alone.get_ydata()) == {0.9}
    assert len({line.get_linestyle() for line in ax.lines}) == 3


def test_score_bars_say_when_nothing_was_detected(ax):
    plot.score_bars({"none": pl.Score(0, 0, 5, 5), "half": pl.Score(5, 5, 5, 5)}, ax)
    said = [text.get_text() for text in ax.texts]
    assert said.count("nothing detected") == 1 and said.count("0.50") == 3


def test_trajectory_error_names_the_root_mean_square(ax):
    plot.trajectory_error([3.0, 4.0, 0.0], ax)
    assert ax.lines[1].get_label() == f"ATE {np.sqrt(25 / 3):.2f} m"


def test_particles_and_trajectory_are_in_metres(grid_map, ax):
    plot.particles([[1.0, 0.5, 0.0], [1.2, 0.6, np.pi / 2]], grid_map, ax, truth=[1.1, 0.5, 0.0])
    arrows = ax.collections[0]
    assert arrows.get_offsets().tolist() == [[1.0, 0.5], [1.2, 0.6]]
    assert ax.get_xlabel() == "x, m"
    other = plot.trajectory([[0, 0, 0], [1, 1, 0]], truth=[[0, 0, 0], [1, 0, 0]], ax=Figure().add_subplot())
    assert [line.get_label() for line in other.lines] == ["true way", "estimated way", "start"]
