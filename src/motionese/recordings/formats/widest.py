"""How many columns an array may have and still be channels."""

WIDEST = 512
"""What is wider is a picture, an embedding or a cloud of points, and is left alone."""
