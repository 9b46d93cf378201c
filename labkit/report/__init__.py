"""The metrics log as a page and a picture: `make report`.

Inside, one job each: `series` (rows into one series per check, and what the manifests
ask for), `plot` (a series as lines, dots and words), `page` (HTML with inline SVG),
`picture` (the same as a PNG).
"""
