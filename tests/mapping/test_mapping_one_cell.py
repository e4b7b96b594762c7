"""One cell on its own agrees with Bayes' rule worked out with plain odds."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.sensor import RangeSensor
from priorlab.mapping.one_cell import one_cell_evidence, one_cell_map
from priorlab.mapping.update import update_map


@settings(max_examples=60, deadline=None)
@given(seen=st.lists(st.booleans(), max_size=12), p=st.floats(0.02, 0.98))
def test_one_cell_equals_products_of_odds(seen, p):
    odds = p / (1 - p)
    for free in seen:
        odds *= 0.8 / 0.2 if free else 0.3 / 0.7
    sensor = RangeSensor(p_free=0.8, p_occupied=0.3)
    end = update_map(one_cell_map(p), one_cell_evidence(seen, sensor), lam=0.0)
    assert end.p_empty.item() == pytest.approx(odds / (1 + odds), abs=1e-12)


def test_one_cell_without_readings_keeps_its_prior():
    evidence = one_cell_evidence([])
    assert evidence.looks.item() == 0 and evidence.total.item() == 0.0
    assert update_map(one_cell_map(0.3), evidence).p_empty.item() == pytest.approx(0.3, abs=1e-15)


def test_one_cell_map_certain_is_told():
    with pytest.raises(ValueError, match="p_empty must lie strictly between 0 and 1, got 1"):
        one_cell_map(1)
