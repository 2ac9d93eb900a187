"""Logs of training: lines of JSON, TensorBoard, Rerun."""
