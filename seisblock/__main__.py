"""The command as a process of its own: ``seisblock`` and ``python -m seisblock``."""

import gc
import signal
import sys

from seisblock.core._signals import defer_interrupt

EXIT_INTERRUPTED = 130
"""Exit code after Ctrl-C, as shells have it."""

GC_THRESHOLD = 50_000
"""How many pile up before Python looks among them for circles that nobody holds: at its usual 700 that is a tenth of a run, for nothing."""


def run() -> None:
    """Run the command and leave with its exit code; Ctrl-C while it is imported is no traceback, and behind its end too late."""
    gc.set_threshold(GC_THRESHOLD)
    try:
        with defer_interrupt():
            from seisblock.cli import main
        main()
    except KeyboardInterrupt:
        sys.exit(EXIT_INTERRUPTED)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


if __name__ == "__main__":
    run()
