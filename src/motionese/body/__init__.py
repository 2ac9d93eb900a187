"""The simulated robot: pneumatic arm, neck, eye and buttons in MuJoCo, and the body protocol."""
