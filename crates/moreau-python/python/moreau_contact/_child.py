"""A child that serves the class of an engine on standard input and output.

    python -m moreau_contact._child FILE_OR_MODULE CLASS [PATH …]
"""
import sys

from ._engine import load, made, serve

if __name__ == "__main__":
    sys.path += [place for place in sys.argv[3:] if place not in sys.path]
    serve(made(load(sys.argv[1], sys.argv[2])))
