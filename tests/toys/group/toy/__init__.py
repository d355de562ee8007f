# SPDX-License-Identifier: BSD-3-Clause
"""How many taxels a layout has: a capability with a group of commands, for the test that adds one."""
