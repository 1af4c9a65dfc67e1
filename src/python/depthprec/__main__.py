# SPDX-License-Identifier: MIT
"""The command: python3 -m depthprec, or depthprec where the package was installed by pip."""
import os
import sys

from ._program import PATH


def main():
    os.execv(PATH, [PATH, *sys.argv[1:]])


if __name__ == "__main__":
    main()
