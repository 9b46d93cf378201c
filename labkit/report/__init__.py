"""The metrics log as a page and a picture: `make report`.

Inside, one job each: `thresholds` (what the week's manifest asks for), `series`
(rows into one series per check), `plot` (a series as lines, dots and words),
`page` (HTML with inline SVG, looks from `style`), `picture` (the same as a PNG).
"""
