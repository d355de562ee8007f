# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench device`: a calibration device by computation, with its URDF, motions and simulated recordings."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.device.design import DeviceDesign
    from forcetorque.device.device_file import DeviceFile


@command("the requirements against their limits")
def design_device(
    file: Annotated[
        "DeviceFile | Path | str | None",
        Option("Device file (TOML); see docs/device/device.md. Default: the device that comes with the library."),
    ] = None,
    *,
    output: Annotated[
        "Path | None",
        Option("Folder to make, for URDFs, trajectories, logs and experiment files.", "--output", "-o", folder=True),
    ] = None,
    figures: Annotated[
        "Path | None",
        Option("Folder to make, for PNGs of motion, excitation, swept space and errors.", "--figures", folder=True),
    ] = None,
    progress: Annotated["Progress", Option("Called with a line for people as work goes on.")] = lambda _: None,
) -> "DeviceDesign":
    """Check a calibration device by computation, and simulate what it records.

    Example: forcetorque bench device device.toml -o simulated

    Python: `app.design_device("device.toml")`

    Returns:
        Excitation, demands and errors; its `trajectories` are the motions.
    """
    from forcetorque.device.design import design_device
    from forcetorque.device.device_file import DEFAULT_DEVICE, DeviceFile, read_device
    from forcetorque.device.simulated_recordings import write_device

    device = file if isinstance(file, DeviceFile) else read_device(DEFAULT_DEVICE if file is None else file)
    design = design_device(device)
    if output is not None:
        design = write_device(design, output, progress=progress)
    if figures is not None:
        from forcetorque.device.figures import write_device_figures

        design = write_device_figures(design, figures)
    return design


device = design_device
"""The command."""
