# SPDX-License-Identifier: BSD-3-Clause
"""Logs of yarpdatadumper: one folder per port."""

from forcetorque.exchange.yarp.analog import read_analog
from forcetorque.exchange.yarp.discover import FoundPort, PortKind, discover_ports, read_port
from forcetorque.exchange.yarp.inertial import read_inertial
from forcetorque.exchange.yarp.joint_units import NO_JOINT
from forcetorque.exchange.yarp.log_folder import read_log_folder
from forcetorque.exchange.yarp.measures import MeasuresList, MeasuresSensor, read_measures
from forcetorque.exchange.yarp.reading import PortReading
from forcetorque.exchange.yarp.skin import read_skin
from forcetorque.exchange.yarp.skin_events import SkinPart, read_skin_events
from forcetorque.exchange.yarp.state import read_state
from forcetorque.exchange.yarp.state_ext import read_state_ext
from forcetorque.exchange.yarp.writing import write_ports
from forcetorque.exchange.yarp.written_port import DevicePort, StreamPort, WrittenPort

__all__ = [
    "NO_JOINT",
    "DevicePort",
    "FoundPort",
    "MeasuresList",
    "MeasuresSensor",
    "PortKind",
    "PortReading",
    "SkinPart",
    "StreamPort",
    "WrittenPort",
    "discover_ports",
    "read_analog",
    "read_inertial",
    "read_log_folder",
    "read_measures",
    "read_port",
    "read_skin",
    "read_skin_events",
    "read_state",
    "read_state_ext",
    "write_ports",
]
