"""The metrics log as labs and handouts type it; the code is `labkit.log`."""

from labkit.log import COLUMNS, append_row, append_rows, read_rows

__all__ = ["COLUMNS", "append_row", "append_rows", "read_rows"]
