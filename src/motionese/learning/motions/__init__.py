"""Motions: sequences of different lengths with masks and weights, and the batches made of them."""
