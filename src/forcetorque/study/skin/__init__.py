# SPDX-License-Identifier: BSD-3-Clause
"""The experiment of thesis 7.3 in simulation, Tables 7.1 to 7.3: loads on a leg with skin and a sensor."""
