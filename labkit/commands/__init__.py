"""The commands behind `make` and `scripts/`: one module per verb."""
