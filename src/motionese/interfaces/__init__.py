"""How people and other programs use the package: the command line."""
