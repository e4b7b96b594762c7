"""The report: one HTML page that holds everything, pictures included, and opens without a network."""

from priorlab.report.numbers import numbers_of
from priorlab.report.page import render_report, write_report

__all__ = ["numbers_of", "render_report", "write_report"]
