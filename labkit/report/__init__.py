"""The metrics log as a page: `make report`.

Inside, one job each: `series` (rows into one series per number, judged by what the
manifests ask for), `plot` (a series as SVG), `page` (HTML). On a week, driven by its
days' manifests: `week_labs` (its labs, run), `week_facts` (numbers, tasks, minutes,
hints, mistakes), `week_page` (all that as HTML) and `week_retro` (the numbers between
two marks of the student's retrospective).
"""
