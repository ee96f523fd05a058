"""Headless Chromium, as Debian packages it."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest


@contextmanager
def chromium() -> Iterator[Any]:
    """A browser; without one the test fails, or is left out where AADM_SKIP_CHROMIUM=1 asks for it."""
    program = next(
        (path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None
    )
    if program is None:
        if os.environ.get("AADM_SKIP_CHROMIUM") == "1":
            pytest.skip("Chromium is not installed, and AADM_SKIP_CHROMIUM=1")
        pytest.fail("Chromium is not installed (apt-get install chromium); AADM_SKIP_CHROMIUM=1 leaves this test out")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        # Root may not use its sandbox, and virtual machines have no graphics.
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox", "--disable-gpu"])
        yield browser
        browser.close()
