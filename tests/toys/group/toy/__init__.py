# SPDX-License-Identifier: BSD-3-Clause
"""How many taxels a layout has: a capability with a group of commands, for the test that adds one."""

from forcetorque.results.capability import Capability

CAPABILITY = Capability(page="skin/layout.md", commands=("forcetorque.toy.commands:toy",))
