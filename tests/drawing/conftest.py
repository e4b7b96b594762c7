"""Small drawings made by hand: every line of them is known."""

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Door, Drawing


class OneDoorRoom:
    """A house of two rooms with filled walls of 8 px and one door of 50 px between them."""

    jambs = ((150.0, 196.0), (200.0, 196.0))
    tip = (150.0, 246.0)

    def __init__(self) -> None:
        grey = np.full((400, 500), 255, dtype=np.uint8)
        walls = np.zeros_like(grey)
        cv2.rectangle(walls, (50, 50), (449, 349), 255, -1)
        walls[58:190, 58:442] = 0
        walls[198:342, 58:442] = 0
        walls[190:198, 151:200] = 0  # the opening
        self.walls = walls > 0
        grey[self.walls] = 0
        cv2.line(grey, (150, 198), (150, 246), 0, 1)  # leaf
        cv2.ellipse(grey, (150, 197), (49, 49), 0, 0, 90, 0, 1)  # swing
        cv2.putText(grey, "KITCHEN 12", (230, 140), cv2.FONT_HERSHEY_SIMPLEX, 0.7, 0, 2)
        self.text = np.zeros_like(self.walls)
        self.text[115:150, 225:400] = True
        self.grey = grey

    @property
    def drawing(self) -> Drawing:
        return Drawing(self.grey, name="one door")

    @property
    def door(self) -> Door:
        return Door(hinge=self.jambs[0], strike=self.jambs[1], tip=self.tip)


@pytest.fixture(scope="session")
def room() -> OneDoorRoom:
    return OneDoorRoom()
