# SPDX-License-Identifier: BSD-3-Clause
"""All sensors of a robot at once, from equations of link groups between sensors that nothing touches."""
