# SPDX-License-Identifier: BSD-3-Clause
"""How long a sensor was logged: a capability for the test that adds one."""
