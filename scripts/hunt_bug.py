import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # also under -P
import kit

kit.run("hunt")  # labkit/commands/hunt.py
