"""The control points of a job: read, in the right unit, and every slip named with its line."""

from dataclasses import replace

import pytest

from aadm_workbench.errors import JobError
from aadm_workbench.model import ColumnReport, ControlPoint, Verdict
from batch.job.file import read_job
from batch.runner.run import RunOptions, run_job
from tests.batch.conftest import HEAD, WriteJob, column_text

GOOD = [("G1", "column", [-800, -700, 0.5], [-790.0, -702.0, 0.5]), ("G2", "column", [900, -600, 0], [910, -602, 0])]
THIRD = ("G3", "column", [700, 850, 0], [710, 848, 0])


def control_text(*points: tuple[str, str, list[float], list[float]], more: str = "") -> str:
    """Control points of the column before them."""
    return "".join(
        f'[[columns.control_points]]\nname = "{name}"\n{where} = {known}\nscan = {scan}\n{more}'
        for name, where, known, scan in points
    )


def with_points(
    write_job: WriteJob, text: str, head: str = HEAD, rebars: str | None = "bars.ply"
) -> list[ControlPoint]:
    """What a job with one column and these control points says."""
    column = column_text("C-1", "foot.ply", rebars)
    return list(read_job(write_job(column + text, head=head)).columns[0].control_points)


def test_read(write_job: WriteJob) -> None:
    first, second, third = with_points(write_job, control_text(*GOOD) + control_text(THIRD, more="u_mm = 0.3\n"))
    assert first == ControlPoint("G1", (-800.0, -700.0, 0.5), (-790.0, -702.0, 0.5), False)
    assert (second.u_mm, third.u_mm) == (None, 0.3)


def test_scan_is_in_the_unit_of_the_scans(write_job: WriteJob) -> None:
    metres = HEAD.replace('"mm"', '"m"')
    first, _ = with_points(write_job, control_text(*GOOD), metres)
    assert first.known_mm == (-800.0, -700.0, 0.5)
    assert first.scan_mm == pytest.approx((-790e3, -702e3, 500.0))


def test_points_of_the_model(write_job: WriteJob) -> None:
    head = HEAD + '[model]\npath = "floor3.ifc"\n'
    text = '[[columns]]\nid = "C-301"\nrebars = "b.ply"\n' + control_text(*GOOD).replace("column =", "model =")
    points = read_job(write_job(text, head=head)).columns[0].control_points
    assert [point.in_model for point in points] == [True, True]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (control_text(GOOD[0]), "one control point gives no position"),
        (control_text(GOOD[0], GOOD[0]), 'two control points have the name "G1"'),
        (
            control_text(*GOOD).replace("column =", "model ="),
            "this column has its own design and no model; give column",
        ),
        (control_text(*GOOD, more="model = [0, 0, 0]\n"), "must have either model or column"),
        (
            control_text(*GOOD).replace("column = ", "colunm = "),
            'unknown key "colunm" in [[columns.control_points]]; did',
        ),
        (control_text(*GOOD).replace("[900, -600, 0]", "[900, -600]"), "column must hold 3 numbers [x, y, z]"),
        (control_text(*GOOD, more="u_mm = 0\n"), "u_mm must be above zero"),
        (control_text(*GOOD).replace("scan = [910, -602, 0]\n", ""), "has no scan; add scan = [x, y, z]"),
        ("control_points = 3\n", "control_points"),
    ],
)
def test_slips_are_named_with_their_line(write_job: WriteJob, text: str, message: str) -> None:
    with pytest.raises(JobError, match=r"job\.toml, line \d+: ") as caught:
        with_points(write_job, text)
    assert message in str(caught.value)


def test_points_without_their_scan(write_job: WriteJob) -> None:
    with pytest.raises(JobError, match="measured in the scan of the rebars: name that scan"):
        with_points(write_job, control_text(*GOOD), rebars=None)


def checked(write_job: WriteJob, text: str, up: str = 'up = "-y"\n') -> ColumnReport:
    path = write_job(column_text("C-1", "foot.ply", "bars.ply", up) + text, clouds=("foot.ply", "bars.ply"))
    (column,) = run_job(read_job(path), RunOptions()).report.columns
    return column


@pytest.mark.usefixtures("exact_extraction")
def test_the_absolute_position_of_the_bars(write_job: WriteJob) -> None:
    """The scan says 10 mm further along x and 2 mm back than the building: the bars stand by as much the other way."""
    column = checked(write_job, control_text(*GOOD, THIRD))
    assert column.rebars is not None
    absolute = column.rebars.absolute
    assert absolute is not None
    assert absolute.offset_mm == pytest.approx((-10.0, 2.0), abs=1e-6)
    assert (absolute.verdict, column.verdict, column.goes_on) == (Verdict.FAIL, Verdict.FAIL, Verdict.PASS)
    assert column.reasons[0].startswith("the bars as a group are 10.20 mm off their place (-10.00, +2.00), limit 8 mm")
    without = checked(write_job, "")
    assert without.verdict is Verdict.PASS
    assert without.rebars is not None
    assert without.rebars.absolute is None
    assert any("absolute position not checked" in note for note in without.rebars.notes)
    contradicting = checked(write_job, control_text(*GOOD, ("G3", "column", [700, -850, 0], [710, 848, 0])))
    assert contradicting.verdict is Verdict.NOT_MEASURED
    assert "contradict each other" in contradicting.reasons[0]


@pytest.mark.usefixtures("exact_extraction")
def test_control_points_tell_how_the_bars_are_turned(write_job: WriteJob) -> None:
    nothing = checked(write_job, "", up="")
    assert nothing.rebars is not None
    assert nothing.rebars.fit is not None
    assert nothing.rebars.fit.orientation == "ambiguous"
    near = [(name, where, known, [x + 1 for x in known]) for name, where, known, _ in (*GOOD, THIRD)]
    told = checked(write_job, control_text(*near), up='sleeves_up = "-y"\n')
    assert told.rebars is not None
    assert told.rebars.fit is not None
    assert told.rebars.fit.orientation == "declared"
    assert told.verdict is Verdict.PASS
    assert replace(told, notes=()).goes_on is Verdict.PASS
