# SPDX-License-Identifier: BSD-3-Clause
"""Figures of results, as PNG."""

from forcetorque.report.figures.balance import balance_figure
from forcetorque.report.figures.bench import bench_figure
from forcetorque.report.figures.coherence import coherence_figure
from forcetorque.report.figures.compare import index_figure
from forcetorque.report.figures.comparison import comparison_figure
from forcetorque.report.figures.contacts import contact_figure
from forcetorque.report.figures.contest import contest_figure
from forcetorque.report.figures.device import device_figure
from forcetorque.report.figures.device_envelope import envelope_figure
from forcetorque.report.figures.device_errors import reference_error_figure
from forcetorque.report.figures.differences import difference_figure
from forcetorque.report.figures.excitation import excitation_figure
from forcetorque.report.figures.force_space import force_space_figure
from forcetorque.report.figures.gains import gain_figure
from forcetorque.report.figures.held_out import held_out_figure
from forcetorque.report.figures.joint import joint_figure
from forcetorque.report.figures.lambda_difference import lambda_difference_figure
from forcetorque.report.figures.lambda_force import lambda_force_figure
from forcetorque.report.figures.learnt import learnt_figure
from forcetorque.report.figures.motion import motion_figure
from forcetorque.report.figures.remedies import remedies_figure
from forcetorque.report.figures.residuals import residual_figure
from forcetorque.report.figures.response import response_figure
from forcetorque.report.figures.skin_events import skin_event_figure
from forcetorque.report.figures.skin_layout import skin_layout_figure
from forcetorque.report.figures.skin_wrench import skin_wrench_figure
from forcetorque.report.figures.sphere import sphere_figure
from forcetorque.report.figures.taxels import taxel_figure
from forcetorque.report.figures.thermal import thermal_figure
from forcetorque.report.figures.torque_loop import torque_loop_figure
from forcetorque.report.figures.torques import torque_figure
from forcetorque.report.figures.uses import use_figure
from forcetorque.report.figures.wrench_space import space_figure

__all__ = [
    "balance_figure",
    "bench_figure",
    "coherence_figure",
    "comparison_figure",
    "contact_figure",
    "device_figure",
    "contest_figure",
    "difference_figure",
    "envelope_figure",
    "excitation_figure",
    "force_space_figure",
    "gain_figure",
    "held_out_figure",
    "index_figure",
    "joint_figure",
    "lambda_difference_figure",
    "lambda_force_figure",
    "learnt_figure",
    "motion_figure",
    "reference_error_figure",
    "remedies_figure",
    "residual_figure",
    "skin_event_figure",
    "skin_layout_figure",
    "skin_wrench_figure",
    "space_figure",
    "sphere_figure",
    "taxel_figure",
    "response_figure",
    "thermal_figure",
    "torque_figure",
    "torque_loop_figure",
    "use_figure",
]
