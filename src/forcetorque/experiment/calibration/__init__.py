# SPDX-License-Identifier: BSD-3-Clause
"""The `Calibration` artefact, the sensor model in it, and what a fit needs of a recording."""
