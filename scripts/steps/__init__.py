"""Scenes, runs and tables of `scripts/measure_steps.py`; standard library only."""
