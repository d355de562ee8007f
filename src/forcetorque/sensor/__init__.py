# SPDX-License-Identifier: BSD-3-Clause
"""How load becomes counts: elastic element, gauge, bridge, amplifier, converter, saturation, full scale."""
