"""The command `moreau`, which is this library."""
import signal
import sys

from . import _native


def main() -> int:
    """Runs the command line of this process."""
    # Ctrl-C ends the command as it ends any other; Python would keep it for later
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command(["moreau", *sys.argv[1:]])
