"""The type checker that pytest puts on every function of ilmek: an int is welcome where a float is."""

from beartype import BeartypeConf, beartype

checker = beartype(conf=BeartypeConf(is_pep484_tower=True))
