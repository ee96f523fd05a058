"""Taking results out of a model again, so that it equals what it was before they were written."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from aadm_workbench.design.ifc.text.step import StepText
from aadm_workbench.model import Reason
from aadm_workbench.report.ifc.addition import (
    APPLICATION,
    GLOBAL_ID_PREFIX,
    Addition,
    Property,
    derived_id,
    key_of,
    line_of,
)

BOOK = "AADM_WriteBack"
"""The property set of the project that says what was added, and how altered entities read before."""

_BEFORE = "Before #"
_MARKER = f"'{GLOBAL_ID_PREFIX}".encode()
_RELATED = re.compile(rb"\((#\d+(?:\s*,\s*#\d+)*)\)\s*,\s*#(\d+)\s*\)\s*;")
"""The last two arguments of IfcRelDefinesByProperties: its elements and its property set."""

_NEVER_OURS = ("IfcRepresentationContext", "IfcUnitAssignment", "IfcNamedUnit")
_ANNOTATING = ("IfcStyledItem", "IfcPresentationLayerAssignment")


@dataclass(frozen=True)
class Stripped:
    """A model without results: its bytes, the check that the results came from, and what could not be put back.

    ``checked_sha256`` is that of the model which the results were measured against, where no other hand has touched the
    file since; ``exact`` says that the bytes are those of the model before.
    """

    content: bytes
    found: bool
    exact: bool
    checked_sha256: str = ""
    notes: tuple[str, ...] = ()


def keep_book(addition: Addition, text: StepText, checked_sha256: str, audit: Iterable[Property]) -> None:
    """Write down in the model what was added, as the last that is added."""
    last = addition.file.get_max_id()
    properties = [
        *audit,
        Property("CheckedModelSha256", "IfcLabel", checked_sha256),
        Property("OriginalSha256", "IfcLabel", hashlib.sha256(text.content).hexdigest()),
        Property("FirstEntity", "IfcInteger", addition.first),
        Property("LastEntity", "IfcInteger", last),
        Property(
            "AddedSha256",
            "IfcLabel",
            _digest(addition.file, [*range(addition.first, last + 1), *sorted(addition.altered)]),
        ),
    ]
    # Latin-1 gives each byte a sign of its own, whatever the file is encoded in.
    properties += [
        Property(f"{_BEFORE}{number}", "IfcText", statement.decode("latin-1"))
        for number, statement in sorted(addition.altered.items())
    ]
    project = addition.file.by_type("IfcProject")[0]
    book = addition.property_set((project.GlobalId, BOOK), BOOK, properties, ())
    addition.rooted(
        "IfcRelDefinesByProperties",
        (project.GlobalId, BOOK),
        BOOK,
        RelatedObjects=[project],
        RelatingPropertyDefinition=book,
    )


def without_results(file: Any, text: StepText) -> Stripped:
    """A model without what this program has added, whoever has saved it since.

    Where the added entities are as they were written, they are taken out by their ids and altered lines are put back.
    Where another program has changed or renumbered them, they are found by their GlobalIds and by what hangs on them.
    """
    if _MARKER not in text.content:
        return Stripped(text.content, found=False, exact=True)
    book = _book(file)
    if book is not None:
        stripped = _by_numbers(file, text, book)
        if stripped is not None:
            return stripped
    return _by_kinship(file, text, book or {})


def _book(file: Any) -> dict[str, Any] | None:
    for found in file.by_type("IfcPropertySet"):
        if found.Name == BOOK and found.GlobalId.startswith(GLOBAL_ID_PREFIX):
            values = {item.Name: getattr(item.NominalValue, "wrappedValue", None) for item in found.HasProperties}
            return {**values, "": found}
    return None


def _by_numbers(file: Any, text: StepText, book: Mapping[str, Any]) -> Stripped | None:
    """By the ids that the book names; None where they are not the entities that were written."""
    first, last = book.get("FirstEntity"), book.get("LastEntity")
    if not isinstance(first, int) or not isinstance(last, int):
        return None
    added = range(first, last + 1)
    entry = [book[""], *book[""].HasProperties, *file.get_inverse(book[""])]
    ours = {*added, *(entity.id() for entity in entry)}
    before = dict(_before(book))
    if not ours <= text.places.keys() or not before.keys() <= text.places.keys():
        return None
    if _digest(file, [*added, *sorted(before)]) != book.get("AddedSha256"):
        return None
    users = {user.id() for number in ours for user in file.get_inverse(file.by_id(number))}
    if not users - ours <= before.keys():
        return None
    content = b"".join(text.edited(replaced=before, removed=ours))
    exact = hashlib.sha256(content).hexdigest() == book.get("OriginalSha256")
    return Stripped(content, found=True, exact=exact, checked_sha256=str(book.get("CheckedModelSha256")))


def _by_kinship(file: Any, text: StepText, book: Mapping[str, Any]) -> Stripped:
    """By GlobalIds and by what is used by nothing else; other people's elements keep what they were given since."""
    restored, notes = _put_back(file, book)
    replaced: dict[int, Any] = {}
    ours = _own_roots(file, replaced)
    doomed = _used_by(file, ours)
    # What somebody else uses stays, with all that it uses itself.
    while foreign := {n for n in doomed - ours if any(u.id() not in doomed for u in file.get_inverse(file.by_id(n)))}:
        doomed -= foreign
    doomed |= _release(file, ours, doomed, replaced)
    lines = {number: line_of(entity) for number, entity in replaced.items() if number not in doomed} | restored
    content = b"".join(text.edited(replaced=lines, removed=doomed))
    return Stripped(content, found=True, exact=False, notes=tuple(notes))


def _own_roots(file: Any, replaced: dict[int, Any]) -> set[int]:
    """Ids of rooted entities of this program.

    A property set that somebody has given to another element as well stays that element's: it is unshared.
    """
    ours = {entity.id() for entity in file.by_type("IfcRoot") if entity.GlobalId.startswith(GLOBAL_ID_PREFIX)}
    for relation in file.by_type("IfcRelDefinesByProperties"):
        definition = relation.RelatingPropertyDefinition
        if definition.id() not in ours:
            continue
        others = [related for related in relation.RelatedObjects if not _made_for(relation, related, definition)]
        if others:
            ours -= {relation.id(), definition.id()}
            if len(others) < len(relation.RelatedObjects):
                relation.RelatedObjects = others
                replaced[relation.id()] = relation
    return ours


def _made_for(relation: Any, element: Any, definition: Any) -> bool:
    """Whether this program has given a property set to an element: then the GlobalIds follow from the element's."""
    key = (element.GlobalId, definition.Name)
    derived = {derived_id(key_of(kind, key)) for kind in ("IfcRelDefinesByProperties", "IfcPropertySet")}
    return not derived.isdisjoint((relation.GlobalId, definition.GlobalId))


def _used_by(file: Any, roots: set[int]) -> set[int]:
    """Ids of some entities, of all that they use, and of the styles and layers that refer to it."""
    found: set[int] = set()
    waiting = [file.by_id(number) for number in roots]
    while waiting:
        entity = waiting.pop()
        if entity.id() in found or _is_theirs(entity, roots):
            continue
        found.add(entity.id())
        waiting += [used for used in file.traverse(entity, max_levels=1)[1:] if used.id()]
        waiting += [user for user in file.get_inverse(entity) if any(user.is_a(kind) for kind in _ANNOTATING)]
    return found


def _is_theirs(entity: Any, ours: set[int]) -> bool:
    """What belongs to the model even where only an added entity uses it."""
    if entity.is_a("IfcOwnerHistory"):
        return bool(entity.OwningApplication.ApplicationIdentifier != APPLICATION)
    if entity.is_a("IfcRoot"):
        return entity.id() not in ours
    return any(entity.is_a(kind) for kind in _NEVER_OURS)


def _release(file: Any, ours: set[int], doomed: set[int], replaced: dict[int, Any]) -> set[int]:
    """Take what goes out of the lists of those that stay; ids of relations that are left with nothing."""
    emptied: set[int] = set()
    for number in ours:
        for user in file.get_inverse(file.by_id(number)):
            if user.id() in doomed:
                continue
            for place, value in enumerate(user):
                if isinstance(value, tuple):
                    left = [item for item in value if not (hasattr(item, "id") and item.id() in doomed)]
                    if len(left) < len(value) and left:
                        user[place] = left
                        replaced[user.id()] = user
                    elif len(left) < len(value):
                        emptied.add(user.id())
                elif hasattr(value, "id") and value.id() in doomed:
                    emptied.add(user.id())
    return emptied


def _put_back(file: Any, book: Mapping[str, Any]) -> tuple[dict[int, bytes], list[str]]:
    """Restore altered relations with the elements that joined them since: lines by id, and a note for each lost one."""
    lines: dict[int, bytes] = {}
    notes: list[str] = []
    for number, before in _before(book):
        found = _RELATED.search(before)
        try:
            now = file.by_guid(before.split(b"'")[1].decode("latin-1"))
            if not found or now.id() != number:
                raise RuntimeError
            related = [file.by_id(int(word)) for word in found[1].replace(b"#", b"").split(b",")]
            definition = file.by_id(int(found[2]))
        except (RuntimeError, IndexError):
            notes.append(Reason("report.relation", number=number))
            continue
        joined = [element for element in now.RelatedObjects if element not in related]
        now.RelatedObjects, now.RelatingPropertyDefinition = [*related, *joined], definition
        lines[number] = line_of(now) if joined else before
    return lines, notes


def _before(book: Mapping[str, Any]) -> Iterator[tuple[int, bytes]]:
    """Ids of the altered entities and their text as it was."""
    for name, statement in book.items():
        number = name.removeprefix(_BEFORE)
        if name.startswith(_BEFORE) and number.isdecimal():
            yield int(number), str(statement).encode("latin-1", errors="replace")


def _digest(file: Any, numbers: Iterable[int]) -> str:
    """A hash of entities that does not depend on how a program writes numbers; empty where one is gone."""
    digest = hashlib.sha256()
    for number in numbers:
        try:
            digest.update(line_of(file.by_id(number)))
        except RuntimeError:
            return ""
    return digest.hexdigest()
