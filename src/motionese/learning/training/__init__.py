"""Training: a trainer, the state it goes through epoch by epoch, its checkpoints."""
