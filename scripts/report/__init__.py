"""The checks of the written report, run by scripts/check_report.py."""
