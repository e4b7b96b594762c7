"""Simulation, evidence and update against the naive ways: 600 x 800 pixels, 1,600 poses, range 40 px, measured in one run."""

import io
import math
import time

import matplotlib.pyplot as plt
import numpy as np

from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.picture import encode_png, grey_of
from priorlab.core.score import score_map
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.recursion import update_step_by_step
from priorlab.mapping.update import update_map
from priorlab.robot.explore import explore

HEIGHT, WIDTH, POSES = 600, 800, 1600


def milliseconds(work, repeats=5):
    """Least time of a call (the machine is shared), and what it returned."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        times.append(1e3 * (time.perf_counter() - start))
    return min(times), result


def naive_range(solid, x, y, angle, max_range):
    """One ray, pixel by pixel in plain Python."""
    cos, sin = math.cos(angle), math.sin(angle)
    col, row, t = math.floor(x), math.floor(y), 0.0
    while t <= max_range and 0 <= row < HEIGHT and 0 <= col < WIDTH:
        if solid[HEIGHT - 1 - row][col]:
            return t
        tx = ((col + (cos > 0)) - x) / cos if cos else math.inf
        ty = ((row + (sin > 0)) - y) / sin if sin else math.inf
        t = min(tx, ty)
        col, row = (col + (1 if cos > 0 else -1), row) if tx < ty else (col, row + (1 if sin > 0 else -1))
    return math.inf


def naive_evidence(readings, size):
    """S and n of cells of whole pixels: every cell of every cone, pixel by pixel, in plain Python."""
    sensor, rows, cols = readings.sensor, math.ceil(HEIGHT / size), math.ceil(WIDTH / size)
    total, looks = np.zeros((rows, cols)), np.zeros((rows, cols), dtype=int)
    apart = float(readings.bearings[1] - readings.bearings[0])
    behind = max(sensor.wall_thickness, size / 2)
    for (x, y, theta), ranges in zip(readings.poses.tolist(), readings.ranges.tolist(), strict=True):
        for up in range(max(0, int((y - sensor.max_range) / size)), min(rows, int((y + sensor.max_range) / size) + 1)):
            for col in range(max(0, int((x - sensor.max_range) / size)), min(cols, int((x + sensor.max_range) / size) + 1)):
                distance, bearing = polar((col + 0.5) * size - x, (up + 0.5) * size - y, theta)
                if distance > sensor.max_range or (distance > 0 and abs(bearing) > sensor.half_angle):
                    continue
                if distance > ranges[round((bearing + sensor.half_angle) / apart)] + behind:
                    continue
                front = 0
                tall, wide = min(size, HEIGHT - up * size), min(size, WIDTH - col * size)
                for i in range(tall):
                    for j in range(wide):
                        d, b = polar(col * size + j + 0.5 - x, up * size + i + 0.5 - y, theta)
                        beam = min(max(round((b + sensor.half_angle) / apart), 0), len(ranges) - 1)
                        front += d < ranges[beam]
                total[rows - 1 - up, col] += share_logit(front / (tall * wide), sensor)
                looks[rows - 1 - up, col] += 1
    return total, looks


def polar(dx, dy, theta):
    """Distance and bearing of a place."""
    return math.hypot(dx, dy), (math.atan2(dy, dx) - theta + math.pi) % (2 * math.pi) - math.pi


def share_logit(share, sensor):
    """logit of the share of a cell in front of the obstacle, as eq. 4.22 has it."""
    p = min(max(share, sensor.p_occupied), sensor.p_free)
    return math.log(p / (1 - p))


def test_bench_survey_and_evidence(survey):
    truth, poses = survey
    sensor = RangeSensor(max_range=40)
    simulated, readings = milliseconds(lambda: explore(truth, poses, sensor))

    few = slice(0, POSES, 100)  # the naive ways see one pose in a hundred
    solid, part = truth.obstacles.tolist(), readings[few]
    naive_rays, ranges = milliseconds(
        lambda: [[naive_range(solid, x, y, t + b, 40) for b in readings.bearings] for x, y, t in part.poses.tolist()], 1
    )
    np.testing.assert_allclose(part.ranges, ranges, atol=1e-6)

    print(f"\n{POSES:,} poses, range 40 px, {len(readings.bearings)} bearings; {WIDTH} x {HEIGHT} px      ms   naive loop, ms")
    print(f"  ranges (explore)                                     {simulated:8.0f} {100 * naive_rays:16,.0f}")
    for cell_size in (1, 2, 3, 5, 10, 2.5):
        grid = Grid((HEIGHT, WIDTH), cell_size)
        gathered, evidence = milliseconds(lambda grid=grid: gather_evidence(readings, grid), 3)
        naive = " " * 16
        if isinstance(cell_size, int):
            naive_ms, (total, looks) = milliseconds(lambda size=cell_size: naive_evidence(part, size), 1)
            by_array = gather_evidence(part, grid)
            assert (by_array.looks != looks).sum() <= 0.005 * looks.sum()  # ties at the rim of a cone
            assert (np.abs(by_array.total - total) > 1e-9).sum() <= 0.005 * looks.sum()
            assert simulated + gathered < naive_rays * 100 + naive_ms * 100
            naive = f"{100 * naive_ms:16,.0f}"
        print(
            f"  evidence, cells of {cell_size:4g} px                           {gathered:8.0f} {naive}   "
            f"{evidence.mean_looks:.2f} looks; with the ranges {simulated + gathered:.0f}, reach 400"
        )
        assert simulated + gathered < 2000  # the aim is 400 ms; a shared machine may be five times slower


def test_bench_slider(survey):
    truth, poses = survey
    walls = Walls(truth.walls.astype(np.uint8))
    readings = explore(truth, poses, RangeSensor(max_range=40))

    def moved(prior_map, evidence):
        """What a slider does: map, score, picture."""
        posterior = update_map(prior_map, evidence)
        return score_map(posterior, truth), encode_png(posterior.grid.to_image(grey_of(posterior.p_empty)))

    figure, ax = plt.subplots(figsize=(8, 6), dpi=100)
    shown_image = ax.imshow(np.zeros((2, 2)), cmap="gray", vmin=0, vmax=1)

    def redrawn(prior_map, evidence):
        """The same with Matplotlib: the image is changed, not made anew."""
        posterior = update_map(prior_map, evidence)
        shown_image.set_data(posterior.p_empty)
        picture = io.BytesIO()
        figure.savefig(picture, format="png")
        return score_map(posterior, truth), picture.getvalue()

    print(f"\nOne move of a slider, {WIDTH} x {HEIGHT} px                          ms   Matplotlib, ms   step by step, ms")
    for cell_size in (3, 1):
        prior_map = build_prior_map(walls, cell_size=cell_size)
        evidence = gather_evidence(readings, prior_map.grid)
        built, _ = milliseconds(lambda size=cell_size: build_prior_map(walls, cell_size=size))
        shown, _ = milliseconds(lambda prior_map=prior_map, evidence=evidence: moved(prior_map, evidence))
        plotted, _ = milliseconds(lambda prior_map=prior_map, evidence=evidence: redrawn(prior_map, evidence), 3)
        part = readings[: POSES // 100]
        slow, step_by_step = milliseconds(lambda prior_map=prior_map, part=part: update_step_by_step(prior_map, part), 1)
        closed = update_map(prior_map, gather_evidence(part, prior_map.grid))
        np.testing.assert_allclose(step_by_step.log_odds, closed.log_odds, atol=1e-9)
        print(
            f"  cells of {cell_size} px: prior map {built:5.1f} ms + map, score, PNG {shown:8.1f} {plotted:16.0f} "
            f"{100 * slow:18,.0f}   reach {8 if cell_size == 3 else 16}"
        )
        assert built + shown < min(500, plotted)
    plt.close(figure)
