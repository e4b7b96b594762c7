"""The update one reading at a time: where the robot stands, which cells it touches, and what that does to one of them."""

from __future__ import annotations

import cv2
import ipywidgets
import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import log_odds
from priorlab.core.picture import grey_of
from priorlab.core.readings import Readings
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.recursion import cells_seen, one_step
from priorlab.mapping.update import update_map
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider
from priorlab.widgets.track import track_svg

FREE, WALL, ROBOT, WATCHED = (0, 114, 178), (230, 159, 0), (0, 0, 0), (204, 0, 120)


class UpdateSteps(Lab):
    """Step with the buttons or with `lab.step()`; read `lab.map`, `lab.track`, `lab.log_odds` of the watched cell.

    Parameters
    ----------
    prior_map : where every cell starts
    readings : from poses on the same drawing, in the order in which they were taken
    cell : (row, col) of the cell to watch; row 0 at the top
    lam : as in `update_map`
    width : of the map on the screen, CSS pixels
    """

    def __init__(
        self, prior_map: GridMap, readings: Readings, cell: tuple[int, int] = (0, 0), lam: float = 1.0, width: int = 390
    ) -> None:
        rows, cols = prior_map.grid.shape
        self._prior_map, self._readings = prior_map, readings
        self._seen = [{(row, col): p for row, col, p in cells_seen(readings, k, prior_map.grid)} for k in range(len(readings))]
        self.k = Slider("readings used", 0, 0, len(readings), 1, "how many readings the map holds")
        self.row = Slider("watched row", cell[0], 0, rows - 1, 1, "row of the watched cell, 0 at the top")
        self.col = Slider("watched column", cell[1], 0, cols - 1, 1, "column of the watched cell, 0 at the left")
        self.lam = Slider("lam", lam, 0, 1, 0.05, "1: the thesis's update takes l0 off at every reading; 0: never")
        ahead = ipywidgets.Button(description="next reading", button_style="primary", layout=ipywidgets.Layout(width="auto"))
        back = ipywidgets.Button(description="one back", layout=ipywidgets.Layout(width="auto"))
        ahead.on_click(lambda _: self.step(1))
        back.on_click(lambda _: self.step(-1))
        presets = {"no reading": {"k": 0}, "all readings": {"k": len(readings)}}
        sliders = {"k": self.k, "row": self.row, "col": self.col, "lam": self.lam}
        super().__init__(sliders, presets, [Picture(width=width), Picture(width=430)], [back, ahead])

    def step(self, by: int = 1) -> None:
        """Take the next reading in (or, with -1, the last one out); at the ends nothing happens."""
        self.k.value = float(np.clip(self.k.value + by, 0, len(self._readings)))

    def refresh(self) -> None:
        """The map in closed form, the watched cell by the recursion."""
        k, lam, cell = int(self.k.value), self.lam.value, (int(self.row.value), int(self.col.value))
        grid = self._prior_map.grid
        self.map = update_map(self._prior_map, gather_evidence(self._readings[:k], grid), lam=lam)
        l_0 = float(self._prior_map.log_odds[cell])
        steps, other, seen_free = [l_0], [l_0], []
        for p_empty in (seen[cell] for seen in self._seen[:k] if cell in seen):
            steps.append(one_step(steps[-1], l_0, p_empty, lam))
            other.append(one_step(other[-1], l_0, p_empty, 0.0))
            seen_free.append(p_empty > 0.5)
        self.track, self.log_odds = steps, steps[-1]

        p_now = self._seen[k - 1].get(cell) if k else None
        if p_now is None:
            equation = "not seen by this reading: l stays"
        else:
            ism = float(log_odds(p_now))
            equation = f"{ism:.3f} + {steps[-2]:.3f} - {lam:g} x {l_0:.3f} = <b>{steps[-1]:.3f}</b>"
        rows = [
            ("reading", f"{k} of {len(self._readings)}"),
            ("cells that it saw", f"{len(self._seen[k - 1]) if k else 0}"),
            (f"watched cell {cell}: l<sub>0</sub>", f"{l_0:.3f}"),
            ("logit(ISM) + l<sub>k-1</sub> - lam l<sub>0</sub>", equation),
            ("closed form, the same", f"{self.map.log_odds[cell]:.3f}"),
            ("P(empty)", f"{self.map.p_empty[cell]:.3f}"),
        ]
        self.readout.value = table(rows)
        self.pictures[0].show(
            self._paint(k, cell), f"The map after {self.summary()}. Blue: just seen free, orange: just seen as wall."
        )
        self.pictures[1].show_svg(
            track_svg(steps, seen_free, other), f"Log odds of cell {cell} over its {len(seen_free)} readings, now {steps[-1]:.2f}"
        )

    def summary(self) -> str:
        """How far, and where the watched cell stands."""
        cell = (int(self.row.value), int(self.col.value))
        return (
            f"reading {self.k.value:.0f} of {len(self._readings)}, cell {cell} seen {len(self.track) - 1} times: "
            f"l = {self.log_odds:.3f}, P(empty) = {self.map.p_empty[cell]:.3f}"
        )

    def _paint(self, k: int, cell: tuple[int, int]) -> NDArray[np.uint8]:
        """The map in large cells, what the last reading touched, the robot, the watched cell."""
        grid = self._prior_map.grid
        zoom = max(2, 800 // grid.shape[1])
        colours = np.repeat(grey_of(self.map.p_empty)[..., None], 3, axis=2)
        for at, p_empty in (self._seen[k - 1] if k else {}).items():
            colours[at] = (colours[at].astype(int) + 2 * np.array(FREE if p_empty > 0.5 else WALL)) // 3
        picture = np.ascontiguousarray(colours.repeat(zoom, axis=0).repeat(zoom, axis=1))
        row, col = cell
        corner, opposite = (col * zoom, row * zoom), ((col + 1) * zoom, (row + 1) * zoom)
        cv2.rectangle(picture, corner, opposite, WATCHED, max(2, zoom // 6))
        if k:
            x, y, theta = self._readings.poses[k - 1]
            centre = np.array([x / grid.cell_size, grid.shape[0] - y / grid.cell_size]) * zoom
            turn = theta + np.array([0.0, 2.6, -2.6])
            corners = centre + 1.1 * zoom * np.column_stack([np.cos(turn), -np.sin(turn)])
            cv2.fillPoly(picture, [np.rint(corners).astype(np.int32)], ROBOT, cv2.LINE_AA)
        return picture
