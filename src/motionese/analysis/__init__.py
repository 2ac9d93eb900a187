"""What came of the runs: learning curves, new motions, the slow map, claims, and the report."""

from motionese.analysis.report import Report, write_report

__all__ = ["Report", "write_report"]
