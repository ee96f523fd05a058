"""The chain without hardware: a virtual camera, the watch, OPC UA, a controller, a crane, and the next frame."""

from __future__ import annotations

import asyncio
import json
import time
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.model import Array
from aadm_workbench.scan.read import read_scan
from aadm_workbench.twin.crane import Crane, laboratory_crane
from batch.link.controller import Controller
from batch.link.opcua import OpcUaLink
from batch.main import main

from .links import free_port, linked, until, write_state


def test_the_column_ends_on_its_bars(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["study", "loop", "--seed", "3", "--quick", "--json", "--out", str(tmp_path)]) == 0
    ended = json.loads(capsys.readouterr().out)
    assert ended["landed"] is True
    assert 3 <= ended["frames"] <= 8
    assert ended["moves"] >= 1
    assert ended["largest_mm"] <= 3.0
    state = json.loads((tmp_path / "aadm-state.json").read_text(encoding="utf-8"))
    assert (state["ready"], state["sequence"], state["bad_frames"]) == (True, ended["frames"], 0)
    captures = sorted((tmp_path / "frames").iterdir())
    assert len(captures) == ended["frames"]
    assert read_scan(captures[-1]).camera is not None  # they can be measured again


def place(crane: Crane) -> Array:
    from aadm_workbench.twin.hoisting import hanging_pose

    return hanging_pose(crane.hang)


def test_a_move_turns_the_column_about_itself_and_then_moves_it() -> None:
    crane = laboratory_crane(5)
    before = place(crane)
    crane.move(40.0, -25.0, 3.0)
    after = place(crane)
    assert after[:2, 3] - before[:2, 3] == pytest.approx([40.0, -25.0], abs=6.0)  # as exact as a crane is
    turn = after[:3, :3] @ before[:3, :3].T
    assert turn[1, 0] == pytest.approx(0.0523, abs=0.006)  # sin 3 degrees, counter-clockwise from above
    assert crane.moves == 1


class Noted:
    """A machine that notes what it is told."""

    def __init__(self) -> None:
        self.landed, self.told = False, []

    def move(self, *by: float) -> None:
        self.told.append(by)

    def lower(self) -> None:
        self.landed = True

    def decided(self) -> None:
        self.told.append("next")


def test_the_controller_acts_once_on_good_numbers_alone_and_lets_down_when_ready(tmp_path: Path) -> None:
    path, port, machine = tmp_path / "aadm-state.json", free_port(), Noted()
    far: dict[str, Any] = {"still": False, "largest_mm": 8.0}
    move = {"dx_mm": 5.0, "dy_mm": -4.0, "yaw_deg": 0.5, "u_mm": 0.1}
    uncertain = {"frame__verdict": "inconclusive"}
    write_state(path, sequence=1, move=move, **far, **uncertain)

    async def run() -> None:
        async def shows(count: int) -> None:
            await until(lambda: len(machine.told) >= count)
            await asyncio.sleep(0.5)
            assert len(machine.told) == count, "it acted twice on one frame"

        link = OpcUaLink("127.0.0.1", port, None)
        async with linked(path, link):
            controller = asyncio.create_task(Controller(machine, lambda _: None).steer(link.endpoint))
            await shows(1)
            write_state(path, time.time_ns() / 1e9 - 20.0, sequence=2, valid_for_s=15.0, move=move, **far)
            await shows(2)
            write_state(path, sequence=3, move={**move, "dx_mm": 0.2, "dy_mm": 0.1, "yaw_deg": 0.0}, **far)
            await shows(3)
            assert machine.told == ["next"] * 3
            write_state(path, sequence=4, move=move, **far)
            await shows(5)
            assert machine.told[3:] == [(5.0, -4.0, 0.5), "next"]
            write_state(path, sequence=5, move=move)
            await until(lambda: machine.landed)
            await controller

    asyncio.run(run())
    assert len(machine.told) == 5
