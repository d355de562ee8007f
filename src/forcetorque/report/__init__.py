# SPDX-License-Identifier: BSD-3-Clause
"""Results for people: figures, from what the experiments gave."""

from forcetorque.report.figures import gain_figure

__all__ = ["gain_figure"]
