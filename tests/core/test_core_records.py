"""The records: what they hold, what they refuse, how they show themselves."""

import dataclasses
import math

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.building import FloorPlan, Truth, World
from priorlab.core.drawing import Door, Drawing, Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.picture import encode_png, grey_of
from priorlab.core.readings import Evidence, Readings, RobotLog
from priorlab.core.sensor import KINECT, Odometry, RangeSensor, Scanner
from priorlab.core.shipped import data_folder, nearest_name

GREY = np.full((4, 6), 255, dtype=np.uint8)
POSES = np.array([[1.0, 2.0, 0.0], [3.0, 2.0, 1.0]])
LOG = {"odometry": POSES, "ranges": np.ones((2, 3)), "bearings": np.zeros(3), "scanner": KINECT, "start": POSES[0]}


def make_readings(ranges, poses=POSES):
    return Readings(poses, ranges, np.zeros(3), RangeSensor(), (4, 6))


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (
            lambda: Drawing(np.zeros((0, 4), dtype=np.uint8)),
            r"grey must be a 2-D image with at least one pixel, got shape \(0, 4\)",
        ),
        (lambda: Drawing(GREY, colour=np.zeros((4, 6))), r"colour must have shape \(4, 6, 3\), got \(4, 6\)"),
        (lambda: Drawing(GREY, metres_per_pixel=0), "metres_per_pixel must be a finite number above 0, got 0"),
        (lambda: Truth(GREY, GREY.T), r"walls and ignore must have one shape, got \(4, 6\) and \(6, 4\)"),
        (lambda: World(GREY, math.inf), "metres_per_pixel must be a finite number above 0, got inf"),
        (lambda: Prior(p_wall=0), "the effective p_wall must lie strictly between 0 and 1, got 0 x 0.9 = 0"),
        (lambda: Prior(p_space=1, factor=1), "the effective p_space must lie strictly between 0 and 1, got 1 x 1 = 1"),
        (lambda: Prior(p_wall=math.nan), "the effective p_wall must lie"),
        (lambda: GridMap(np.zeros((2, 2)), Grid((4, 6))), r"log_odds must have the grid's shape \(4, 6\), got \(2, 2\)"),
        (lambda: make_readings(np.zeros((2, 2))), r"ranges must have shape \(2, 3\), got \(2, 2\)"),
        (lambda: make_readings([[1, 2, 3], [4, math.nan, 6]]), "inf for no return, got nan at pose 1, beam 1"),
        (lambda: make_readings([[1, 2, -3], [4, 5, 6]]), "inf for no return, got -3 at pose 0, beam 2"),
        (lambda: make_readings(np.ones((1, 3)), [[1, 2]]), r"poses must have shape \(N, 3\)"),
        (lambda: make_readings(np.ones((1, 3)), [[1, math.nan, 0]]), "poses must be finite numbers.*row 0"),
        (lambda: RangeSensor(max_range=-1), "max_range must be a finite number above 0, got -1"),
        (lambda: RangeSensor(half_angle=4), "half_angle must be at most pi radians, got 4"),
        (lambda: RangeSensor(p_free=0.2, p_occupied=0.3), "p_free must be above p_occupied, got 0.2 and 0.3"),
        (lambda: RangeSensor(p_free=1), "p_free must lie strictly between 0 and 1, got 1"),
        (lambda: RangeSensor(beyond="wall"), "beyond must be 'thickness', 'hit_cell' or 'all', got 'wall'"),
        (lambda: Scanner(n_beams=0), "n_beams must be a whole number of at least 1, got 0"),
        (lambda: Scanner(min_range_m=3, max_range_m=2), r"min_range_m must lie in \[0, max_range_m\), got 3"),
        (lambda: Scanner(range_noise_m=-1), "range_noise_m must be a finite number of at least 0, got -1"),
        (lambda: Scanner(dropout_rate=1.5), "dropout_rate must lie between 0 and 1, got 1.5"),
        (lambda: Odometry((0.1, 0.1, 0.1)), "alphas must be four finite numbers of at least 0"),
        (lambda: Evidence(np.zeros((2, 2)), np.zeros((4, 6)), Grid((4, 6)), RangeSensor()), "total must have the grid's shape"),
        (lambda: RobotLog(**{**LOG, "ranges": np.ones((2, 4))}), r"ranges must have shape \(2, 3\), got \(2, 4\)"),
        (lambda: RobotLog(**{**LOG, "ranges": -np.ones((2, 3))}), "ranges must not be negative, got -1 m"),
        (lambda: RobotLog(**LOG, truth=POSES[:1]), "truth must hold 2 poses, one per odometry pose, got 1"),
        (lambda: RobotLog(**{**LOG, "bearings": [0, np.nan, 1]}), "bearings must be finite angles, got nan"),
        (lambda: RobotLog(**LOG, stamps=[1.0]), r"stamps must be 2 finite numbers, one per odometry pose, got shape \(1,\)"),
        (lambda: RobotLog(**LOG, stamps=[1.0, np.nan]), "stamps must be 2 finite numbers"),
        (lambda: encode_png(np.zeros((3, 3))), "image must be a non-empty uint8 picture, got float64"),
    ],
)
def test_records_say_what_is_wrong(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()


@pytest.mark.parametrize("record", [Drawing(GREY), Door((0, 0), (3, 0), (0, 3)), Prior(), RangeSensor(), KINECT, Grid((4, 6))])
def test_records_are_frozen(record):
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(record, dataclasses.fields(record)[0].name, None)


# --- drawings and buildings ----------------------------------------------------------------------------------------------


def test_door_width_is_the_length_of_its_open_side():
    assert Door(hinge=(1, 1), strike=(4, 5), tip=(1, 6)).width == 5


def test_walls_mask_holds_walls_and_windows_only():
    walls = Walls(np.array([[0, 1, 2, 3]], dtype=np.uint8))
    assert walls.mask.tolist() == [[False, True, True, False]]
    assert walls.windows.tolist() == [[False, False, True, False]]


def test_truth_obstacles_are_walls_and_windows():
    walls, windows = np.array([[True, False, False]]), np.array([[False, True, False]])
    assert Truth(walls, ~walls & False, windows=windows).obstacles.tolist() == [[True, True, False]]
    assert Truth(walls, ~walls & False).obstacles.tolist() == walls.tolist()


def test_records_show_themselves_in_one_line():
    truth = Truth(GREY > 0, GREY < 0, metres_per_pixel=0.5)
    plan = FloorPlan("hut", Drawing(GREY, name="hut"), truth, World(GREY > 255, 0.5), POSES, POSES[:, :2])
    shown = [
        repr(plan),
        repr(plan.drawing),
        repr(Walls(GREY // 255, 0.5)),
        repr(make_readings([[1, 2, np.inf]] * 2)),
        repr(RobotLog(**LOG)),
        repr(Prior(0.3, 0.8)),
        repr(GridMap(np.zeros((4, 6)), Grid((4, 6)))),
    ]
    assert shown == [
        "FloorPlan(hut: 3.0 x 2.0 m at 0.5 m per pixel, 0 doors, 2 survey poses)",
        "Drawing(hut: 6 x 4 px, scale unknown)",
        "Walls(walls: 6 x 4 px, 100.0 % wall)",
        "Readings(2 poses x 3 bearings, 67 % met an obstacle)",
        "RobotLog(2 scans of 3 beams over 2.0 m)",
        "Prior(p_wall=0.3, p_space=0.8, effective 0.27 and 0.72)",
        "GridMap(6 x 4 cells of 1 px, P(empty) 0.500 to 0.500, 0 cells at or below 0.2)",
    ]


@pytest.mark.parametrize("record", [Walls(np.eye(5, dtype=np.uint8)), GridMap(9 - 18 * np.eye(5), Grid((5, 5)))])
def test_records_are_pictures_with_white_for_empty(record):
    picture = cv2.imdecode(np.frombuffer(record._repr_png_(), np.uint8), cv2.IMREAD_GRAYSCALE)
    assert (picture == 255 * (1 - np.eye(5))).all()


def test_grey_of_rounds_to_the_nearest_grey():
    assert grey_of([[0.0, 0.2, 0.5, 0.9, 1.0]]).tolist() == [[0, 51, 128, 230, 255]]


def test_encode_png_keeps_red_red():
    png = encode_png(np.array([[[255, 0, 0]]], dtype=np.uint8))
    assert cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR).tolist() == [[[0, 0, 255]]]  # blue, green, red


# --- prior and evidence --------------------------------------------------------------------------------------------------


def test_prior_multiplies_by_its_factor_and_uninformed_does_not():
    assert Prior(0.2, 1.0).effective_p_space == 0.9
    prior = Prior.uninformed()
    assert prior.effective_p_wall == prior.effective_p_space == 0.5 and prior.is_uninformed
    assert not Prior().is_uninformed


@given(st.integers(0, 2**32 - 1))
def test_evidence_adds_and_subtracts(seed):
    rng = np.random.default_rng(seed)
    grid, sensor = Grid((4, 6), 2), RangeSensor()
    one, two = (Evidence(rng.normal(size=(2, 3)), rng.integers(0, 5, (2, 3)), grid, sensor) for _ in range(2))
    both = one + two
    assert (both.total == one.total + two.total).all() and (both.looks == one.looks + two.looks).all()
    np.testing.assert_allclose((both - two).total, one.total, atol=1e-12)
    assert ((both - two).looks == one.looks).all()
    assert ((one + Evidence.none(grid, sensor)).total == one.total).all()


def test_evidence_of_another_sensor_does_not_add_up():
    grid = Grid((4, 6))
    with pytest.raises(ValueError, match="one grid and one sensor"):
        Evidence.none(grid) + Evidence.none(grid, RangeSensor(p_free=0.8))
    with pytest.raises(ValueError, match="one grid and one sensor"):
        Evidence.none(grid) - Evidence.none(Grid((4, 6), 2))


def test_mean_looks_counts_seen_cells_only():
    evidence = Evidence(np.zeros((1, 4)), np.array([[0, 1, 3, 0]]), Grid((1, 4)), RangeSensor())
    assert evidence.seen.tolist() == [[False, True, True, False]] and evidence.mean_looks == 2.0
    assert Evidence.none(Grid((1, 4))).mean_looks == 0.0


def test_some_readings_are_readings():
    readings = make_readings([[1, 2, 3], [4, 5, 6]])
    assert len(readings[1:]) == 1 and readings[1:].ranges.tolist() == [[4, 5, 6]]
    assert len(readings[:0]) == 0


def test_readings_may_be_missing_where_valid_says_so():
    valid = np.array([[True, True, False], [True, False, False]])
    readings = dataclasses.replace(make_readings([[1, 2, 0], [4, 5, 6]]), ranges=[[1, np.inf, np.nan], [4, -1, 6]], valid=valid)
    assert readings.share_missing == 0.5 and readings.met.tolist() == [[True, False, False], [True, False, False]]
    assert readings[1:].valid.tolist() == [[True, False, False]]
    assert repr(readings) == "Readings(2 poses x 3 bearings, 33 % met an obstacle, 50 % without a reading)"
    with pytest.raises(ValueError, match=r"valid must have the shape of ranges \(2, 3\), got \(3,\)"):
        dataclasses.replace(readings, valid=[True] * 3)
    with pytest.raises(ValueError, match="got nan at pose 0, beam 2: where the sensor gave no reading, valid must be False"):
        dataclasses.replace(readings, valid=None)


def test_scanner_bearings_go_from_right_to_left():
    assert Scanner(n_beams=3, field_of_view=1.0).bearings.tolist() == [-0.5, 0.0, 0.5]
    assert Scanner(n_beams=1).bearings.tolist() == [0.0]


# --- what is shipped -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("inside", [True, False])
def test_data_folder_lies_in_the_package_or_beside_it(tmp_path, inside):
    package = tmp_path / "priorlab"
    data = (package if inside else tmp_path) / "data"
    data.mkdir(parents=True)
    (data / "hut.toml").write_text("")
    assert data_folder(package) == data


def test_data_folder_says_when_there_is_none(tmp_path):
    (tmp_path / "data").mkdir()  # a folder of that name that holds something else
    with pytest.raises(FileNotFoundError, match="install priorlab again"):
        data_folder(tmp_path / "priorlab")


def test_nearest_name_names_the_nearest():
    assert nearest_name("building", "hut", ["hut", "house"]) == "hut"
    with pytest.raises(ValueError, match="building must be one of hut, house, got 'huose'; did you mean 'house'?"):
        nearest_name("building", "huose", ["hut", "house"])
