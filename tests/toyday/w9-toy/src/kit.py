"""A lab that starts with `import kit` runs in the kit's own Python, however it starts.

`make start` puts a copy beside your own script: keep it there.
"""

import os
import runpy

_folder = os.path.dirname(os.path.abspath(__file__))
_script = os.path.join(_folder, os.pardir, os.pardir, "scripts", "kit.py")
if os.path.exists(_script):  # a copy outside the clone, as a checker's, needs no help
    runpy.run_path(_script)
