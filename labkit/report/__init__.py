"""The metrics log as a page: `make report`.

Inside, one job each: `thresholds` (what the week's manifest asks for), `series`
(rows into one series per check), `plot` (a series as SVG), `page` (HTML with its
looks from `style`). On a week, driven by its days' manifests: `week_labs` (its labs,
run), `week_numbers` (the student's numbers beside the kit's), `week_facts` (tasks,
minutes, hints, mistakes), `week_page` (all that as HTML) and `week_retro` (the
numbers between two marks of the student's retrospective).
"""
