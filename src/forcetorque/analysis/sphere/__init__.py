# SPDX-License-Identifier: BSD-3-Clause
"""How the three axes of a sensor weigh a limb that is carried around."""
