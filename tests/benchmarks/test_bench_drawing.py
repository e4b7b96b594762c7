"""Walls from drawings of two sizes, time and memory; the graph search against all triples; walks in step against one by one."""

import itertools
import math
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from priorlab.buildings.description import read_description
from priorlab.buildings.floor_plans import draw_plan
from priorlab.core.drawing import Drawing
from priorlab.core.shipped import data_folder
from priorlab.drawing.candidates import literal_triples, wedges
from priorlab.drawing.connectivity import connect, walk, walk_all
from priorlab.drawing.corners import corners_of
from priorlab.drawing.doors import walkable
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.drawing.preprocessing import prepare

SIZES = {(560, 900): "office_section_a", (2000, 2500): "office_wing"}
AIMS_S = {("THESIS", 560): 1, ("ROBUST", 560): 3, ("ROBUST", 2000): 15}

MEASURE_MEMORY = """
import re, sys, time
import numpy as np
from priorlab.core.drawing import Drawing
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import ROBUST, THESIS
peak = lambda: int(re.search("VmHWM:\\s*([0-9]+) kB", open("/proc/self/status").read())[1])
grey = np.load(sys.argv[1])
before, start = peak(), time.perf_counter()
extract_walls(Drawing(grey), {"THESIS": THESIS, "ROBUST": ROBUST}[sys.argv[2]])
print(before / 1024, peak() / 1024, time.perf_counter() - start)
"""


def seconds(work, repeats=1):
    """Least time of a call (the machine is shared), and what it returned."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        times.append(time.perf_counter() - start)
    return min(times), result


def drawn(name, shape):
    """A bundled building as large as fits, finer lines and all, on a white sheet of this shape."""
    description = read_description(data_folder() / f"{name}.toml")
    height, width = draw_plan(description)[0].shape
    finer = min(shape[0] / height, shape[1] / width) * 0.999
    lines = {key: replace(style, line=style.line * finer) for key, style in description.styles.items()}
    sheet = replace(description.sheet, line=description.sheet.line * finer)
    scale = description.metres_per_pixel / finer
    drawing, _ = draw_plan(replace(description, metres_per_pixel=scale, styles=lines, sheet=sheet))
    grey = np.full(shape, 255, np.uint8)
    grey[: drawing.shape[0], : drawing.shape[1]] = drawing.grey
    return Drawing(grey, name=name)


def memory_mb(drawing, method, folder):
    """Peak memory of a process of its own before and after a drawing is read, and the seconds; nan where nothing tells."""
    if not Path("/proc/self/status").is_file():
        return math.nan, math.nan, math.nan
    file = folder / "drawing.npy"
    np.save(file, drawing.grey)
    run = [sys.executable, "-c", MEASURE_MEMORY, str(file), method]
    printed = subprocess.run(run, capture_output=True, check=True, text=True).stdout
    return [float(number) for number in printed.split()]


def by_graph(connected):
    """Only wedges of two connected sides whose third side is open."""
    found = wedges(connected)
    return found[~connected[found[:, 1], found[:, 2]]]


def as_set(triples):
    """Triples, in whatever order they were found."""
    return set(map(tuple, triples.tolist()))


@pytest.fixture(scope="module")
def large():
    return drawn(SIZES[2000, 2500], (2000, 2500))


def test_bench_extraction(tmp_path, large):
    print(f"\n{'Walls from a drawing':<34}{'s':>8}{'aim, s':>8}{'peak, MB':>10}{'of it for the walls, MB':>25}")
    for shape, name in SIZES.items():
        drawing = large if shape[0] == 2000 else drawn(name, shape)
        for method in (THESIS, ROBUST):
            took, found = seconds(
                lambda drawing=drawing, method=method: extract_walls(drawing, method), 3 if shape[0] < 2000 else 1
            )
            before, after, _ = memory_mb(drawing, method.name, tmp_path)
            peak, grown = f"{after:.0f}", f"{after - before:.0f}"
            assert not after >= 1024
            aim = AIMS_S.get((method.name, shape[0]), "")
            title = f"{method.name}, {shape[0]:,} x {shape[1]:,} px, {len(found.doors)} doors"
            print(f"  {title:<32}{took:>8.2f}{aim:>8}{peak:>10}{grown:>25}")
            assert found.walls.mask.any()


def test_bench_patterns(tmp_path):
    """Every corner is connected with hundreds of others: what is no drawing must neither fill the memory nor take for ever."""
    y, x = np.mgrid[:700, :800]
    patterns = {
        "graph paper": (x % 10 == 0) | (y % 10 == 0),
        "crossed diagonals": ((x + y) % 12 == 0) | ((x - y) % 12 == 0),
        "stripes": (x + y) % 10 == 0,
    }
    print(f"\n{'700 x 800 px of a pattern':<30}{'time, s':>9}{'peak, MB':>10}")
    for name, ink in patterns.items():
        _, peak, took = memory_mb(Drawing(np.where(ink, 0, 255).astype(np.uint8)), "ROBUST", tmp_path)
        print(f"  {name:<28}{took:>9.1f}{peak:>10.0f}")
        assert not peak >= 1024


def test_bench_graph_against_triples(large):
    sheet = prepare(large, replace(THESIS, corner_quality=1e-4))
    longest = THESIS.max_side_share * np.sqrt(sheet.lines.size) * np.sqrt(2)
    ink = walkable(sheet, THESIS)
    titles = ("triples", "wedges", "connect, s", "graph, s", "triples, s", "times")
    print(f"\n{'Candidates for doors':<20}" + "".join(f"{title:>13}" for title in titles))
    few = 200  # the loop over all triples is timed among so many corners: at 1,000 it takes minutes
    for n in (200, 500, 1000):
        corners = corners_of(sheet, n, replace(THESIS, corner_quality=1e-4))
        assert len(corners) == n
        connecting, connected = seconds(lambda corners=corners: connect(ink, corners, THESIS.min_side / 2, longest, THESIS.reach))
        graph, found = seconds(lambda connected=connected: by_graph(connected), 3)
        part = connected[:few, :few]
        literal, some = seconds(lambda part=part: literal_triples(part))
        assert as_set(some) == as_set(found[(found < few).all(axis=1)])
        literal *= math.comb(n, 3) / math.comb(few, 3)
        counts = f"{math.comb(n, 3):>13,}{len(wedges(connected)):>13,}"
        times = f"{connecting:>13.2f}{graph:>13.4f}{literal:>13.1f}{literal / graph:>13,.0f}"
        print(f"{n:>8} corners    {counts}{times}" + (f"   from {few} of the corners" if n > few else ""))


def test_bench_walks_in_step(large):
    sheet = prepare(large, THESIS)
    corners = corners_of(sheet, 200, THESIS)
    pairs = np.array(list(itertools.permutations(range(len(corners)), 2)))
    rng = np.random.default_rng(0)
    origins, goals = (np.rint(corners[some]).astype(int) for some in pairs[rng.permutation(len(pairs))].T)
    in_step, reached = seconds(lambda: walk_all(sheet.lines, origins, goals, THESIS.reach), 3)
    few = 400
    walks = zip(origins[:few].tolist(), goals[:few].tolist(), strict=True)
    one_by_one, some = seconds(lambda: [walk(sheet.lines, tuple(a), tuple(b), THESIS.reach).reached for a, b in walks])
    np.testing.assert_array_equal(reached[:few], some)
    one_by_one *= len(pairs) / few
    print(
        f"\n{len(pairs):,} walks between 200 corners, 2,000 x 2,500 px: in step {in_step:.2f} s, "
        f"one by one {one_by_one:.1f} s (from {few}), {one_by_one / in_step:.0f} times"
    )
