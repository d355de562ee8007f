# SPDX-License-Identifier: BSD-3-Clause
"""The command line: one file per command, parser apart from run."""

from forcetorque.cli.main import main

__all__ = ["main"]
