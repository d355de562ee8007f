# SPDX-License-Identifier: BSD-3-Clause
"""Results for people: figures, from what the experiments gave."""

from forcetorque.report.figures import force_space_figure, gain_figure

__all__ = ["force_space_figure", "gain_figure"]
