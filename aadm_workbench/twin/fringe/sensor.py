"""What the sensor records of the fringes: photons and read noise, digits, and the exposure that is used."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aadm_workbench.twin.fringe.rig import FringeRig, Sensor

Plane = npt.NDArray[np.float32]
_STEPS = 4  # quarter turns of each phase


@dataclass(frozen=True, eq=False)
class Recorded:
    """``phases`` (k, h, w) rad, -pi..pi, one per number of periods; NaN where the pixel is not trusted.

    ``amplitude`` (h, w): of the finest fringes, over the full scale at the middle exposure, NaN likewise.
    """

    phases: Plane
    amplitude: Plane


def recorded(light: Plane, reference: float, rig: FringeRig, rng: np.random.Generator) -> Recorded:
    """Record light (h, w, 1 + 2 k) with every exposure and keep, per pixel, the brightest that is not saturated.

    ``reference`` is the light of lit concrete, for which the middle exposure is made.
    """
    sensor = rig.sensor
    electrons = sensor.full_well * sensor.exposed_for / reference
    count = len(rig.fringes.periods)
    phases = np.full((count, *light.shape[:2]), np.nan, np.float32)
    amplitude = np.full(light.shape[:2], np.nan, np.float32)
    open_yet = np.ones(light.shape[:2], bool)
    for exposure in sorted(sensor.exposures, reverse=True):
        digits = [_digits(light, k, electrons * exposure, reference, sensor, rng) for k in range(count)]
        full = np.max([images.max(axis=0) for images in digits], axis=0) >= _top(sensor)
        used = open_yet & ~full
        for k, images in enumerate(digits):
            cosine, sine = images[0] - images[2], images[1] - images[3]
            weak = np.hypot(cosine, sine) / 2.0 < sensor.least_modulation * _top(sensor)
            phases[k][used] = np.where(weak, np.nan, np.arctan2(sine, cosine))[used]
            if k == 0:
                amplitude[used] = (np.hypot(cosine, sine) / 2.0 / _top(sensor) / exposure)[used]
        open_yet &= full
    phases[:, np.isnan(phases).any(axis=0)] = np.nan
    amplitude[np.isnan(phases[0])] = np.nan
    return Recorded(phases, amplitude)


def _top(sensor: Sensor) -> int:
    return int(2**sensor.bits - 1)


def _digits(
    light: Plane, k: int, electrons: float, reference: float, sensor: Sensor, rng: np.random.Generator
) -> Plane:
    """The four images (4, h, w) of one number of periods, in digits."""
    constant, cosine, sine = light[..., 0], light[..., 1 + 2 * k], light[..., 2 + 2 * k]
    ambient = np.float32(sensor.ambient * reference)
    images = np.empty((_STEPS, *constant.shape), np.float32)
    for step, wave in enumerate((cosine, sine, -cosine, -sine)):
        caught = np.maximum((0.5 * (constant + wave) + ambient) * np.float32(electrons), 0.0)
        spread = np.sqrt(caught + np.float32(sensor.read_noise**2))
        caught += spread * rng.standard_normal(caught.shape, dtype=np.float32)
        images[step] = np.clip(np.rint(caught * np.float32(_top(sensor) / sensor.full_well)), 0, _top(sensor))
    return images
