"""Names of the array types that signatures use."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = np.ndarray[tuple[Any, ...], np.dtype[np.float64]]
"""Not by numpy's own name for it, which is no type to those who read annotations from numpy 2.5 on."""
FloatArray: TypeAlias = npt.NDArray[np.floating[Any]]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
IntArray: TypeAlias = npt.NDArray[np.int64]
Vector2: TypeAlias = tuple[float, float]
Vector3: TypeAlias = tuple[float, float, float]
Json: TypeAlias = "dict[str, Json] | list[Json] | str | int | float | bool | None"
"""What a JSON text holds."""
Figure: TypeAlias = str | float | int | bool | None
"""What stands behind a name where a report lists whatever an extraction or a finding tells."""
Figures: TypeAlias = Mapping[str, Figure | tuple[Figure, ...]]
