"""A lab that starts with `import kit` runs in the kit's own Python, however it starts.

`make start` puts a copy beside your own script: keep it there.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before NumPy: small SVDs are faster so

_folder = os.path.dirname(os.path.abspath(__file__))
_script = os.path.join(_folder, os.pardir, os.pardir, "scripts", "kit.py")
if os.path.exists(_script):  # a copy outside the clone, as a checker's, needs no help
    with open(_script) as _file:
        exec(compile(_file.read(), _script, "exec"), {"__file__": _script})
