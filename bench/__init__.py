"""What the kit claims to be fast, beside its rivals; scripts/bench.py runs it."""
