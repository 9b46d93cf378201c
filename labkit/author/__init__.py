"""For whoever writes a day: the skeleton of a new one, and of its worksheet."""
