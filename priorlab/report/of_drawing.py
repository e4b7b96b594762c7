"""Sections of chapter 3: the drawing, its doors and walls."""

from __future__ import annotations

from priorlab import plot
from priorlab.pipeline import PipelineResult
from priorlab.plot.extraction import LEGEND
from priorlab.report.pictures import picture, size_for
from priorlab.report.section import Section, percent, score_table


def drawing_section(result: PipelineResult) -> Section:
    """What came in."""
    drawing, (height, width) = result.drawing, result.drawing.shape
    reduced: tuple[str, ...] = ()
    if drawing.reduced_by > 1:
        reduced = (
            f"The image was larger than 16 megapixels and was reduced by {drawing.reduced_by:.2f}; pixels here are the "
            f"reduced ones.",
        )
    return Section(
        "The drawing",
        (
            f"An image of {width} x {height} pixels{'' if result.plan else '; nothing else is known of the building'}. "
            f"Scale: {result.scale.sentence}.",
            *reduced,
        ),
        (
            picture(
                lambda ax: plot.drawing(drawing, ax),
                f"The drawing {drawing.name}, {width} by {height} pixels, as it came.",
                "The drawing as it came.",
                size_for(drawing.shape),
                wide=True,
            ),
        ),
    )


def walls_section(result: PipelineResult) -> Section:
    """Chapter 3."""
    extraction, drawing, score = result.extraction, result.drawing, result.walls_score
    size = size_for(drawing.shape)
    n_corners, n_doors, share = len(extraction.corners), len(extraction.doors), 100 * result.walls.mask.mean()
    truth = None if result.plan is None else result.plan.truth
    judged = "" if score is None else f" Precision {percent(score.precision)}, recall {percent(score.recall)}."
    pictures = [
        picture(
            lambda ax: plot.doors(extraction.doors, drawing, ax, title=""),
            f"The drawing, faint, with {n_doors} doors marked as triangles.",
            f"{n_corners} corners, {n_doors} doors. A door is a triangle: two jambs (dashed: the open side) and the tip of "
            f"the leaf (dot).",
            size,
        ),
        picture(
            lambda ax: plot.walls(result.walls, truth, ax, title=""),
            f"The extracted walls, {share:.1f} percent of the pixels.{judged}",
            f"The walls. {LEGEND.capitalize()}." if truth is not None else "The extracted walls.",
            size,
        ),
    ]
    if extraction.funnel:
        last = ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in list(extraction.funnel.items())[-3:])
        pictures.append(
            picture(
                lambda ax: plot.funnel(extraction.funnel, extraction.lost_at, ax, title=""),
                f"Bars: how many candidates each of {len(extraction.funnel)} tests leaves; the last ones leave {last}.",
                "The funnel of tests, from the first to the last.",
                (6.4, 0.32 * len(extraction.funnel) + 0.9),
            )
        )
    doors = "both jambs of a door stand on a wall, and from the jambs runs of dark pixels are followed along both axes"
    text = [
        f"Two things give walls away. Doors: {doors}. Line weight: walls are drawn heavier than the rest. The better proposal is "
        f"taken. Method: {result.method.name}."
        if result.method.sources == "both"
        else f"Doors give walls away: {doors}. Method: {result.method.name}.",
        *extraction.notes,
    ]
    if score is None and result.has_walls:
        text.append("No truth is known for this drawing, so no score can be given: look at the picture.")
    tables = (
        ()
        if score is None
        else (score_table({"extracted walls": score}, "Pixel by pixel against the exact walls of the building"),)
    )
    return Section("Doors and walls", tuple(text), tuple(pictures), tables)
