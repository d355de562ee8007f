# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches, joint torques and expected readings."""
