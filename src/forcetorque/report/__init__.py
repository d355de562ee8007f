# SPDX-License-Identifier: BSD-3-Clause
"""Results for people: the report on sensors as one document, and the figures that it and others show."""

# TEMP from forcetorque.report.result import Report, report, require_writable
# TEMP from forcetorque.report.sources import ReportSources, assign_calibrations, sort_sources
# TEMP from forcetorque.report.viewer_section import viewer_section

# TEMP __all__ = [
# TEMP     "Report",
# TEMP     "ReportSources",
# TEMP     "assign_calibrations",
# TEMP     "report",
# TEMP     "require_writable",
# TEMP     "sort_sources",
# TEMP     "viewer_section",
# TEMP ]
