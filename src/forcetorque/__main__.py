# SPDX-License-Identifier: BSD-3-Clause
"""`python -m forcetorque`."""

from forcetorque.cli import main

main()
