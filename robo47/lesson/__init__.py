"""What labs import: `robo47.lesson.lab`."""
