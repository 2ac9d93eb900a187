"""What came of the runs: learning curves, new motions, the slow map, claims, and the report."""

from motionese.analysis.comparison import write_comparison
from motionese.analysis.kept import keep, kept_results, kept_runs
from motionese.analysis.report import Report, write_report

__all__ = ["Report", "keep", "kept_results", "kept_runs", "write_comparison", "write_report"]
