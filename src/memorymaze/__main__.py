"""The command `memorymaze`, which is `python -m memorymaze` too."""

import sys


def main() -> int:
    """Run the command line; Ctrl-C while it is being loaded is no traceback either."""
    try:
        from memorymaze.front.cli.main import run_command_line

        return run_command_line()
    except KeyboardInterrupt:
        print("memorymaze: interrupted", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
