"""Contact problems made by ourselves, the exact answers of small ones, and the records of all: `scripts/generate_problems.py`."""
