"""Day 5's named mistakes, each made again on purpose, for all questions at once."""
