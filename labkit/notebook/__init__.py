"""A day in a notebook: its guide, the student's cells, the verdicts.

build      the notebook, made of the guide, the starter and the manifest
guide      the guide as blocks, with the places of its tasks and steps
sync       the notebook and the lab's file in step
worksheet  the open places of a worksheet, filled in
kernel     what the cells call
show       what a cell answers with
"""
