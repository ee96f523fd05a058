"""The job file: all of its keys are understood, and whatever is wrong with it is named with its line."""

import hashlib
from pathlib import Path

import pytest

from aadm_workbench.errors import JobError
from aadm_workbench.inspection.job import JobColumn, JobModel
from aadm_workbench.model import Camera
from batch.job.file import read_job

EVERYTHING = """\
schema = 1
name = "Floor 3, axis C"
units = "m"
tolerances = "cn-tcces30-2022"
decision = "simple"
checks = ["trial", "sleeves"]
turns = true

[model]
path = "floor3.ifc"
columns = "IfcColumn"
sleeves = "IfcDiscreteAccessory, Name=/套筒|sleeve/"
rebars = "IfcReinforcingBar"

[camera]
fx = 2425.48
fy = 2425.33
cx = 959.74
cy = 632
width = 1920
height = 1200
depth_scale_mm = 0.02
scale_error = 2e-4

[capture]
date = 2026-11-20
operator = ""
camera_serial = "NEC123"

[[columns]]
id = "C-301"
sleeves = "scans/C-301-foot.tiff"
rebars = ["scans/C-301-bars-1.tiff", "scans/C-301-bars-2.tiff"]
hoisting = ["scans/C-301-hoist-1.tiff"]
sleeves_image = "scans/C-301-foot.png"
rebars_image = "scans/C-301-bars.png"
up = "+y"
near = "-x-y"

[[columns]]
id = "C-302"
sleeves = "scans/C-302-foot.ply"
up = "-x"
rebars_up = 12.5
axes = "opengl"
[columns.design]
sleeve_diameter = 36
rebar_diameter = 20.0
rebar_outer_diameter = 23.5
embedded_length = 160.0
size = [600.0, 600.0]
centres = [[0.0, 0.0], [160.0, 0.0], [160.0, 160.0]]
"""


def written(folder: Path, text: str) -> Path:
    """A job file with some text."""
    path = folder / "job.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_every_key_is_understood(tmp_path: Path) -> None:
    path = written(tmp_path, EVERYTHING)
    job = read_job(path)
    assert (job.name, job.units, job.profile.name, job.decision) == (
        "Floor 3, axis C",
        "m",
        "cn-tcces30-2022",
        "simple",
    )
    assert (job.checks, job.turns, job.folder) == (("sleeves", "trial"), True, tmp_path)
    assert job.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
    assert job.model == JobModel(
        "floor3.ifc", "IfcColumn", "IfcDiscreteAccessory, Name=/套筒|sleeve/", "IfcReinforcingBar"
    )
    assert job.camera == Camera(2425.48, 2425.33, 959.74, 632.0, 1920, 1200, 2e-4)
    assert job.depth_scale_mm == 0.02
    assert job.capture == {"date": "2026-11-20", "operator": "", "camera_serial": "NEC123"}
    first, second = job.columns
    assert first.sleeves == ("scans/C-301-foot.tiff",)
    assert first.rebars == ("scans/C-301-bars-1.tiff", "scans/C-301-bars-2.tiff")
    assert first.hoisting == ("scans/C-301-hoist-1.tiff",)
    assert (first.sleeves_image, first.rebars_image) == ("scans/C-301-foot.png", "scans/C-301-bars.png")
    assert (first.sleeves_up_deg, first.rebars_up_deg, first.near, first.design) == (90.0, 90.0, (-1, -1), None)
    assert (second.sleeves_up_deg, second.rebars_up_deg, second.near) == (180.0, 12.5, None)
    assert (first.axes, second.axes) == (None, "opengl")
    assert second.files() == ("scans/C-302-foot.ply",)
    assert second.design is not None
    assert [point.label for point in second.design.rebars] == ["R1", "R2", "R3"]
    assert second.design.embedded_length_mm == 160.0


FRAMES_JOB = """\
schema = 1
model = { path = "m.ifc" }
[[columns]]
id = "C"
near = "-x-y"
hoisting = HOISTING
"""


@pytest.mark.parametrize(
    ("hoisting", "files", "corners"),
    [
        ('"a.tiff"', ("a.tiff",), ((-1, -1),)),
        ('["a.tiff", "b.tiff"]', ("a.tiff", "b.tiff"), ((-1, -1), (-1, -1))),
        ('[{file = "a.tiff", near = "+x-y"}, "b.tiff"]', ("a.tiff", "b.tiff"), ((1, -1), (-1, -1))),
        ('[{file = "a.tiff"}, {file = "a.tiff", near = "+x+y"}]', ("a.tiff", "a.tiff"), ((-1, -1), (1, 1))),
        ('{file = "a.tiff", near = "-x+y"}', ("a.tiff",), ((-1, 1),)),
    ],
)
def test_each_frame_may_have_its_own_corner(
    tmp_path: Path, hoisting: str, files: tuple[str, ...], corners: tuple[tuple[int, int], ...]
) -> None:
    (column,) = read_job(written(tmp_path, FRAMES_JOB.replace("HOISTING", hoisting))).columns
    assert (column.hoisting, column.hoisting_near) == (files, corners)


@pytest.mark.parametrize(
    ("hoisting", "message"),
    [
        ('[{file = "a.tiff", near = "x"}]', "line 6: near must be one of the corners"),
        ('[{near = "+x-y"}]', "line 6: a frame of hoisting has no file"),
        ('[\n{file = "a.tiff"},\n{file = "b.tiff", neer = "+x-y"}]', 'line 8: unknown key "neer"'),
        ("[{file = 3}]", "line 6: file must be text"),
        ('[{file = "a.tiff"}, 3]', "line 6: hoisting must hold files or"),
        ("3", "line 6: hoisting must be text in quotes or a list of texts"),
    ],
)
def test_a_wrong_frame_names_its_line(tmp_path: Path, hoisting: str, message: str) -> None:
    with pytest.raises(JobError) as caught:
        read_job(written(tmp_path, FRAMES_JOB.replace("HOISTING", hoisting)))
    assert message in str(caught.value)


def test_what_is_not_said(tmp_path: Path) -> None:
    job = read_job(written(tmp_path, 'schema = 1\n[model]\npath = "m.ifc"\n[[columns]]\nid = "C"\n'))
    assert (job.name, job.units, job.profile.name, job.decision) == ("job", "mm", "cn", "guarded")
    assert (job.checks, job.turns, job.camera, job.depth_scale_mm, job.capture) == (None, False, None, None, {})
    column: JobColumn = job.columns[0]
    assert (column.sleeves, column.rebars, column.sleeves_up_deg) == ((), (), None)


@pytest.mark.parametrize(
    ("written_up", "degrees"), [('"+x"', 0), ('"+y"', 90), ('"-x"', 180), ('"-y"', -90), ("30", 30)]
)
def test_up(tmp_path: Path, written_up: str, degrees: float) -> None:
    job = read_job(written(tmp_path, EVERYTHING.replace('up = "+y"', f"up = {written_up}")))
    assert job.columns[0].sleeves_up_deg == degrees


def test_marks_and_line_ends_of_windows(tmp_path: Path) -> None:
    path = tmp_path / "job.toml"
    path.write_bytes(b"\xef\xbb\xbf" + EVERYTHING.replace("\n", "\r\n").encode())
    assert read_job(path).columns[1].id == "C-302"
    path.write_bytes(
        b"\xef\xbb\xbf" + EVERYTHING.replace("turns = true", "turms = true").replace("\n", "\r\n").encode()
    )
    with pytest.raises(JobError, match='line 7: unknown key "turms" in the job; did you mean "turns"'):
        read_job(path)


def test_profile_beside_the_job(tmp_path: Path) -> None:
    rule = 'name = "p"\nlimits = "sleeve_position"\nupper_mm = 1.5\nclause = "ours"\nseverity = "shall"'
    text = f'schema = 1\ntitle = "Ours"\n[[rules]]\n{rule}\nsource = "verified"\n'
    (tmp_path / "ours.toml").write_text(text, encoding="utf-8")
    job = read_job(written(tmp_path, EVERYTHING.replace('"cn-tcces30-2022"', '"ours.toml"')))
    assert job.profile.rules[0].upper == 1.5


WRONG = [
    # what is replaced, by what, the line, part of the message
    ("schema = 1", "schema = 2", 1, "schema must be 1, it is 2"),
    ("schema = 1", "schema = true", 1, "schema must be 1"),
    ("schema = 1", "shema = 1", 1, 'unknown key "shema" in the job; did you mean "schema"?'),
    ("schema = 1\n", "", 1, "the job has no schema; add schema = 1"),
    ('name = "Floor 3, axis C"', "name = 3", 2, "name must be text in quotes, it is 3"),
    ('units = "m"', 'units = "inch"', 3, 'units must be "mm" or "m", it is "inch"'),
    ('units = "m"', "units = m", 3, "this is no TOML"),
    ('tolerances = "cn-tcces30-2022"', 'tolerances = "din"', 4, "Unknown tolerance profile 'din'. Built in: cn,"),
    ('tolerances = "cn-tcces30-2022"', 'tolerances = "nowhere.toml"', 4, "nowhere.toml cannot be read"),
    ('decision = "simple"', 'decision = "brave"', 5, 'decision must be "guarded" or "simple"'),
    ('["trial", "sleeves"]', '["trial", "sleeve"]', 6, 'checks holds "sleeve"; it may hold "sleeves"'),
    ('["trial", "sleeves"]', '["trial",\n "trial"]', 7, 'checks holds "trial" twice'),
    ('["trial", "sleeves"]', "[]", 6, "checks is an empty list"),
    ('["trial", "sleeves"]', '"trial"', 6, "checks must be a list of texts"),
    ("turns = true", "turns = 1", 7, "turns must be true or false, it is 1"),
    ('path = "floor3.ifc"\n', "", 9, "[model] has no path"),
    ('path = "floor3.ifc"', "path = 1", 10, "path must be text"),
    ('columns = "IfcColumn"', 'column = "IfcColumn"', 11, 'unknown key "column" in [model]; did you mean "columns"?'),
    ("fy = 2425.33\n", "", 15, "[camera] has no fy"),
    ("fx = 2425.48", "fx = -1.0", 16, "fx must be above zero, it is -1"),
    ("fx = 2425.48", 'fx = "2425"', 16, 'fx must be a number, it is "2425"'),
    ("fx = 2425.48", "fx = nan", 16, "fx must be a number, it is nan"),
    ("cx = 959.74", "cx = 2500.0", 15, "[camera] has its centre"),
    ("width = 1920", "width = 1920.5", 20, "width must be a whole number above zero, it is 1920.5"),
    ("depth_scale_mm = 0.02", "depth_scale_mm = 0", 22, "depth_scale_mm must be above zero"),
    ("depth_scale_mm = 0.02", "depth_scale = 0.02", 22, 'did you mean "depth_scale_mm"?'),
    ("scale_error = 2e-4", "scale_error = -1e-4", 23, "scale_error must not be below zero"),
    ('operator = ""', "operator = 7", 27, "operator must be text in quotes"),
    ('operator = ""', 'operater = ""', 27, 'did you mean "operator"?'),
    ('id = "C-301"\n', "", 30, "[[columns]] has no id"),
    ('id = "C-301"', "id = 301", 31, "id must be text in quotes, it is 301"),
    ('id = "C-301"', 'id = " "', 31, "id is empty"),
    ('sleeves = "scans/C-301-foot.tiff"', "sleeves = 1", 32, "sleeves must be text in quotes or a list of texts"),
    (
        'sleeves = "scans/C-301-foot.tiff"',
        'sleve = "a"',
        32,
        'unknown key "sleve" in [[columns]]; did you mean "sleeves"?',
    ),
    ('"scans/C-301-bars-2.tiff"]', "\n2]", 34, "rebars must hold texts in quotes, one is 2"),
    ('["scans/C-301-hoist-1.tiff"]', "[]", 34, "hoisting is an empty list"),
    ('sleeves_image = "scans/C-301-foot.png"', 'sleeves_image = ["a.png"]', 35, "sleeves_image must be text"),
    ('up = "+y"', 'up = "y"', 37, 'up must be "+x", "-x", "+y", "-y" or a number of degrees'),
    ('up = "+y"', "up = inf", 37, "up must be"),
    ('near = "-x-y"', 'near = "-x"', 38, "near must be one of the corners"),
    ('id = "C-302"', 'id = "C-301"', 41, 'two columns have the id "C-301": the other stands in line 31'),
    ("rebars_up = 12.5", "rebars_up = true", 44, "rebars_up must be"),
    ('axes = "opengl"', 'axes = "y up"', 45, 'axes must be "camera" or "opengl"'),
    ("sleeve_diameter = 36", "sleeve_diamter = 36", 47, 'did you mean "sleeve_diameter"?'),
    ("sleeve_diameter = 36\n", "", 46, "has no sleeve_diameter"),
    ("sleeve_diameter = 36", "sleeve_diameter = 0", 47, "sleeve_diameter must be above zero"),
    ("rebar_diameter = 20.0", "rebar_diameter = 40.0", 46, "does not enter a sleeve"),
    ("size = [600.0, 600.0]", "size = [600.0]", 51, "size must hold 2 numbers [x, y]"),
    ("centres = [[0.0, 0.0], [160.0, 0.0],", "centres = [[0.0, 0.0],\n[160.0],", 53, "centres must hold 2 numbers"),
    ("centres = [[0.0, 0.0],", 'centres = [[0.0, "0"],', 52, "centres must be a number"),
    ("centres = [[0.0, 0.0], [160.0, 0.0],", "centres = [[160.0, 0.0], [160.0, 0.0],", 46, "are the same point"),
    ('[model]\npath = "floor3.ifc"', "[modell]\npath = 1", 9, 'unknown key "modell" in the job; did you mean "model"?'),
    ("[[columns]]", "[[colums]]", 30, 'unknown key "colums"'),
    ("[[columns]]", "[columns]", 40, "this is no TOML"),
    ("turns = true", "turns = true\nturns = true", 8, "this is no TOML"),
]


@pytest.mark.parametrize(("old", "new", "line", "message"), WRONG, ids=[f"line {case[2]}: {case[3]}" for case in WRONG])
def test_what_is_wrong_is_named_with_its_line(tmp_path: Path, old: str, new: str, line: int, message: str) -> None:
    assert old in EVERYTHING
    path = written(tmp_path, EVERYTHING.replace(old, new))
    with pytest.raises(JobError) as caught:
        read_job(path)
    text = str(caught.value)
    assert text.startswith(f"{path}, line {line}: ")
    assert message in text


def test_no_design_and_no_model(tmp_path: Path) -> None:
    path = written(tmp_path, 'schema = 1\n\n[[columns]]\nid = "C-1"\nsleeves = "a.ply"\n')
    with pytest.raises(JobError, match=r"line 3: column C-1 has no design: add \[columns\.design\]"):
        read_job(path)


def test_no_columns(tmp_path: Path) -> None:
    with pytest.raises(JobError, match="line 1: the job has no columns"):
        read_job(written(tmp_path, "schema = 1\n"))
    with pytest.raises(JobError, match=r"line 2: columns must be written as \[\[columns\]\]"):
        read_job(written(tmp_path, 'schema = 1\ncolumns = ["C-1"]\n'))


def test_no_text(tmp_path: Path) -> None:
    path = tmp_path / "job.toml"
    with pytest.raises(JobError, match="there is no such job file"):
        read_job(path)
    with pytest.raises(JobError, match="cannot be read"):
        read_job(tmp_path)
    path.write_bytes('schema = 1\nname = "柱"'.encode("gb18030"))
    with pytest.raises(JobError, match="line 2: this is not UTF-8 text"):
        read_job(path)
