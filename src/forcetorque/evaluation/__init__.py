# SPDX-License-Identifier: BSD-3-Clause
"""How far a calibration can be trusted, on motions that were not fitted."""

from forcetorque.evaluation.model_findings import model_findings
from forcetorque.evaluation.wrench_errors import WrenchErrors, offset_removed, wrench_errors

__all__ = ["WrenchErrors", "model_findings", "offset_removed", "wrench_errors"]
