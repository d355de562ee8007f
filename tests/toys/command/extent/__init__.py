# SPDX-License-Identifier: BSD-3-Clause
"""How long a sensor was logged: a capability for the test that adds one."""

from forcetorque.results.capability import Capability

CAPABILITY = Capability(page="recording.md", commands=("forcetorque.extent.command:extent",))
