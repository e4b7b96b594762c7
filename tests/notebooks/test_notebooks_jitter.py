"""What the notebooks of chapter 6 print does not hang on the last digits of the particles' weights."""

import pytest

pytestmark = pytest.mark.mutant

RIGHT = "        return weights / weights.sum()\n"
JITTERED = """        noise = np.random.default_rng(len(weights)).uniform(-1.0, 1.0, len(weights))
        weights = weights * (1.0 + {size:g} * noise)
        return weights / weights.sum()
"""
JITTERS = [("08_localization", 1e-12, 0), ("08_localization", 1e-2, 1), ("09_fastslam", 1e-12, 0)]


@pytest.mark.parametrize(("stem", "size", "code"), JITTERS)
def test_notebook_survives_a_jitter_of_the_weights(stem, size, code, run_changed):
    done, _ = run_changed(stem, "slam/particles.py", RIGHT, JITTERED.format(size=size))
    assert done.returncode == code, done.stdout  # and a jitter of 1 % is noticed: the patch does arrive
