"""The name that labs import: `robo47.lesson.lab`."""
