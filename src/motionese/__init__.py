"""Developmental imitation learning with multiple-timescale recurrent networks (MTRNN)."""

__version__ = "0.1.0"
