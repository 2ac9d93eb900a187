"""What public functions are given: what fits their annotations, or one sentence that refuses it.

Annotations are read generously: any array of numbers for an array, any number for a number, NumPy's
own included. Needs NumPy only.
"""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, wraps
from inspect import Signature, isclass, signature
from numbers import Integral, Real
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy import ndarray

from motionese.errors import MotioneseError, SettingError, kind_of, unknown

Refusal = type[MotioneseError]
Decorated = TypeVar("Decorated", bound=Callable[..., Any])
UNIONS, LISTS = (Union, UnionType), (Sequence, Iterable, list, tuple)
SIMPLE: dict[Any, Any] = {
    int: Integral,
    float: Real,
    bool: (bool, np.bool_),
    Path: (str, os.PathLike),
    Literal: str,
}
"""What counts as one of these kinds. A text that is none of several is refused, with the nearest,
where it is looked up."""
WORDS = {
    int: "a whole number",
    float: "a number",
    bool: "True or False",
    str: "a text",
    Path: "a path",
    ndarray: "an array of numbers",
    NoneType: "None",
}
BY_NAME = {
    "Array": "a JAX random key such as jax.random.key(0)",
    "Callable": "a function",
    "MTRNN": "a network",
}
"""Of kinds that need more than NumPy; a plain `Array` is a key."""


def refusing(error: Refusal = SettingError) -> Callable[[Decorated], Decorated]:
    """Return a decorator that refuses arguments which do not fit a function's annotations.

    A class is decorated by its `__init__`.
    """

    def decorate(function: Any) -> Any:
        if isclass(function):
            setattr(function, "__init__", refusing(error)(function.__init__))  # noqa: B010
            return function
        name, form = function.__qualname__.removesuffix(".__init__"), signature(function)

        @wraps(function)
        def called(*args: Any, **kwargs: Any) -> Any:
            _check(name, form, hints(), args, kwargs, error)
            return function(*args, **kwargs)

        @cache
        def hints() -> dict[str, Any]:
            return get_type_hints(function)

        return called

    return decorate


def _check(
    name: str,
    form: Signature,
    hints: Mapping[str, Any],
    args: tuple[Any, ...],
    kwargs: Mapping[str, Any],
    error: Refusal,
) -> None:
    try:
        arguments = form.bind(*args, **kwargs).arguments
    except TypeError as wrong:
        raise error(f"{name}: {wrong}") from wrong
    for argument, given in arguments.items():
        hint, several = hints.get(argument, Any), form.parameters[argument].kind
        each = given if several is several.VAR_POSITIONAL else [given]
        if several is several.VAR_KEYWORD:
            continue
        for one in each:
            if not fits(one, hint):
                raise error(f"{name}: {argument} must be {told(hint)}, got {kind_of(one)}")


def fits(given: Any, hint: Any) -> bool:
    """Return whether a value is what an annotation asks for, or stands for it."""
    kind, inner = get_origin(hint) or hint, get_args(hint)
    if kind in UNIONS:
        return any(fits(given, one) for one in inner)
    if kind is ndarray or hasattr(hint, "array_type"):
        return _numbers(given)
    if kind in LISTS:
        return _fits_each(given, kind, inner)
    if kind in SIMPLE:
        number = np.asarray(given)[()] if _single(given) else given
        return isinstance(number, SIMPLE[kind]) and not (
            kind in (int, float) and isinstance(given, bool)
        )
    if kind is Mapping and isinstance(given, Mapping):
        pairs = given.items()
        return all(fits(key, inner[0]) and fits(value, inner[1]) for key, value in pairs)
    return kind is Any or not isclass(kind) or isinstance(given, kind)


def _single(given: Any) -> bool:
    """Return whether something is an array of no axis."""
    return hasattr(given, "dtype") and np.shape(given) == ()


def _numbers(given: Any) -> bool:
    if given is None or isinstance(given, str | bytes | Mapping):
        return False
    try:
        return np.asarray(given, dtype=np.float64).ndim > 0
    except (TypeError, ValueError, OverflowError):
        return False


def _fits_each(given: Any, kind: Any, inner: tuple[Any, ...]) -> bool:
    unfit: Any = str | bytes if kind is Iterable else str | bytes | Mapping
    if isinstance(given, unfit) or not isinstance(given, Iterable) or _single(given):
        return False
    if not isinstance(given, Sequence | ndarray) and not hasattr(given, "dtype"):
        return kind is Iterable  # perhaps to be gone through but once
    each = list(given)
    if kind is tuple and ... not in inner:
        return len(each) == len(inner) and all(map(fits, each, inner))
    return not inner or all(fits(one, inner[0]) for one in each)


def told(hint: Any) -> str:
    """Return in words what an annotation asks for."""
    kind, inner = get_origin(hint) or hint, get_args(hint)
    if kind in (*UNIONS, Literal):
        words = [told(one) if kind in UNIONS else f"'{one}'" for one in inner]
        return " or ".join(dict.fromkeys(words))
    if kind in LISTS:
        return f"a list ({told(inner[0])} each)" if inner and inner[0] is not Any else "a list"
    if kind is Mapping:
        return f"a mapping ({told(inner[0])} to {told(inner[1])} each)"
    called = getattr(kind, "__name__", str(kind)).rpartition(".")[-1]
    kind = ndarray if hasattr(hint, "array_type") else kind
    return WORDS.get(kind) or BY_NAME.get(called) or f"a {called}"


def place_of(kind: str, which: str | int, names: Sequence[str], error: Refusal) -> int:
    """Return the place of what a name, or a number counted from 0, stands for.

    Args:
        kind: What has such names, for the sentence.
        which: A name or a number. What is called by a number has it as a name, perhaps at another
            place: then a number that might mean either is refused.
        names: All there are.
        error: What is raised where there is no such thing.
    """
    if isinstance(which, str):
        if which not in names:
            raise error(unknown(kind, which, names))
        return names.index(which)
    if not fits(which, int):
        raise error(f"a {kind} is told by its name, or its number from 0; got {kind_of(which)}")
    called = str(which)
    if not 0 <= which < len(names):
        if called in names:
            return names.index(called)
        raise error(f"unknown {kind} {which}; there are {len(names)}, counted from 0")
    at = names[which]
    if at != called and (at.isdecimal() or called in names):
        raise error(
            f"{kind} {which} may be the one called '{called}', or '{at}', which is at place "
            f"{which} from 0; give the name"
        )
    return int(which)


def numbers(what: str, given: Any, error: Refusal = SettingError) -> ndarray:
    """Return an array of numbers, or of what can be one; NaN is a number."""
    if not (_numbers(given) or fits(given, float)):
        raise error(f"{what} must be an array of numbers, got {kind_of(given)}")
    return np.array(given, dtype=np.float64)


def several(given: Iterable[str | int] | str | int) -> Iterable[str | int]:
    """Return one name or number, or several of them, as several."""
    return [given] if isinstance(given, str | int | np.integer) else given
