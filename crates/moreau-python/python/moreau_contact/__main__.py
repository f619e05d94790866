"""`python -m moreau_contact` is the command `moreau`."""
import sys

from ._command import main

sys.exit(main())
