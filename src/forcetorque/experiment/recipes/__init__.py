# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file adds to what was logged, such as one clock in place of several."""
