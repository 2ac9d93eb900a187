"""The checker of annotations while tests run: as mypy, it takes an int where a float is meant."""

from beartype import BeartypeConf, beartype

checked = beartype(conf=BeartypeConf(is_pep484_tower=True))
