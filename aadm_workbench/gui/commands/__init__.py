"""The commands of the workbench: one a file, each a class with the name that FreeCAD knows it by."""

from __future__ import annotations

from types import MappingProxyType

COMMANDS = MappingProxyType(
    {
        "AADM_SampleDesign": ("sample_design", "SampleDesign"),
        "AADM_ImportScan": ("import_scan", "ImportScan"),
        "AADM_CaptureScan": ("capture_scan", "CaptureScan"),
        "AADM_Camera": ("camera_proof", "CameraProof"),
        "AADM_CheckColumn": ("check_column", "CheckColumn"),
        "AADM_CheckAll": ("check_all", "CheckAll"),
        "AADM_RunJob": ("run_job", "RunJob"),
        "AADM_Hoisting": ("hoisting", "Hoisting"),
        "AADM_WriteResults": ("write_results", "WriteResults"),
        "AADM_Report": ("report", "Report"),
        "AADM_SavePicture": ("save_picture", "SavePicture"),
        "AADM_TryIt": ("try_it", "TryIt"),
        "AADM_Settings": ("settings_page", "SettingsPage"),
        "AADM_About": ("about", "About"),
    }
)
"""Module and class of each command, in the order of menu and toolbar."""

TOOLBAR = (
    "AADM_SampleDesign",
    "AADM_ImportScan",
    "AADM_CaptureScan",
    "AADM_CheckColumn",
    "AADM_CheckAll",
    "AADM_RunJob",
    "AADM_Hoisting",
    "AADM_WriteResults",
    "AADM_Report",
    "AADM_SavePicture",
)
