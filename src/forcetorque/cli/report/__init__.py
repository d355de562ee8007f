# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque report`: everything about the sensors of experiments in one document."""

from forcetorque.cli.report.run import run

__all__ = ["run"]
