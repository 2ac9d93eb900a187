"""What role each level plays: measures one a run, figures, and a table of them."""

from motionese.analysis.roles.seed_table import seed_table

__all__ = ["seed_table"]
