# SPDX-License-Identifier: BSD-3-Clause
"""`python -m forcetorque`."""

from forcetorque.cli import main

if __name__ == "__main__":
    main()
