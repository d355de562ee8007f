# SPDX-License-Identifier: BSD-3-Clause
"""`python -m forcetorque`."""

from forcetorque.app.command_line import main

if __name__ == "__main__":
    main()
