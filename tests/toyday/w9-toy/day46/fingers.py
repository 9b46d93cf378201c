"""46.8 `fingers(model)`: a robot as an argument; a side quest."""

from labkit.judge import Robot, Row, Scalar

HAND = Robot("panda")
row = Row(Scalar(), truth=lambda model: 2.0, near=1e-4)
row.inputs(lambda rng: [(HAND,)])
