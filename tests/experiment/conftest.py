"""A small run that nothing disturbed, to compare others with."""

from small_runs import small_settings, undisturbed

__all__ = ["small_settings", "undisturbed"]
