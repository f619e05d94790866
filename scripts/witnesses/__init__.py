"""Decides again, in fractions, what `moreau verify --export` wrote. Shares nothing with the crate but the file."""
