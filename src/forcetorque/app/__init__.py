# SPDX-License-Identifier: BSD-3-Clause
"""The command line, and what scripts and notebooks hold."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.app.python.functions import design_device, motion, motion_of_arrays, simulate, study, workbench

__all__ = [
    "design_device",
    "motion",
    "motion_of_arrays",
    "simulate",
    "study",
    "workbench",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "design_device": "forcetorque.app.python.functions",
        "motion": "forcetorque.app.python.functions",
        "motion_of_arrays": "forcetorque.app.python.functions",
        "simulate": "forcetorque.app.python.functions",
        "study": "forcetorque.app.python.functions",
        "workbench": "forcetorque.app.python.functions",
    },
)
