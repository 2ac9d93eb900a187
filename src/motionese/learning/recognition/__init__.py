"""Recognition: initial states of observed motions by descent, and the verdict on them."""
