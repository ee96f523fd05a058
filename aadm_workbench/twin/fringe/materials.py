"""What the surfaces of a scene are made of, as descriptions of reflection that Mitsuba knows."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

from aadm_workbench.twin.surface import BAR, CONCRETE, DARK, FLOOR, OBJECT, SLEEVE_WALL, TAPE


@dataclass(frozen=True)
class Metal:
    """A metal that is partly covered with dirt, oxide or rust.

    ``roughness`` is GGX's alpha, ``reflectance`` that of the bare metal, ``cover`` the share that is covered and
    ``cover_albedo`` its diffuse reflectance.
    """

    roughness: float = 0.3
    reflectance: float = 0.6
    cover: float = 0.2
    cover_albedo: float = 0.2


SLEEVE_METALS = MappingProxyType(
    {
        "steel": Metal(0.3, 0.6, 0.2, 0.2),
        "dull": Metal(0.5, 0.4, 0.7, 0.12),
        "shiny": Metal(0.15, 0.7, 0.0, 0.2),
        "zinc": Metal(0.25, 0.8, 0.35, 0.45),
    }
)
"""Insides of sleeves by name: as cast or turned, dirty, freshly machined, hot-dip galvanised."""


@dataclass(frozen=True)
class Materials:
    """Albedos and metals of a scene; ``relief`` is the standard deviation of the concrete's height, mm.

    ``mottling``: relative standard deviation of the concrete's albedo.
    """

    concrete: float = 0.35
    sleeve: Metal = SLEEVE_METALS["steel"]
    bar: Metal = Metal(0.4, 0.5, 0.6, 0.2)
    relief: float = 0.05
    mottling: float = 0.12


Bsdf: TypeAlias = "dict[str, Bsdf | str | float | list[float]]"
"""A surface as Mitsuba takes its description."""


def has_relief(kind: int) -> bool:
    """Whether a kind of surface is cast, and so has a relief and stains."""
    return kind in (CONCRETE, FLOOR)


def bsdf_of(kind: int, materials: Materials) -> Bsdf:
    """Mitsuba's description of a kind of surface."""
    if kind == SLEEVE_WALL:
        return _metal(materials.sleeve)
    if kind == BAR:
        return _metal(materials.bar)
    albedo = {CONCRETE: materials.concrete, FLOOR: materials.concrete, TAPE: 0.5, OBJECT: 0.4, DARK: 0.01}[kind]
    return _two_sided(_diffuse(albedo))


def _metal(metal: Metal) -> Bsdf:
    bare: Bsdf = {
        "type": "roughconductor",
        "distribution": "ggx",
        "alpha": metal.roughness,
        "material": "none",
        "specular_reflectance": {"type": "uniform", "value": metal.reflectance},
    }
    blend: Bsdf = {"type": "blendbsdf", "weight": metal.cover, "bare": bare, "cover": _diffuse(metal.cover_albedo)}
    return _two_sided(blend)


def _diffuse(albedo: float) -> Bsdf:
    return {"type": "diffuse", "reflectance": {"type": "uniform", "value": albedo}}


def _two_sided(bsdf: Bsdf) -> Bsdf:
    return {"type": "twosided", "inside": bsdf}
