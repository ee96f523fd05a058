"""Recompute a report with numpy alone, by formulas of its own (python docs/recompute.py < report.json).

It says how many values of each kind there are, and the largest difference, mm; it ends with 1 where one is above 2 µm.
"""

import json
import sys

import numpy as np

POSES = ("least_squares", "minimax", "best")


def laid(moving, fixed):
    """Least squares in the plane, in complex numbers: points brought onto others by a turn and a shift."""
    a, b = moving @ [1, 1j], fixed @ [1, 1j]
    turn = np.vdot(a - a.mean(), b - b.mean())
    return (a - a.mean()) * turn / abs(turn) + b.mean() - b  # what is left of each, as a complex number


def group(points, spacing):
    """Position after the fit to design, and distances of neighbours."""
    seen = [p for p in points if p["aligned_mm"]]
    measured, design = (np.array([p[name][:2] for p in seen]) for name in ("aligned_mm", "design_mm"))
    yield "position", abs(abs(laid(measured, design)) - [p["deviation_mm"] for p in seen])
    at = {p["label"]: (np.array(p["aligned_mm"][:2]), np.array(p["design_mm"][:2])) for p in seen}
    for s in (one for one in spacing if one["deviation_mm"] is not None):
        (a, da), (b, db) = (at[label] for label in s["between"])
        yield "spacing", abs(np.linalg.norm(a - b) - np.linalg.norm(da - db) - s["deviation_mm"])


def trial(column, poses, length):
    """Distances of every pose, those of least squares anew, and the room over the ribs at mouth and top of the bar."""
    first = poses[0]["pairs"]
    points = {p["label"]: p for kind in ("sleeves", "rebars") for p in column[kind]["points"] if p["aligned_mm"]}
    xy = [np.array([points[pair[part]]["aligned_mm"][:2] for pair in first]) for part in ("rebar", "sleeve")]
    yield "least squares", abs(abs(laid(*xy)) - [pair["distance_mm"] for pair in first])
    for pose in filter(None, poses):
        T = np.array(pose["T_sleeves_rebars"])
        for pair in pose["pairs"]:
            sleeve, bar = points[pair["sleeve"]], points[pair["rebar"]]
            offset = (T @ [*bar["aligned_mm"], 1])[:2] - sleeve["aligned_mm"][:2]
            yield "distance", abs(np.linalg.norm(offset) - pair["distance_mm"])
            if pair.get("room_mm") is not None:
                leans = [np.array(p["axis"][:2]) / p["axis"][2] * length for p in (bar, sleeve)]
                gaps = [offset - T[:2, :2] @ leans[0], offset - leans[1]]
                yield "room", abs(pair["allowance_mm"] - max(map(np.linalg.norm, gaps)) - pair["room_mm"])


known = {}
for column in json.loads(sys.stdin.buffer.read())["columns"]:
    groups = filter(None, (column["sleeves"], column["rebars"]))
    found = [one for each in groups for one in group(each["points"], each["spacing"])]
    if (tried := column["trial_assembly"]) and tried["least_squares"]:
        found += trial(column, [tried.get(name) for name in POSES], tried["embedded_length_mm"])
    for name, differences in found:
        known.setdefault(name, []).extend(np.atleast_1d(differences))
for name, values in known.items():
    sys.stdout.write(f"{name}: {len(values)} values, largest difference {max(values):.5f} mm\n")
raise SystemExit(int(max(map(max, known.values())) > 0.002))
