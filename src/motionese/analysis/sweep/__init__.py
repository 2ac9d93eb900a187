"""What a sweep says: which findings hold at which point, and what the settings change."""

from motionese.analysis.sweep.report import write_sweep

__all__ = ["write_sweep"]
