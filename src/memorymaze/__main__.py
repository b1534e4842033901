"""`python -m memorymaze` is `memorymaze`."""

import sys

from memorymaze.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
