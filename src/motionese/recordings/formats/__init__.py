"""The formats of recordings: one module each, with `read` and `write`."""
