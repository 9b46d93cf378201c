"""Static site of the course: its pages, the arm's own page, a check of links."""
