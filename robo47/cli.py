"""What every command of the kit does the same way: end well."""

import sys
import warnings
from collections.abc import Callable

from robo47.errors import Robo47Error

EXIT_OK, EXIT_FAILED, EXIT_CANNOT_RUN = 0, 1, 2


def run(main: Callable[[], int]) -> None:
    """Run a command's `main` and exit with its code, never with a traceback.

    Args:
        main: returns the exit code: 0 all well, 1 something to fix, 2 could not run.
    """
    warnings.formatwarning = lambda message, *_, **__: f"warning: {message}\n"
    try:
        code = main()
        sys.stdout.flush()
    except Robo47Error as error:
        print(f"error: {error}", file=sys.stderr)
        code = EXIT_CANNOT_RUN
    except NotImplementedError as gap:  # a task of a starter that is still to do
        print(f"to do: {gap}", file=sys.stderr)
        code = EXIT_FAILED
    except KeyboardInterrupt:
        print("\nstopped", file=sys.stderr)
        code = 130
    except BrokenPipeError:  # `... | head` closed early: nobody is left to tell
        sys.stdout = None  # type: ignore[assignment]
        code = EXIT_OK
    sys.exit(code)
