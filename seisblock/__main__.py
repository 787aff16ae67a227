"""Entry point of ``seisblock`` and ``python -m seisblock``."""

import gc
import signal
import sys

from seisblock.core._signals import defer_interrupt

EXIT_INTERRUPTED = 130
"""Exit code after Ctrl-C, 128 + SIGINT, as in shells."""

GC_THRESHOLD = 50_000
"""Allocations before a garbage collection of the youngest generation; at the default of 700 it takes a tenth of the run time."""


def run() -> None:
    """Run the command line and exit with its code; SIGINT during imports exits cleanly and is ignored after the end."""
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
