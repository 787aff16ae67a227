"""``python -m seisblock`` is the command ``seisblock``."""

from seisblock.cli import main

if __name__ == "__main__":
    main()
