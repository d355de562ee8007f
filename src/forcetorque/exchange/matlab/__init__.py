# SPDX-License-Identifier: BSD-3-Clause
"""Logs that were kept as MATLAB files of version 5 to 7."""

from forcetorque.exchange.matlab.log_format import MatlabFormat
from forcetorque.exchange.matlab.log_table import MatlabLog

__all__ = ["MatlabFormat", "MatlabLog"]
