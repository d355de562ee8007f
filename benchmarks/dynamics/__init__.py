# SPDX-License-Identifier: BSD-3-Clause
"""Expected readings, contact wrenches and joint torques: our time, accuracy and memory beside other libraries."""
