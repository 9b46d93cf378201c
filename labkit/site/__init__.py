"""Static site of the course: its pages, the arm on one of them, and a check of links."""
