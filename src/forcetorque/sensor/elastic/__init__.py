# SPDX-License-Identifier: BSD-3-Clause
"""From load to strain: Hooke's law, sections, beams, and elements made of beams (thesis 1.2)."""
