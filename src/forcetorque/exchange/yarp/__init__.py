# SPDX-License-Identifier: BSD-3-Clause
"""Logs of yarpdatadumper: one folder per port."""

from forcetorque.exchange.yarp.analog import read_analog
from forcetorque.exchange.yarp.reading import PortReading
from forcetorque.exchange.yarp.state_ext import read_state_ext

__all__ = ["PortReading", "read_analog", "read_state_ext"]
