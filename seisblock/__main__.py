"""The command as a process of its own: ``seisblock`` and ``python -m seisblock``."""

import signal
import sys

from seisblock.signals import losing_no_interrupt

INTERRUPTED = 130
"""Exit code after Ctrl-C, as shells have it."""


def run() -> None:
    """Run the command and leave with its exit code; Ctrl-C while it is imported is no traceback, and behind its end too late."""
    try:
        with losing_no_interrupt():
            from seisblock.cli import main
        main()
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


if __name__ == "__main__":
    run()
