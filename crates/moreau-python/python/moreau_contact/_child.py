"""A child that serves the class of an engine on standard input and output.

    python -m moreau_contact._child FILE_OR_MODULE CLASS [PATH …]
"""
import os
import sys

from . import _engine

if __name__ == "__main__":
    _engine.is_child = True
    # what a script, or compiled code, prints is no reply
    replies = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    sys.path += [place for place in sys.argv[3:] if place not in sys.path]
    _engine.serve(_engine.load(sys.argv[1], sys.argv[2]), replies)
