"""A user's mistake gets one clear sentence: the name, the rule and the value."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray


def check_number(name: str, value: float) -> float:
    """Return `value` as a finite float, or say that it is none.

    >>> check_number("lam", 1)
    1.0
    """
    number = as_float(name, value)
    if not np.isfinite(number):
        raise ValueError(f"{name} must be a finite number, got {number:g}")
    return number


def check_whole(name: str, value: float, least: int = 1, most: float = np.inf) -> int:
    """Return `value` as an int, or say that it is not a whole number from `least` to `most`.

    >>> check_whole("repeats", 3.0)
    3
    """
    number = as_float(name, value)
    if not (number.is_integer() and number >= least):
        raise ValueError(f"{name} must be a whole number of at least {least}, got {number:g}")
    if number > most:
        raise ValueError(f"{name} must be at most {most:,}, got {number:g}")
    return int(number)


def check_probability(name: str, p: float) -> float:
    """Return `p` as a float, or say that it does not lie strictly between 0 and 1.

    >>> check_probability("p_free", 0.9)
    0.9
    """
    p = as_float(name, p)
    if not 0.0 < p < 1.0:
        raise ValueError(f"{name} must lie strictly between 0 and 1, got {p:g}")
    return p


def check_positive(name: str, value: float) -> float:
    """Return `value` as a float, or say that it is not a finite positive number."""
    value = as_float(name, value)
    if not (np.isfinite(value) and value > 0):
        raise ValueError(f"{name} must be a finite number above 0, got {value:g}")
    return value


def check_not_negative(name: str, value: float, most: float = np.inf) -> float:
    """Return `value` as a float, or say that it is not a finite number from 0 to `most`.

    >>> check_not_negative("deviation", 0)
    0.0
    """
    value = as_float(name, value)
    if not (np.isfinite(value) and value >= 0):
        raise ValueError(f"{name} must be a finite number of at least 0, got {value:g}")
    if value > most:
        raise ValueError(f"{name} must be at most {most:g}, got {value:g}")
    return value


def check_share(name: str, value: float) -> float:
    """Return `value` as a float, or say that it does not lie between 0 and 1; both may be."""
    value = as_float(name, value)
    if not 0 <= value <= 1:
        raise ValueError(f"{name} must lie between 0 and 1, got {value:g}")
    return value


def check_flag(name: str, value: object) -> bool:
    """Return `value` as a bool, or say that it is neither True nor False: "no" would count as yes.

    >>> check_flag("free_on_no_return", "no")
    Traceback (most recent call last):
    ValueError: free_on_no_return must be True or False, got 'no'
    """
    if not isinstance(value, bool | np.bool_):
        raise ValueError(f"{name} must be True or False, got {_shown(value)}")
    return bool(value)


def check_choice(name: str, value: object, choices: Sequence[str]) -> str:
    """Return `value`, or say that it is none of the words that there are."""
    if not isinstance(value, str) or value not in choices:
        raise ValueError(f"{name} must be one of {', '.join(choices)}, got {_shown(value)}")
    return value


def check_rng(rng: object) -> np.random.Generator:
    """Return the generator, or say that chance must be handed over as one."""
    if not isinstance(rng, np.random.Generator):
        raise ValueError(f"rng must be a numpy Generator, as numpy.random.default_rng(0) makes it, got {_shown(rng)}")
    return rng


def check_record(name: str, value: object, *kinds: type) -> None:
    """Say when something else stands where a record of one of `kinds` belongs; an array has none of its names.

    >>> check_record("log", [1, 2], dict)
    Traceback (most recent call last):
    ValueError: log must be a dict, got list
    """
    if not isinstance(value, kinds):
        names = [f"{'an' if kind.__name__[0] in 'AEIOU' else 'a'} {kind.__name__}" for kind in kinds]
        raise ValueError(f"{name} must be {' or '.join(names)}, got {type(value).__name__}")


def check_image(name: str, image: ArrayLike, dtype: type = bool) -> NDArray:
    """Return a 2-D array of `dtype` with at least one pixel, or say what is wrong with it."""
    try:
        array = np.asarray(image)
    except ValueError:  # rows of different lengths
        raise ValueError(f"{name} must be a 2-D image with at least one pixel, got {_shown(image)}") from None
    if array.ndim != 2 or array.size == 0:
        raise ValueError(f"{name} must be a 2-D image with at least one pixel, got shape {array.shape}")
    return array.astype(dtype, copy=False)


def check_poses(name: str, poses: ArrayLike) -> NDArray[np.float64]:
    """Return finite (N, 3) poses x, y, theta, or say what is wrong with them."""
    try:
        array = np.asarray(poses, dtype=np.float64)
    except _NO_NUMBERS:
        raise ValueError(f"{name} must be rows of three numbers x, y, theta, got {str(poses)[:60]}") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have shape (N, 3) for x, y, theta, got shape {array.shape}")
    if not np.isfinite(array).all():
        row = int(np.flatnonzero(~np.isfinite(array).all(axis=1))[0])
        raise ValueError(f"{name} must be finite numbers, got {array[row].tolist()} in row {row}")
    return array


def check_pose(name: str, pose: ArrayLike) -> NDArray[np.float64]:
    """Return one finite pose (3,) x, y, theta, or say what is wrong with it."""
    array = as_numbers(name, pose)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise ValueError(f"{name} must be three finite numbers x, y, theta, got {_shown(array.tolist())}")
    return array


def as_numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return an array of floats, nan included, or say that these are no numbers.

    >>> as_numbers("ranges", [1, 2]).tolist()
    [1.0, 2.0]
    """
    try:
        return np.asarray(values, dtype=np.float64)
    except _NO_NUMBERS:
        raise ValueError(f"{name} must be numbers, got {_shown(values)}") from None


def as_float(name: str, value: object) -> float:
    """Return `value` as a float, nan included, or say that it is no number; text is none, whatever number it spells."""
    if isinstance(value, str | bytes):
        raise ValueError(f"{name} must be a number, got {value!r}")
    try:
        return float(value)  # type: ignore[arg-type]
    except _NO_NUMBERS:
        raise ValueError(f"{name} must be a number, got {_shown(value)}") from None


_NO_NUMBERS = (TypeError, ValueError, OverflowError)
"""What NumPy and float() raise for words, for rows of different lengths and for whole numbers that no float can hold."""


def _shown(value: object) -> str:
    """A value as a sentence can show it, at most 60 characters."""
    return f"a number of {value.bit_length()} bits" if isinstance(value, int) and value.bit_length() > 1024 else repr(value)[:60]
