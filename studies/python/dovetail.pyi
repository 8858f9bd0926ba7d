"""Stubs of the module dovetail; what keywords mean is in help() and in `dovetail COMMAND --help`."""
import os
from collections.abc import Callable, ItemsView, Iterator, KeysView, Mapping, Sequence, ValuesView
from typing import Any

import numpy as np
import numpy.typing as npt

__version__: str

_Path = str | os.PathLike[str]
_Number = int | float | str  # a number as a text, or a word: "auto"
_Reals = npt.NDArray[np.float64]
_Whole = npt.NDArray[np.int32]

class InputError(ValueError): ...

class Answer(Mapping[str, Any]):
    @property
    def remarks(self) -> list[str]: ...
    @property
    def converged(self) -> bool: ...
    def keys(self) -> KeysView[str]: ...
    def items(self) -> ItemsView[str, Any]: ...
    def values(self) -> ValuesView[Any]: ...
    def get(self, key: str, default: Any = None) -> Any: ...
    def __getitem__(self, key: str) -> Any: ...
    def __getattr__(self, name: str) -> Any: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __contains__(self, key: object) -> bool: ...

class Contact:
    wear_law: str
    @property
    def normal(self) -> _Whole: ...  # [Nc]
    @property
    def tangential(self) -> _Whole: ...  # [Nc, d-1]
    @property
    def area(self) -> _Reals: ...  # [Nc] m^2
    @property
    def gap(self) -> _Reals: ...  # [Nc] m
    @property
    def friction(self) -> _Reals: ...  # [Nc]
    @property
    def wear_coefficient(self) -> _Reals: ...  # [Nc] 1/Pa or m^3/J
    @property
    def wear_threshold(self) -> _Reals: ...  # [Nc] J/m^2, or empty
    @property
    def position(self) -> _Reals: ...  # [Nc, 3] m, or empty
    @property
    def group(self) -> _Whole: ...  # [Nc], or empty
    @property
    def slip_origin(self) -> _Reals: ...  # [Nc, d-1] m
    def __len__(self) -> int: ...

class Model:
    @staticmethod
    def read(path: _Path) -> Model: ...
    def write(self, path: _Path) -> None: ...
    @property
    def mass(self) -> _Reals: ...  # [n, n] kg
    @property
    def damping(self) -> _Reals: ...  # [n, n] N s/m
    @property
    def stiffness(self) -> _Reals: ...  # [n, n] N/m
    @property
    def static_force(self) -> _Reals: ...  # [n] N
    @property
    def cosine_force(self) -> _Reals: ...  # [H, n] N
    @property
    def sine_force(self) -> _Reals: ...  # [H, n] N
    @property
    def output_vectors(self) -> _Reals: ...  # [n_out, n]
    @property
    def output_names(self) -> list[str]: ...
    @property
    def contact(self) -> Contact: ...
    def __len__(self) -> int: ...

class Study:
    def __init__(self, path: _Path) -> None: ...
    @property
    def path(self) -> str: ...
    def set(self, key: str, value: Any) -> None: ...
    def warnings(self) -> list[str]: ...
    def evaluate(
        self,
        *,
        no_bars: bool = False,
        no_history: bool = False,
        unworn: bool = False,
        harmonics: _Number | None = None,
        samples: _Number | None = None,
        tolerance: _Number | None = None,
        pseudo_penalty: _Number | None = None,
        pseudo_penalty_normal: _Number | None = None,
        solver: str | None = None,
        accuracy: float | None = None,
        json_log: _Path | None = None,
    ) -> Answer: ...
    def reduce(self) -> Model: ...

def response(
    input: Model | Study | _Path,
    frequencies: float | Sequence[float] | _Reals,
    *,
    arclength: bool = False,
    error_bars: bool = False,
    penalty_sensitivity: bool = False,
    stability: bool = False,
    traction_bounds: bool = False,
    harmonics: _Number | None = None,
    samples: _Number | None = None,
    tolerance: _Number | None = None,
    pseudo_penalty: _Number | None = None,
    pseudo_penalty_normal: _Number | None = None,
    solver: str | None = None,
    accuracy: float | None = None,
    json_log: _Path | None = None,
) -> Answer: ...
def wear(
    input: Model | Study | _Path,
    *,
    method: str | None = None,
    frequency: float | None = None,
    follow: str | None = None,
    band_from: float | None = None,
    band_to: float | None = None,
    band_points: int | None = None,
    cycles: float | None = None,
    steps: int | None = None,
    increment: float | None = None,
    integrator: str | None = None,
    history_tolerance: float | None = None,
    resume: _Path | None = None,
    curves: int | None = None,
    curve_points: int | None = None,
    curve_from: float | None = None,
    curve_to: float | None = None,
    error_bars: bool = False,
    spread: bool = False,
    harmonics: _Number | None = None,
    samples: _Number | None = None,
    tolerance: _Number | None = None,
    pseudo_penalty: _Number | None = None,
    pseudo_penalty_normal: _Number | None = None,
    solver: str | None = None,
    accuracy: float | None = None,
    json_log: _Path | None = None,
) -> Answer: ...
def run(
    study: Study,
    directory: _Path,
    callback: Callable[[int, Answer, int | None], bool | None] | None = None,
    *,
    resume: bool = False,
    jobs: int | None = None,
    patience: float | None = None,
    part: str | None = None,
    json_log: _Path | None = None,
) -> dict[str, Any]: ...
