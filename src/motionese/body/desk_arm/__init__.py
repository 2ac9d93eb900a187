"""A small desk arm with three servos, and a camera that stands beside it."""

from motionese.body.desk_arm.desk_arm import DeskArm, DeskArmSettings

__all__ = ["DeskArm", "DeskArmSettings"]
