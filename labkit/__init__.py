"""The machine that checks, records, shows and grades; it names no day."""
