"""Contact solvers of other projects, timed on the files that `moreau bench` is timed on."""
