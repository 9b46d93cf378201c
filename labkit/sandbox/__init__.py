"""The walls around student code, and the process behind them."""
