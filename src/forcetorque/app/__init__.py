# SPDX-License-Identifier: BSD-3-Clause
"""The command line, and what scripts and notebooks hold."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.app.python.arrays import motion_of_arrays as motion_of_arrays
    from forcetorque.device.command import design_device as design_device
    from forcetorque.locomotion.commands import motion as motion
    from forcetorque.simulation.command import simulate as simulate
    from forcetorque.study.command import study as study
    from forcetorque.workbench.command import workbench as workbench

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    design_device="forcetorque.device.command",
    motion="forcetorque.locomotion.commands",
    motion_of_arrays="forcetorque.app.python.arrays",
    simulate="forcetorque.simulation.command",
    study="forcetorque.study.command",
    workbench="forcetorque.workbench.command",
)
