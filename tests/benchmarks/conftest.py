"""The building and the survey that the benchmarks of chapter 4 share: 600 x 800 pixels, 1,600 poses."""

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.survey import look_around

HEIGHT, WIDTH, POSES = 600, 800, 1600


@pytest.fixture(scope="session")
def survey():
    """Rooms of 100 px with doors of 30 px, and 1,600 poses that look around in them."""
    walls = np.zeros((HEIGHT, WIDTH), dtype=bool)
    segments = []
    for top in range(0, HEIGHT, 100):
        for left in range(0, WIDTH, 100):
            walls[top : top + 4, left : left + 100] = walls[top : top + 100, left : left + 4] = True
            walls[top : top + 4, left + 35 : left + 65] = walls[top + 35 : top + 65, left : left + 4] = False
            for y in (25.5, 55.5, 85.5):
                segments.append(((left + 12.5, HEIGHT - top - y), (left + 92.5, HEIGHT - top - y)))
    poses = look_around(segments, spacing=6.5)
    poses = poses[np.linspace(0, len(poses) - 1, POSES).astype(int)]
    return Truth(walls, walls & False), poses
