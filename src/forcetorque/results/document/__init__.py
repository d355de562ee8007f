# SPDX-License-Identifier: BSD-3-Clause
"""Documents: headings, verdicts, tables and figures, written as one HTML file or as PDF."""
