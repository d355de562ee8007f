# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin`: the commands about artificial skin."""

from __future__ import annotations

import typer

from forcetorque.skin.commands.calibrate import calibrate
from forcetorque.skin.commands.check import check
from forcetorque.skin.commands.wrench import wrench

skin = typer.Typer(
    name="skin",
    help="Check, calibrate and use patches of artificial skin.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

for _command in (calibrate, check, wrench):
    skin.command(_command.__name__)(_command)
