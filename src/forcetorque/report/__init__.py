# SPDX-License-Identifier: BSD-3-Clause
"""Results for people: the report on sensors as one document, and the figures that it and others show."""

from forcetorque.report.result import Report, report, require_writable
from forcetorque.report.sources import ReportSources, assign_calibrations, sort_sources
from forcetorque.report.study_folder import write_study_folder
from forcetorque.report.viewer_section import viewer_section

__all__ = [
    "Report",
    "ReportSources",
    "assign_calibrations",
    "report",
    "require_writable",
    "sort_sources",
    "viewer_section",
    "write_study_folder",
]
