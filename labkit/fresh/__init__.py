"""The same numbers from a fresh clone: `make fresh`.

clone       a clone of the last commit, set up from nothing
missing     what is here and not in that clone
compare     the clone's numbers beside the committed ones
"""

FRESH = "fresh.json"  # the last result, in the kit's store
