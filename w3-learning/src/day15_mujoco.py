"""Week 3's scene in MuJoCo, under the name that labs import: `robo47.push` itself.

It is in the library because robo47.gym offers it to other tools as well.
"""

import sys

from robo47 import push

sys.modules[__name__] = push  # one module, whichever name is imported
