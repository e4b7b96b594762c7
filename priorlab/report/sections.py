"""The sections that a result has, in the order of the way."""

from __future__ import annotations

from priorlab.pipeline import PipelineResult
from priorlab.report.of_drawing import drawing_section, walls_section
from priorlab.report.of_drive import drive_section
from priorlab.report.of_mapping import posterior_section, prior_section, survey_section
from priorlab.report.of_search import search_section
from priorlab.report.section import Section


def sections_of(result: PipelineResult) -> list[Section]:
    """The sections that this result has."""
    sections = [drawing_section(result), walls_section(result)]
    if result.prior_map is not None:
        sections.append(prior_section(result, result.prior_map))
    if result.mapping is not None:
        sections += [survey_section(result, result.mapping), posterior_section(result, result.mapping)]
    if result.search is not None and result.mapping is not None:
        sections.append(search_section(result, result.search))
    if result.drive is not None:
        sections.append(drive_section(result, result.drive))
    return sections
