# SPDX-License-Identifier: BSD-3-Clause
"""Results for people: figures, from what the experiments gave."""

from forcetorque.report.compare import index_figure
from forcetorque.report.comparison import comparison_figure
from forcetorque.report.contacts import contact_figure
from forcetorque.report.differences import difference_figure
from forcetorque.report.excitation import excitation_figure
from forcetorque.report.force_space import force_space_figure
from forcetorque.report.gains import gain_figure
from forcetorque.report.held_out import held_out_figure
from forcetorque.report.lambda_difference import lambda_difference_figure
from forcetorque.report.lambda_force import lambda_force_figure
from forcetorque.report.residuals import residual_figure
from forcetorque.report.sphere import sphere_figure
from forcetorque.report.wrench_space import space_figure

__all__ = [
    "comparison_figure",
    "contact_figure",
    "difference_figure",
    "excitation_figure",
    "force_space_figure",
    "gain_figure",
    "held_out_figure",
    "index_figure",
    "lambda_difference_figure",
    "lambda_force_figure",
    "residual_figure",
    "space_figure",
    "sphere_figure",
]
