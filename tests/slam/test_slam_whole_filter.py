"""Algorithm 6.1 told once more in plain Python, particle by particle and cell by cell, with the same draws.

Nothing of priorlab.slam is used but what is checked and the records that it takes. Distances are worked out cell against cell,
lines as Bresenham has them, weights as logarithms in doubles; the filter looks logarithms up in single precision, so poses agree
to a hair, and draws are the same ones.
"""

import math
from bisect import bisect_right
from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.parameters import TABLE_6_1, TUNED

CELL_M, ROWS, COLS = 0.1, 30, 40
WALL, FREE = math.log(0.27 / 0.73), math.log(0.72 / 0.28)
BEARINGS = [-0.5, -0.3, -0.1, 0.1, 0.3, 0.5]


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


class SlowFilter:
    """The map is a dictionary of cells (row, col), row 0 at the top; particles are lists [x, y, theta, log weight]."""

    def __init__(self, cells, start, parameters, rng):
        self.prior, self.map, self.p, self.rng = dict(cells), dict(cells), parameters, rng
        most = parameters.particle_limits[1]
        drawn = rng.standard_normal((most, 3)).tolist()
        spread = [math.sqrt(variance) for variance in parameters.start_variances]
        self.particles = [[start[i] + d[i] * spread[i] for i in range(3)] + [0.0] for d in drawn]
        self.waiting, self.behind, self.weighings = [], dict(cells), 0
        self.way, self.last, self.n_charged = 0.0, None, 0
        walls = [cell for cell, value in self.prior.items() if value < math.log(0.35 / 0.65) - 1e-9]
        self.blocked = {
            (r, c) for r, c in self.prior for i, j in walls if math.hypot(r - i, c - j) * CELL_M <= self.p.robot_radius_m + 1e-9
        }

    # --- algorithm 6.3
    def move(self, before, after):
        a1, a2, a3, a4 = self.p.alphas
        dx, dy = after[0] - before[0], after[1] - before[1]
        trans = math.sqrt(dx * dx + dy * dy)
        rot1 = wrap(math.atan2(dy, dx) - before[2]) if trans >= 0.001 else 0.0
        rot2 = wrap(after[2] - before[2] - rot1)
        r1, r2 = rot1, rot2
        if self.p.rotation_noise == "symmetric":
            r1, r2 = min(abs(rot1), math.pi - abs(rot1)), min(abs(rot2), math.pi - abs(rot2))
        parts = [
            (rot1, a1 * r1 * r1 + a2 * trans * trans),
            (trans, a3 * trans * trans + a4 * r1 * r1 + a4 * r2 * r2),
            (rot2, a1 * r2 * r2 + a2 * trans * trans),
        ]
        draws = self.rng.standard_normal((len(self.particles), 3)).tolist()
        for particle, draw in zip(self.particles, draws, strict=True):
            turn, line, turn2 = (
                part - d * (math.sqrt(b) if self.p.noise == "variance" else b) for (part, b), d in zip(parts, draw, strict=True)
            )
            stood_in_wall = cell_of(*particle[:2]) in self.blocked
            particle[0] += line * math.cos(particle[2] + turn)
            particle[1] += line * math.sin(particle[2] + turn)
            particle[2] = wrap(particle[2] + turn + turn2)
            if self.p.p_through_wall < 1 and not stood_in_wall and cell_of(*particle[:2]) in self.blocked:
                particle[3] += math.log(self.p.p_through_wall)  # p(x_k | x_{k-1}, m)
                self.n_charged += 1

    # --- algorithm 6.4
    def likelihoods(self):
        """Log likelihood of an end in every cell, from the boundary of what is occupied."""
        field_map = {"static": self.prior, "updated": self.behind}[self.p.localize_in]
        occupied = {cell for cell, value in field_map.items() if value < math.log(0.35 / 0.65) - 1e-9}
        boundary = [
            (r, c)
            for r, c in occupied
            if any(n in field_map and n not in occupied for n in ((r + 1, c), (r - 1, c), (r, c + 1), (r, c - 1)))
        ]
        said = {}
        for r, c in field_map:
            near = min((math.hypot(r - br, c - bc) * CELL_M for br, bc in boundary), default=math.inf)
            said[r, c] = self.said_at(min(near, self.p.max_distance_m))
        return said

    def said_at(self, dist):
        sigma = self.p.sigma_hit_m
        prob = math.exp(-0.5 * (dist / sigma) ** 2) / (sigma * math.sqrt(2 * math.pi))
        return math.log((1 - self.p.z_random) * prob + self.p.z_random / self.p.max_range_m)

    def weigh(self, scan):
        said, far = self.likelihoods(), self.said_at(self.p.max_distance_m)
        exponent = min(1.0, self.p.temper * math.sqrt(self.p.n_beams / len(scan)))
        for particle in self.particles:
            x, y, theta, _ = particle
            total = 0.0
            for z, bearing in scan:
                total += said.get(cell_of(x + z * math.cos(theta + bearing), y + z * math.sin(theta + bearing)), far)
            particle[3] += exponent * total

    def weights(self):
        largest = max(p[3] for p in self.particles)
        raw = [math.exp(p[3] - largest) for p in self.particles]
        return [w / sum(raw) for w in raw]

    # --- algorithm 6.2: the estimate and the draw
    def estimate(self):
        weights = self.weights()
        bins = {}
        for i, (x, y, theta, _) in enumerate(self.particles):
            bins.setdefault(
                (math.floor(x / 0.5), math.floor(y / 0.5), math.floor((theta % (2 * math.pi)) * 18 / math.pi) % 36), []
            ).append(i)
        best, left = [], set(bins)
        while left:
            heap, members = [left.pop()], []
            while heap:
                x, y, t = heap.pop()
                members += bins[x, y, t]
                near = {(x + i, y + j, (t + k) % 36) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)} & left
                left -= near
                heap += near
            if not best or sum(weights[i] for i in members) > sum(weights[i] for i in best):
                best = members
        total = sum(weights[i] for i in best)
        x, y = (sum(weights[i] * self.particles[i][axis] for i in best) / total for axis in (0, 1))
        sin, cos = (sum(weights[i] * f(self.particles[i][2]) for i in best) for f in (math.sin, math.cos))
        return x, y, math.atan2(sin, cos)

    def resample(self):
        fewest, most = self.p.particle_limits
        shares, total = [], 0.0
        for w in self.weights():
            total += w
            shares.append(total)

        def at(position):
            return min(bisect_right(shares, position), len(shares) - 1)

        n = most
        if fewest < most:  # Fox's loop
            bins, bound = set(), 0.0
            n = 0
            for position in self.rng.random(most).tolist():
                n += 1
                here = bin_of(*self.particles[at(position)][:3])
                if here not in bins:
                    bins.add(here)
                    if len(bins) > 1:
                        a = 2 / (9 * (len(bins) - 1))
                        bound = (len(bins) - 1) / (2 * self.p.kld_epsilon) * (1 - a + math.sqrt(a) * self.p.kld_quantile) ** 3
                if n >= max(bound, fewest):
                    break
        offset = self.rng.random()
        self.particles = [[*self.particles[at((i + offset) / n)][:3], 0.0] for i in range(n)]

    # --- algorithm 6.5
    def see(self, pose, scan):
        """Free and occupied cells of a scan, each once; occupied wins."""
        x, y, theta = pose
        free, occupied = set(), set()
        for z, bearing in scan:
            angle = theta + bearing
            hit, behind = (cell_of(x + d * math.cos(angle), y + d * math.sin(angle)) for d in (z, z + self.p.thickening_m))
            free |= line(cell_of(x, y), hit)
            occupied |= line(hit, behind)
        return free - occupied, occupied

    def draw(self, cells, seen):
        for kind, p in zip(seen, (self.p.p_free, self.p.p_occupied), strict=True):
            for cell in kind & cells.keys():
                cells[cell] += math.log(p / (1 - p)) - self.p.lam * self.prior[cell]  # eq. 6.2

    # --- algorithm 6.1
    def step(self, before, after, scan):
        self.move(before, after)
        self.way += math.hypot(after[0] - before[0], after[1] - before[1])
        moved = self.last is None or math.hypot(after[0] - self.last[0], after[1] - self.last[1]) >= self.p.weigh_every_m
        moved = moved or abs(wrap(after[2] - self.last[2])) >= self.p.weigh_every_theta
        weighs = bool(scan) and moved
        if weighs:
            self.weigh(scan)
            self.last, self.weighings = after, self.weighings + 1
        pose = self.estimate()
        if weighs and self.weighings % self.p.resampling_interval == 0:
            self.resample()
        seen = self.see(pose, scan)
        self.draw(self.map, seen)
        self.waiting.append((self.way, seen))
        while self.waiting and self.waiting[0][0] <= self.way - self.p.lag_m:
            self.draw(self.behind, self.waiting.pop(0)[1])
        return pose


def bin_of(x, y, theta):
    """Half a metre, half a metre, 10 degrees."""
    return math.floor(x / 0.5), math.floor(y / 0.5), math.floor((theta % (2 * math.pi)) * 18 / math.pi) % 36


def cell_of(x, y):
    return ROWS - 1 - math.floor(y / CELL_M), math.floor(x / CELL_M)


def line(start, end):
    """Bresenham's cells, from left to right."""
    (row, col), (last_row, last_col) = sorted([start, end], key=lambda cell: cell[1])
    n_cols, n_rows, down = last_col - col, abs(last_row - row), 1 if last_row > row else -1
    long, short = max(n_cols, n_rows), min(n_cols, n_rows)
    cells, error = {(row, col)}, long - 2 * short
    for _ in range(long):
        if error < 0:
            row, col, error = row + down, col + 1, error + 2 * long
        else:
            row, col = (row, col + 1) if n_cols >= n_rows else (row + down, col)
        error -= 2 * short
        cells.add((row, col))
    return cells


def room():
    """Four walls, a pillar and a stub, 4 x 3 m; three cells thick, so that their inside is not their boundary."""
    walls = np.zeros((ROWS, COLS), dtype=bool)
    walls[:3], walls[-3:], walls[:, :3], walls[:, -3:] = True, True, True, True
    walls[10:13, 17:22], walls[3:9, 28:31] = True, True
    return walls


def drive_round(rng, n_steps=16):
    """A drive round the pillar with ranges that fit no map in particular: the filters must agree, not find their way."""
    truth, odometry = [(0.8, 0.8, 0.0)], [(7.0, -3.0, 2.5)]
    for k in range(n_steps - 1):
        x, y, theta = truth[-1]
        step, turn = (0.0, 0.5) if k in (5, 6, 7) else (0.17, 0.05)
        truth.append((x + step * math.cos(theta), y + step * math.sin(theta), theta + turn))
        x, y, theta = odometry[-1]
        step, turn = step + rng.normal(0, 0.02), turn + rng.normal(0, 0.03)
        odometry.append((x + step * math.cos(theta), y + step * math.sin(theta), wrap(theta + turn)))
    ranges = rng.uniform(0.4, 2.5, (n_steps, len(BEARINGS)))
    ranges[rng.random(ranges.shape) < 0.2] = np.nan
    ranges[4] = np.inf
    scanner = Scanner(n_beams=len(BEARINGS), field_of_view=1.0)
    return RobotLog(np.array(odometry), ranges, np.array(BEARINGS), scanner, np.array(truth[0]), np.array(truth))


SMALL = {"particle_limits": (8, 40), "kld_epsilon": 0.4, "n_beams": 6, "max_distance_m": 0.8, "sigma_hit_m": 0.12, "temper": 0.4}
SETTINGS = {
    "tuned": replace(TUNED, **SMALL),
    "growing": replace(TUNED, **SMALL, localize_in="updated", lag_m=0.4, lam=0.3, start_variances=(0.003, 0.003, 0.01)),
    "broad": replace(
        TUNED, **SMALL, robot_radius_m=0.55, p_through_wall=0.3, start_variances=(0.03, 0.03, 0.1), weigh_every_m=0.5
    ),
    "printed": replace(TABLE_6_1, **SMALL | {"temper": 1.0}),
    "stubborn": replace(
        TUNED, **SMALL | {"particle_limits": (30, 30)}, resampling_interval=3, noise="std", lam=0.0, thickening_m=0.0
    ),
}


@pytest.mark.parametrize("name", SETTINGS)
@pytest.mark.parametrize("seed", [0, 1])
def test_fastslam_agrees_with_algorithm_6_1_in_plain_python(name, seed):
    parameters, log = SETTINGS[name], drive_round(np.random.default_rng(seed))
    walls = room()
    run = FastSLAM(parameters).run(
        GridMap(np.where(walls, WALL, FREE), Grid(walls.shape, 1, CELL_M)), log, np.random.default_rng(50 + seed)
    )
    cells = {(r, c): WALL if walls[r, c] else FREE for r in range(ROWS) for c in range(COLS)}
    slow = SlowFilter(cells, log.start.tolist(), parameters, np.random.default_rng(50 + seed))
    numbers = []
    for k, ranges in enumerate(log.ranges.tolist()):
        scan = [(z, bearing) for z, bearing in zip(ranges, BEARINGS, strict=True) if 0.4 <= z < 3.0]
        pose = slow.step(log.odometry[max(k - 1, 0)].tolist(), log.odometry[k].tolist(), scan)
        assert pose[:2] == pytest.approx(run.trajectory[k, :2], abs=1e-5)
        assert wrap(pose[2] - run.trajectory[k, 2]) == pytest.approx(0.0, abs=1e-5)
        numbers.append(len(slow.particles))
    assert len(set(numbers)) > 1 or name == "stubborn"  # KLD was at work
    assert slow.n_charged > 20 or name != "broad"  # walls were at work
    assert run.n_particles[1:].tolist() == numbers[:-1]
    for cell, value in slow.map.items():
        assert run.map.log_odds[cell] == pytest.approx(value, abs=1e-9)
    assert (run.map.log_odds != np.where(walls, WALL, FREE)).sum() > 100
