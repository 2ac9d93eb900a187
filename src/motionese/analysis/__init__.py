"""What came of the runs: learning curves, new motions, the slow map, claims, and the report."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from motionese.analysis.comparison import write_comparison
    from motionese.analysis.kept import keep, kept_results, kept_runs
    from motionese.analysis.report import Report, write_report
    from motionese.analysis.sweep import write_sweep

__all__ = [
    "Report",
    "keep",
    "kept_results",
    "kept_runs",
    "write_comparison",
    "write_report",
    "write_sweep",
]

_FILES = {
    "comparison": ("write_comparison",),
    "kept": ("keep", "kept_results", "kept_runs"),
    "report": ("Report", "write_report"),
    "sweep": ("write_sweep",),
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for: statistics alone need no simulator."""
    file = next((file for file, names in _FILES.items() if name in names), None)
    if file is None:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(import_module(f"{__name__}.{file}"), name)


def __dir__() -> list[str]:
    return list(__all__)
