"""Every link, picture, anchor and file that the documentation names is there; the site builds without a warning."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from .pages import DOCS, LANGUAGES, ROOT, all_pages, anchors, codes, inline_codes, links, pages

TOPS = ("aadm_workbench", "batch", "benchmarks", "docs", "requirements", "samples", "tests")
MADE = ("samples/floor/job-report", "samples/lab/job-report")


def named(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", all_pages(), ids=named)
def test_links_lead_somewhere(page: Path) -> None:
    for link in links(page):
        if link.startswith(("http://", "https://")):
            continue
        place, _, anchor = link.partition("#")
        target = (page.parent / place).resolve() if place else page
        assert target.exists(), f"{link}: there is nothing"
        assert target.is_relative_to(ROOT), f"{link}: leads out of the project"
        if anchor:
            assert anchor in anchors(target), f"{link}: {named(target)} has no such heading"


@pytest.mark.parametrize("page", all_pages(), ids=named)
def test_files_that_are_named_exist(page: Path) -> None:
    for code in inline_codes(page):
        if code.startswith(tuple(f"{top}/" for top in TOPS)) and re.fullmatch(r"[\w./-]+", code):
            assert code.startswith(MADE) or (ROOT / code).exists(), f"{code}: there is no such file"


@pytest.mark.parametrize("page", [*pages("en"), *pages("zh")], ids=named)
def test_modules_are_named_by_their_whole_path(page: Path) -> None:
    # A move of files can then be carried through the pages mechanically.
    short = [code for code in inline_codes(page) if re.fullmatch(r"[\w/]+\.py", code) and "/" not in code]
    assert short == []


def test_what_a_page_shows_as_a_script_exists() -> None:
    for page in all_pages():
        for code in codes(page):
            for script in re.findall(r"^(?:sh|\S*python) ((?:\w+/)+\w+\.(?:sh|py))", code.text, flags=re.MULTILINE):
                assert (ROOT / script).exists(), f"{named(page)}, line {code.line}: {script}"


def test_readme_is_short() -> None:
    for _, readme in LANGUAGES.values():
        assert len(readme.read_text(encoding="utf-8").splitlines()) <= 180, readme.name


def test_every_chinese_page_has_its_english_one_and_they_lead_to_each_other() -> None:
    for page in sorted((DOCS / "zh").glob("*.md")):
        english = DOCS / page.name
        assert english.exists(), f"{page.name} has no English page"
        assert f"zh/{page.name}" in links(english), f"{named(english)} does not lead to its Chinese"
        assert f"../{page.name}" in links(page), f"{named(page)} does not lead to its English"


def test_the_site_builds_without_a_warning(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path / "site")]
    quiet = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(command, cwd=ROOT, env=quiet, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "site" / "zh" / "jobs" / "index.html").exists()
    architecture = (tmp_path / "site" / "architecture" / "index.html").read_text(encoding="utf-8")
    assert 'class="mermaid"' in architecture
    accuracy = (tmp_path / "site" / "accuracy" / "index.html").read_text(encoding="utf-8")
    assert "benchmarks/verdict.py" in accuracy, "what lies beside the code is not on the site"
