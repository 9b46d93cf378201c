"""Which kit this is: grades from two different ones must not be mixed unseen."""

import hashlib
from functools import cache

from robo47.paths import ROOT


@cache
def fingerprint() -> str:
    """Return a hash of the code and the manifests that decide a grade."""
    files = [*ROOT.glob("robo47/**/*.py"), *ROOT.glob("w*-*/week.toml")]
    whole = hashlib.sha256()
    names = {path.relative_to(ROOT).as_posix(): path for path in files}
    for name in sorted(names):  # the same order and line ends on every system
        text = names[name].read_bytes().replace(b"\r\n", b"\n")
        whole.update(name.encode() + b"\0" + text + b"\0")
    return whole.hexdigest()[:16]
