"""A seated humanoid: a pneumatic right arm, a neck, and an eye in the head."""

from motionese.body.actroid.actroid import Actroid
from motionese.body.actroid.drive import ActroidSettings

__all__ = ["Actroid", "ActroidSettings"]
