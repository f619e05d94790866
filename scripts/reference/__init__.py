"""How the files under `references/` are made and compared; standard library only."""
