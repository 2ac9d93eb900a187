"""How people and other programs use the package: command line, page, logs, ONNX, estimator."""
