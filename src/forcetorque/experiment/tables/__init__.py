# SPDX-License-Identifier: BSD-3-Clause
"""Tables of an experiment file that stand by themselves."""
