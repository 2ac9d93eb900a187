"""Generation in closed loop: single motions from initial states, and sequences of them."""
