"""The page: sections and numbers put into the template, written in one step."""

from __future__ import annotations

import importlib.metadata
import platform
from pathlib import Path

import jinja2

from priorlab.core.files import write_file
from priorlab.pipeline import PipelineResult
from priorlab.report.sections import sections_of

PACKAGES = ("priorlab", "numpy", "opencv-python-headless", "matplotlib", "pymoo", "scikit-learn")


def render_report(result: PipelineResult, command: str) -> str:
    """The report as HTML: no foreign address, every picture inside.

    Parameters
    ----------
    result : of `run_pipeline`
    command : the command line that made it, printed at the end
    """
    templates = jinja2.Environment(
        loader=jinja2.PackageLoader("priorlab.report", "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return templates.get_template("page.html").render(
        result=result,
        sections=sections_of(result),
        headline=headline(result),
        command=command,
        versions=versions(),
    )


def write_report(result: PipelineResult, path: str | Path, command: str) -> None:
    """Write the report to `path` in one step."""
    write_file(path, render_report(result, command))


def headline(result: PipelineResult) -> list[tuple[str, str]]:
    """The few numbers that matter, each with what it is."""
    cards = [(str(len(result.extraction.doors)), "doors found")]
    if result.walls_score is not None:
        cards.append(
            (f"{100 * result.walls_score.precision:.1f} / {100 * result.walls_score.recall:.1f} %", "walls: precision / recall")
        )
    else:
        cards.append((f"{100 * result.walls.mask.mean():.1f} %", "of the pixels are wall"))
    mapping, drive = result.mapping, result.drive
    if mapping is not None and mapping.score_informed is not None and mapping.score_uninformed is not None:
        cards.append(
            (
                f"{mapping.score_uninformed.f_beta:.2f} \u2192 {mapping.score_informed.f_beta:.2f}",
                "F2 of the map: without \u2192 with the plan"
                + (f" (the plan alone: {mapping.score_prior.f_beta:.2f})" if mapping.score_prior else ""),
            )
        )
    elif mapping is not None:
        cards.append((f"{100 * mapping.evidence.seen.mean():.0f} %", "of the cells seen by the survey"))
    if drive is not None:
        cards.append((f"{drive.run.ate_m(drive.log):.2f} m", "FastSLAM: error of the way (ATE)"))
    return cards


def versions() -> list[tuple[str, str]]:
    """Python and the packages that made the numbers."""
    return [("Python", platform.python_version()), *((name, importlib.metadata.version(name)) for name in PACKAGES)]
