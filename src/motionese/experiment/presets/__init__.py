"""Presets of the experiment's settings, as TOML files to read, copy and edit."""
