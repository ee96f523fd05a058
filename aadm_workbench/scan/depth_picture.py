"""Which picture of a TIFF or PNG file is the depth map, and what kind of picture it is, before it is unpacked."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Reason
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.formats.tiff_pages import SIGNATURES as TIFF_SIGNATURES
from aadm_workbench.scan.formats.tiff_pages import Page, pages_of
from aadm_workbench.scan.picture_size import PNG_SIGNATURE

_PNG_CHANNELS = {0: 1, 2: 3, 3: 3, 4: 2, 6: 4}
"""Of the types of colour in a PNG; 3 is a palette."""

_DEPTH_WORDS = ("depth", "range", "height", "distance", "tiefe", "深度")
_BYTE_BITS, _COLOURS = 8, 3  # bits of a sample and samples of a pixel of what is shown to people
_UPRIGHT = 1  # orientation of TIFF 6.0: first row at the top


class ColourPictureError(ScanError):
    """A picture in colour where a depth map should be."""


@dataclass(frozen=True)
class DepthPicture:
    """The picture of a file that holds depths, or X, Y and Z: ``page`` where the file is a TIFF.

    ``is_point_map`` says that each pixel has three floating values; ``rows_as_pages`` that each row of such a map is a
    page of its own.
    """

    width: int
    height: int
    page: Page | None = None
    is_point_map: bool = False
    rows_as_pages: bool = False
    notes: tuple[str, ...] = ()


def depth_picture(file: ScanFile) -> DepthPicture:
    """Return the picture that is the depth map.

    Raises
    ------
    ScanError
        Where the file is neither TIFF nor PNG, ends within its header, holds pictures in colour alone, or several that
        may be meant.
    """
    content = file.content
    try:
        if content.startswith(PNG_SIGNATURE):
            width, height, bits, colour = struct.unpack_from(">IIBB", content, 16)
            _refuse_colours(file, _PNG_CHANNELS.get(colour, 1), bits)
            return DepthPicture(width, height)
        if content.startswith(TIFF_SIGNATURES):
            return _of_pages(file, pages_of(content))
    except (struct.error, KeyError, OverflowError) as error:
        raise file.wrong(Reason("scan.header_breaks", size_bytes=len(content))) from error
    raise file.wrong(Reason("scan.not_depth_picture"))


def _of_pages(file: ScanFile, pages: Sequence[Page]) -> DepthPicture:
    first = pages[0]
    if len(pages) > 1 and all(page.width == _COLOURS and page.is_float and page.samples == 1 for page in pages):
        return DepthPicture(first.height, len(pages), first, is_point_map=True, rows_as_pages=True)
    page = first if len(pages) == 1 else _one_of(file, pages)
    is_point_map = page.samples == _COLOURS and page.is_float
    if not is_point_map:
        _refuse_colours(file, _COLOURS if page.is_palette else page.samples, page.bits)
    notes = []
    if len(pages) > 1:
        notes.append(Reason("scan.pages", count=len(pages), number=page.number))
    if page.orientation != _UPRIGHT:
        notes.append(Reason("scan.orientation", orientation=page.orientation))
    return DepthPicture(page.width, page.height, page, is_point_map, notes=tuple(notes))


def _one_of(file: ScanFile, pages: Sequence[Page]) -> Page:
    """Return the only page that can be a depth map, or the only such page that is called so."""
    possible = [page for page in pages if not page.is_secondary and _can_be_depths(page)]
    called = [page for page in possible if any(word in page.name.lower() for word in _DEPTH_WORDS)]
    for candidates in (possible, called):
        if len(candidates) == 1:
            return candidates[0]
    kinds = [_described(page) for page in pages[:5]]
    raise file.wrong(Reason("scan.which_page", count=len(pages), kinds=kinds))


def _can_be_depths(page: Page) -> bool:
    if page.samples == _COLOURS:
        return page.is_float
    return page.samples == 1 and page.bits > _BYTE_BITS and not page.is_palette


def _described(page: Page) -> str:
    channels = f"{page.samples} x " if page.samples > 1 else ""
    code = "formats.page.floating" if page.is_float else "formats.page"
    return Reason(code, width=page.width, height=page.height, bits=f"{channels}{page.bits}")


def _refuse_colours(file: ScanFile, channels: int, bits: int) -> None:
    if channels > 1:
        raise ColourPictureError(Reason("scan.colour", name=file.name, channels=channels))
