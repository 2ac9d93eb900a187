"""A small run that nothing disturbed, to compare others with."""

from small_runs import compiled, small_settings, undisturbed

__all__ = ["compiled", "small_settings", "undisturbed"]
