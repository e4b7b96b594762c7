"""Every threshold of chapter 3 in one frozen record, and two of them: as the thesis has it, and as good as we can."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Method:
    """How walls are extracted. The defaults are the thesis's numbers; `M` is the long side of the drawing.

    Parameters
    ----------
    name : what reports call it
    sources : what walls are found by: "doors" (3.3.1) or "both", line weight and doors together
    n_corners : Harris corners to keep (fig. 3.9: 200)
    tiles : n x n tiles, each with corners of its own: divide and conquer (3.4.2)
    corner_quality : weakest corner kept, as a share of the strongest response
    corner_spacing, corner_spacing_share : corners nearer than this are one, pixels, or share of M where that is more
    component_share : corners and line weights only on ink components longer than this share of M; 0 takes all ink
    cell_share : corners not inside cells where a disc of this share of M has no room: hatching, panes; 0 looks there too
    line_darkness : distance from the paper above which a pixel is ink of a line (0-255)
    wall_darkness : the same for walls; None takes Otsu's threshold
    deskew : a sheet laid askew is turned straight first, and wide margins are cut off
    upscale_below : drawings with a shorter long side are doubled first; 0 never
    min_side, max_side_share : shortest side of a door in pixels, longest as a share of the root of the sheet's area
    thin_share : ink thicker than this share of M is no leaf and no arc, and walks do not cross it; 0 lets them
    reach : snap to ink and arrive within so many pixels (algorithm 3.1)
    rounding : compare sides in whole pixels (eq. 3.4)
    isosceles_ratio : two sides are equal above this ratio (eq. 3.5)
    min_largest_angle, max_largest_angle : bounds of the largest angle, degrees (3.3.1)
    min_angle : smallest angle allowed, degrees; 0 lets needles pass, as the text does
    max_tilt : the open side lies within so many degrees of an axis (eq. 3.15); 45 allows all
    wings : an open side in line with the walls at both its jambs may lie at any angle
    min_leaf, min_arc, min_support : shares of ink along the leaf, along its arc (or chord), and beyond each jamb; 0 asks for none
    min_equal : shorter over longer of leaf and open side; 0 asks for nothing
    min_arc_angle : a leaf with an arc is drawn open by so many degrees; flatter arcs cannot be told from lines
    max_chord : share of ink allowed along the straight line below an arc; 1 asks for nothing
    max_beyond : share of ink allowed where leaf or arc would go on beyond the tip; 1 asks for nothing
    lone_leaves : one drawn side is enough: a leaf without an arc, or with a broken one
    folding : rows of two equal folds along an opening are doors too
    max_open_ink : share of ink allowed on the open side; 1 asks for nothing
    max_dark : share of ink allowed inside the triangle (3.3.1: 40 %)
    max_overlap : share of the smaller triangle that two doors may have in common (3.3.1: 30 %)
    keep_best : of overlapping doors keep the best, not the first
    size_mode_factor : open sides stay within this factor of the commonest; None keeps all
    one_kind : where three doors have an arc, candidates without one are dropped: furniture is full of straight triangles
    drop_on_outer_walls : doors with a vertex on an outer wall are dropped (3.3.1, third check)
    outer_tolerance : corners within so many pixels of the extreme one vote for it (eq. 3.11)
    measure_jambs : hinge and strike are moved to the ends of the white opening between them
    n_sweeps : sweeps of the wall search after the jambs (3.3.1: h, v, h, v)
    strip_share : strokes thinner than this share of the wall's own thickness are taken off after the sweeps; 0 keeps all
    bridge_widths : windows of at most so many door widths between two wall pieces are wall; 0 bridges none
    """

    name: str = "THESIS"
    sources: Literal["doors", "both"] = "doors"
    n_corners: int = 200
    tiles: int = 1
    corner_quality: float = 0.01
    corner_spacing: float = 3.0
    corner_spacing_share: float = 0.0
    component_share: float = 0.0
    cell_share: float = 0.0
    line_darkness: int = 127
    wall_darkness: int | None = 127
    deskew: bool = False
    upscale_below: int = 0
    min_side: float = 8.0
    max_side_share: float = 0.25
    thin_share: float = 0.0
    reach: int = 2
    rounding: bool = True
    isosceles_ratio: float = 0.9
    min_largest_angle: float = 60.0
    max_largest_angle: float = 100.0
    min_angle: float = 0.0
    max_tilt: float = 45.0
    wings: bool = False
    min_leaf: float = 0.0
    min_arc: float = 0.0
    min_support: float = 0.0
    min_equal: float = 0.0
    min_arc_angle: float = 0.0
    max_chord: float = 1.0
    max_beyond: float = 1.0
    lone_leaves: bool = False
    folding: bool = False
    max_open_ink: float = 1.0
    max_dark: float = 0.40
    max_overlap: float = 0.30
    keep_best: bool = False
    size_mode_factor: float | None = None
    one_kind: bool = False
    drop_on_outer_walls: bool = True
    outer_tolerance: float = 2.0
    measure_jambs: bool = False
    n_sweeps: int = 4
    strip_share: float = 0.0
    bridge_widths: float = 0.0

    def __post_init__(self) -> None:
        for name in ("n_corners", "tiles", "min_side", "max_side_share", "isosceles_ratio"):
            if not getattr(self, name) > 0:
                raise ValueError(f"{name} must be above 0, got {getattr(self, name)}")
        if self.sources not in ("doors", "both"):
            raise ValueError(f"sources must be 'doors' or 'both', got {self.sources!r}")


THESIS = Method()
"""The text as we read it: 200 corners, its tests in its order, walls found from doors alone."""

ROBUST = Method(
    name="ROBUST",
    sources="both",
    n_corners=1600,
    corner_quality=0.003,
    corner_spacing_share=0.003,
    component_share=0.04,
    cell_share=0.01,
    line_darkness=55,
    wall_darkness=None,
    deskew=True,
    upscale_below=400,
    min_side=12.0,
    max_side_share=0.13,
    thin_share=0.006,
    rounding=False,
    isosceles_ratio=0.82,
    max_largest_angle=105.0,
    min_angle=25.0,
    max_tilt=12.0,
    wings=True,
    min_leaf=0.8,
    min_arc=0.85,
    min_support=0.75,
    min_equal=0.75,
    min_arc_angle=50.0,
    max_chord=0.35,
    max_beyond=0.6,
    lone_leaves=True,
    folding=True,
    max_open_ink=0.11,
    keep_best=True,
    size_mode_factor=1.5,
    one_kind=True,
    drop_on_outer_walls=False,
    measure_jambs=True,
    strip_share=0.5,
    bridge_widths=3.0,
)
"""Doors and line weight, each correcting the other."""
