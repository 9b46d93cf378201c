"""The command line as labs type it; the code is `labkit.base.cli`."""

from labkit.base.cli import EXIT_FAILED, EXIT_OK, paint, run, wrapped

__all__ = ["EXIT_FAILED", "EXIT_OK", "paint", "run", "wrapped"]
