"""What views say of their camera: one that bends, one that is not that of its profile, and one that is sound."""

from dataclasses import replace

from tests.assembly.test_findings import found_in, group, square


def test_a_camera_that_bends_or_is_not_that_of_its_profile_is_told() -> None:
    sound = group(square())
    seen = {
        "camera_bends": {"camera_bend_mm": 0.3, "camera_bend_u_mm": 0.03, "camera_bend_stated_u_mm": 0.06},
        "profile_differs": {"learned_edges_off_pixels": -1.1},
    }
    for code, quality in (*seen.items(), ("profile_differs", {"learned_rings_off": 1.0})):
        told = replace(sound, extraction=replace(sound.extraction, quality={**sound.extraction.quality, **quality}))
        (found,) = found_in(told)
        assert found.code == code
        assert found.holds_back
    older = {**sound.extraction.quality, "learned_by_laws": 0}
    (found,) = found_in(replace(sound, extraction=replace(sound.extraction, quality=older)))
    assert (found.code, found.holds_back) == ("profile_of_other_laws", False)
    assert found.values["laws"] == 0
    quiet = {
        "camera_bend_mm": 0.03,
        "camera_bend_u_mm": 0.02,
        "learned_edges_off_pixels": 0.5,
        "learned_rings_off": -0.3,
    }
    told = replace(sound, extraction=replace(sound.extraction, quality={**sound.extraction.quality, **quiet}))
    assert found_in(told) == []
