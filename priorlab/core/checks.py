"""A user's mistake gets one clear sentence: the name, the rule and the value."""

from __future__ import annotations

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


def check_whole(name: str, value: float, least: int = 1) -> int:
    """Return `value` as an int, or say that it is not a whole number of at least `least`.

    >>> check_whole("repeats", 3.0)
    3
    """
    number = as_float(name, value)
    if not (number.is_integer() and number >= least):
        raise ValueError(f"{name} must be a whole number of at least {least}, got {number:g}")
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


def check_rng(rng: object) -> np.random.Generator:
    """Return the generator, or say that chance must be handed over as one."""
    if not isinstance(rng, np.random.Generator):
        raise ValueError(f"rng must be a numpy Generator, as numpy.random.default_rng(0) makes it, got {rng!r}")
    return rng


def check_record(name: str, value: object, kind: type) -> None:
    """Say when something else stands where a record belongs; an array has none of its names.

    >>> check_record("log", [1, 2], dict)
    Traceback (most recent call last):
    ValueError: log must be a dict, got list
    """
    if not isinstance(value, kind):
        raise ValueError(f"{name} must be a {kind.__name__}, got {type(value).__name__}")


def check_image(name: str, image: ArrayLike, dtype: type = bool) -> NDArray:
    """Return a 2-D array of `dtype` with at least one pixel, or say what is wrong with it."""
    array = np.asarray(image)
    if array.ndim != 2 or array.size == 0:
        raise ValueError(f"{name} must be a 2-D image with at least one pixel, got shape {array.shape}")
    return array.astype(dtype, copy=False)


def check_poses(name: str, poses: ArrayLike) -> NDArray[np.float64]:
    """Return finite (N, 3) poses x, y, theta, or say what is wrong with them."""
    try:
        array = np.asarray(poses, dtype=np.float64)
    except (TypeError, ValueError):  # words, or rows of different lengths
        raise ValueError(f"{name} must be rows of three numbers x, y, theta, got {str(poses)[:60]}") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have shape (N, 3) for x, y, theta, got shape {array.shape}")
    if not np.isfinite(array).all():
        row = int(np.flatnonzero(~np.isfinite(array).all(axis=1))[0])
        raise ValueError(f"{name} must be finite numbers, got {array[row].tolist()} in row {row}")
    return array


def as_float(name: str, value: object) -> float:
    """Return `value` as a float, nan included, or say that it is no number; text is none, whatever number it spells."""
    if isinstance(value, str | bytes):
        raise ValueError(f"{name} must be a number, got {value!r}")
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a number, got {value!r}") from None
