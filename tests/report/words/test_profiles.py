"""The title of every profile that ships is told in Chinese; one of people's own keeps its words."""

import pytest

from aadm_workbench.assembly.tolerances import load_profile, profile_names
from aadm_workbench.report.words.labels import profile_words


@pytest.mark.parametrize("name", profile_names())
def test_shipped_profiles_are_told_in_chinese(name: str) -> None:
    title = load_profile(name).title
    said = profile_words(name, title)
    assert said.en == title
    assert said.zh != title


def test_a_profile_of_people_keeps_its_title() -> None:
    assert profile_words("cn", "Our own limits").zh == "Our own limits"
