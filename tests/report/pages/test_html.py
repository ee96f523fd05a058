"""report.html: self-contained, inert, complete, small, and fluid in a real browser."""

import copy
import html
import json
import re
import string
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pypdf
import pytest

from aadm_workbench.report.pages.html import html_text, write_html
from tests.report.browser import chromium
from tests.report.checked_floor import HOSTILE
from tests.report.typed import typed

HOSTILE_NAMES = (
    HOSTILE,
    "</script><script>window.hacked=1</script>",
    '"><img src=x onerror="window.hacked=1">',
    "' onload='window.hacked=1",
    "<!--<script>",
    "\u2028\x01{{ 7*7 }}{% raw %}",
    "</title><style>*{display:none}",
    "javascript:window.hacked=1",
)


class Seen(HTMLParser):
    """Tags, attributes that load or run something, and the text of a document."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str]] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += [(name, value or "") for name, value in attrs]

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.fixture
def hostile(floor: dict[str, Any]) -> dict[str, Any]:
    """The floor with hostile names wherever a name can stand."""
    for column, name in zip(floor["columns"], HOSTILE_NAMES, strict=True):
        column |= {"id": f"{name} {column['id']}", "piece_mark": name, "storey": name, "global_id": name}
        column["reasons"] = [*column["reasons"], name]
        for kind in ("sleeves", "rebars"):
            if column[kind]:
                column[kind] |= {"source": name, "notes": [name], "quality": {name: name}}
    floor["job"]["name"] = floor["capture"]["operator"] = " ".join(HOSTILE_NAMES)
    floor["mould_drift"][0] |= {"piece_mark": HOSTILE, "conclusion": HOSTILE}
    return floor


def test_nothing_is_loaded_and_no_name_is_markup(hostile: dict[str, Any]) -> None:
    seen = Seen(html_text(typed(hostile)))
    assert seen.tags.count("script") == 3
    assert seen.tags.count("style") == 1
    assert not {"img", "link", "iframe", "object", "embed", "base", "form"} & set(seen.tags)
    names = {name for name, _ in seen.attributes}
    assert not {"src", "srcset", "style", "onclick", "onload", "onerror", "action"} & names
    assert all(value.startswith("#") for name, value in seen.attributes if name == "href")
    for name in HOSTILE_NAMES:
        assert name.strip("\x01") in seen.text.replace("\x01", "") or name in html.unescape(seen.text)


def test_what_a_model_does_not_say_is_left_empty(floor: dict[str, Any]) -> None:
    for column in floor["columns"]:
        column |= {"grid": None, "storey": None, "piece_mark": None}
    assert "None" not in Seen(html_text(typed(floor))).text.replace("None of", "")


def test_policy_lets_run_only_what_stands_in_the_file(floor: dict[str, Any]) -> None:
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', html_text(typed(floor)))
    assert policy is not None
    said = html.unescape(policy[1])
    assert said.startswith("default-src 'none'; script-src 'sha256-")
    assert "unsafe" not in said
    assert "http" not in said


def test_same_bytes(floor: dict[str, Any]) -> None:
    assert html_text(typed(floor)) == html_text(typed(copy.deepcopy(floor)))


def test_every_number_clause_and_hash_is_there(floor: dict[str, Any]) -> None:
    text = Seen(html_text(typed(floor))).text
    for column in floor["columns"]:
        assert column["id"] in text
        for reason in column["reasons"]:
            assert reason in text
        for kind in ("sleeves", "rebars"):
            if column[kind] is not None:
                assert column[kind]["sha256"] in text
    for rule in floor["profile"]["rules"]:
        assert rule["clause"] in text
    for said in ("minimax", "least squares", "Feasible window", "Cpk", "unverified", floor["model"]["sha256"]):
        assert said in text


def hundred(floor: dict[str, Any]) -> dict[str, Any]:
    """A hundred columns with everything in them."""
    whole = [column for column in floor["columns"] if column["trial_assembly"] is not None and column["grid"]]
    columns = []
    for number in range(100):
        column = copy.deepcopy(whole[number % len(whole)])
        letter = string.ascii_uppercase[number // 10]
        column |= {"id": f"C-{number + 1}", "grid": f"{letter}/{number % 10 + 1}"}
        column["T_model_column"][0][3], column["T_model_column"][1][3] = 6e3 * (number % 10), 7e3 * (number // 10)
        columns.append(column)
    return floor | {"columns": columns}


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


@pytest.fixture
def page(browser: Any) -> Iterator[Any]:
    """A page that keeps what it asked for, what went wrong in it, and whether a name ran."""
    # A click aims at where things stand: in the middle of a gliding scroll it falls on something else.
    page = browser.new_page(viewport={"width": 1280, "height": 900}, reduced_motion="reduce")
    page.requests, page.errors = [], []
    page.on("request", lambda request: page.requests.append(request.url))
    page.on("pageerror", lambda error: page.errors.append(str(error)))
    page.on("console", lambda message: page.errors.append(message.text) if message.type == "error" else None)
    yield page
    page.close()


def opened(page: Any, report: dict[str, Any], folder: Path, name: str = "report.html") -> str:
    path = folder / name
    write_html(typed(report), path)
    address = path.as_uri()
    page.goto(address)
    return address


def test_in_the_browser_nothing_runs_but_the_report(page: Any, hostile: dict[str, Any], tmp_path: Path) -> None:
    address = opened(page, hostile, tmp_path)
    page.click("#open-all")
    page.click("#language")
    page.wait_for_timeout(200)
    assert page.evaluate("window.hacked") is None
    assert page.requests == [address]
    assert page.errors == []
    assert page.locator(".col").count() == 8


def test_filter_search_and_links(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    opened(page, floor, tmp_path)
    assert page.locator("h2").first.inner_text() == "5 of 8 columns must not be hoisted"
    shown = page.locator(".col:visible")
    assert shown.count() == 8
    page.check("#fails")
    assert shown.count() == 5
    page.fill("#search", "a/3")
    assert shown.count() == 1
    assert shown.locator(".id").inner_text() == "C-3"
    page.fill("#search", "nothing like it")
    assert page.locator("#nothing").is_visible()
    page.fill("#search", "")
    page.uncheck("#fails")
    page.locator("svg.plan a", has_text="C-4").click()
    body = page.locator(".col", has=page.locator(".id", has_text="C-4")).locator(".body")
    assert body.is_visible()
    assert page.locator(".col .body:visible").count() == 2  # and the worst, which is open from the start
    assert page.errors == []


def test_language(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    opened(page, floor, tmp_path)
    page.click("#language")
    # On a machine without any Chinese font the one in the file is used.
    assert page.evaluate("document.fonts.load('16px AADM', '柱').then(fonts => fonts.length)") == 1
    assert page.locator("h2").first.inner_text() == "8 根柱中有 5 根不得吊装"
    assert "合格" in page.locator("#list").inner_text()
    assert page.locator("#list tbody tr").nth(1).inner_text().count("挡住就位") == 1
    # What is still Western are names, clauses, labels, numbers, file names, and the notes of the tolerance profile.
    shown = page.locator("main").inner_text().partition("允许偏差依据")[0]
    left = re.findall(r"\b(?:must|column|pass|fail|limit|design|measured|reasons?)\b", shown)
    assert not left
    page.click("#language")
    assert page.locator("h2").first.inner_text() == "5 of 8 columns must not be hoisted"
    assert page.errors == []


@pytest.mark.parametrize(("motion", "scrolling"), [("reduce", "auto"), ("no-preference", "smooth")])
def test_pages_glide_only_for_those_who_want_it(
    page: Any, floor: dict[str, Any], tmp_path: Path, motion: str, scrolling: str
) -> None:
    page.emulate_media(reduced_motion=motion)
    opened(page, floor, tmp_path)
    assert page.evaluate("getComputedStyle(document.documentElement).scrollBehavior") == scrolling


def test_nothing_moves_while_the_page_is_scrolled(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    """What a person is about to click stays where it is, also under a column that was open from the start."""
    opened(page, floor, tmp_path)
    heights = []
    for place in (0, 1, 0.5, 1):
        page.evaluate("share => scrollTo(0, share * document.documentElement.scrollHeight)", place)
        page.wait_for_timeout(150)
        heights.append(page.evaluate("document.documentElement.scrollHeight"))
    assert len(set(heights)) == 1, heights


def test_chinese_in_an_english_page_is_no_row_of_boxes(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    """Names of columns, and the button that asks for Chinese, on a machine without any Chinese font, too."""
    opened(page, floor, tmp_path)
    page.wait_for_function("document.fonts.status === 'loaded'")
    session = page.context.new_cdp_session(page)
    session.send("DOM.enable")
    session.send("CSS.enable")
    root = session.send("DOM.getDocument")["root"]["nodeId"]
    button = session.send("DOM.querySelector", {"nodeId": root, "selector": "#language"})
    assert page.locator("#language").inner_text() == "中文"
    fonts = session.send("CSS.getPlatformFontsForNode", {"nodeId": button["nodeId"]})["fonts"]
    assert [font["familyName"] for font in fonts if "DejaVu" in font["familyName"]] == []
    assert sum(font["glyphCount"] for font in fonts) == 2


def test_view_of_the_points_is_drawn_and_turns(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    opened(page, floor, tmp_path)
    page.locator(".col .head").nth(1).click()
    canvas = page.locator(".col canvas").nth(0)
    canvas.scroll_into_view_if_needed()
    page.wait_for_timeout(200)
    drawn = "canvas => canvas.toDataURL()"
    empty = page.evaluate(
        "() => { const c = document.createElement('canvas'); c.width = c.height = 600; return c.toDataURL(); }"
    )
    before = canvas.evaluate(drawn)
    assert before != empty
    box = canvas.bounding_box()
    page.mouse.move(box["x"] + 50, box["y"] + 50)
    page.mouse.down()
    page.mouse.move(box["x"] + 150, box["y"] + 90)
    page.mouse.up()
    page.wait_for_timeout(100)
    assert canvas.evaluate(drawn) != before
    assert page.errors == []


def test_prints_every_column_on_a4(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    opened(page, floor | {"columns": floor["columns"][:2]}, tmp_path)
    page.pdf(path=tmp_path / "printed.pdf", prefer_css_page_size=True, print_background=True)
    printed = pypdf.PdfReader(tmp_path / "printed.pdf")
    assert {(round(sheet.mediabox.width), round(sheet.mediabox.height)) for sheet in printed.pages} == {(595, 842)}
    text = "".join(sheet.extract_text() for sheet in printed.pages)
    # Closed columns are printed, too.
    assert text.count("Feasible window") == 2
    assert "R10 is 2.60 mm from design" in text
    assert "Drag to turn" not in text


def test_what_was_not_measured_takes_no_page_of_its_own_in_print(
    page: Any, floor: dict[str, Any], tmp_path: Path
) -> None:
    error = floor["columns"][4]
    many = [error | {"id": f"E-{number}"} for number in range(4)]
    opened(page, floor | {"columns": [floor["columns"][0], *many]}, tmp_path)
    page.pdf(path=tmp_path / "printed.pdf", prefer_css_page_size=True)
    texts = [sheet.extract_text() for sheet in pypdf.PdfReader(tmp_path / "printed.pdf").pages]
    # What may be hoisted stands with the rest of the headline.
    assert "1 may be hoisted" in texts[0]
    assert any(text.count("it could not be checked") == 4 for text in texts[1:])


def test_fits_small_screens(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    opened(page, floor | {"columns": floor["columns"][:3]}, tmp_path)
    page.click("#open-all")
    for width in (390, 768):
        page.set_viewport_size({"width": width, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_a_long_name_does_not_widen_the_page(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    cleared = next(c for c in floor["columns"] if c["verdict"] == "pass" and c["goes_on"] == "pass")
    opened(page, floor | {"columns": [cleared | {"id": "x" * 300}]}, tmp_path)
    page.set_viewport_size({"width": 390, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_hundred_columns(page: Any, floor: dict[str, Any], tmp_path: Path) -> None:
    """Below 3 MB, and the search finds the one column that is asked for."""
    opened(page, hundred(floor), tmp_path)
    assert (tmp_path / "report.html").stat().st_size < 3_000_000
    page.fill("#search", "c-77")
    assert page.locator(".col:visible").count() == 1


def test_no_number_is_lost_between_report_and_3d_view(floor: dict[str, Any]) -> None:
    views = re.search(r'id="views">(.*?)</script>', html_text(typed(floor)))
    assert views is not None
    scenes = json.loads(views[1])
    assert len(scenes) == 7
    assert sum(len(scene["points"]) for scene in scenes.values()) == 6 * 24 + 12
