# SPDX-License-Identifier: BSD-3-Clause
"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.output import Format

ExperimentArgument = Annotated[Path, typer.Argument(help="Experiment file (TOML); see docs/recording.md.")]
ExperimentsArgument = Annotated[
    list[Path], typer.Argument(help="Experiment files (TOML) with the same sensors; see docs/recording.md.")
]
FormatOption = Annotated[Format, typer.Option("--format", help="Form of the result on standard output.")]
DetailsOption = Annotated[bool, typer.Option("--details", help="Show tables and all warnings below the answer.")]
ForceOption = Annotated[
    bool,
    typer.Option(
        "--force", help="Replace a file that is neither a result nor a figure. An input of the command never is."
    ),
]
SensorOption = Annotated[
    list[str] | None, typer.Option("--sensor", help="Sensor of the experiment; repeat for more. Default: all.")
]
ColumnNamesOption = Annotated[
    list[str] | None,
    typer.Option(
        "--column-names",
        help="Names of all columns of a table without headings, as t,fx,fy,fz,tx,ty,tz; once for each table.",
    ),
]
RecordingOption = Annotated[
    list[str] | None,
    typer.Option(
        "--recording",
        help="What a log lacks, as moment_about=flange, payload_kg=0 or measure_direction=parent_to_child; repeat for "
        "more.",
    ),
]
LoadsOption = Annotated[
    str | None,
    typer.Option(
        "--loads",
        help="Weights of a bench: a table of them, thesis-6.1, or the log itself if its columns have the loads.",
    ),
]
CalibrationsOption = Annotated[
    list[Path] | None,
    typer.Option(
        "--calibration", "-c", help="Calibration file, or folder of them; repeat for more. Default: the priors."
    ),
]
OffsetOption = Annotated[
    str,
    typer.Option(
        "--offset",
        help="Where offsets come from: fitted (the calibration's own), one-link-imu:LABEL, one-link-fixed-frame:LABEL, "
        "tare:LABEL, first-second, judged-mean or none; see docs/locomotion/coherence.md.",
    ),
]
PopulationOption = Annotated[
    list[Path] | None,
    typer.Option(
        "--population", help="Matrix file or calibration of another sensor, or a folder of them; repeat for more."
    ),
]


def between_commas(texts: list[str] | None) -> list[list[str]]:
    """Give the parts of each text of an option between commas; none where the option is not given."""
    return [[part.strip() for part in text.split(",")] for text in texts or ()]
