"""What BCF 2.1 and 3.0 call things, and in which order: the one place that knows the difference.

After the schemas of buildingSMART/BCF-XML (releases 2.1 and 3.0): the children of elements are sequences.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

Version: TypeAlias = Literal["2.1", "3.0"]
VERSIONS: tuple[Version, ...] = ("2.1", "3.0")

_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_OF_A_TOPIC = (
    ("ReferenceLink", "ReferenceLinks"),
    ("Title", "Title"),
    ("Priority", "Priority"),
    ("Index", "Index"),
    ("Labels", "Labels"),
    ("CreationDate", "CreationDate"),
    ("CreationAuthor", "CreationAuthor"),
    ("ModifiedDate", "ModifiedDate"),
    ("ModifiedAuthor", "ModifiedAuthor"),
    ("DueDate", "DueDate"),
    ("AssignedTo", "AssignedTo"),
    ("Stage", "Stage"),
    ("Description", "Description"),
    ("BimSnippet", "BimSnippet"),
    ("DocumentReference", "DocumentReferences"),
    ("RelatedTopic", "RelatedTopics"),
    ("", "Comments"),
    ("", "Viewpoints"),
)
"""Children of a topic in 2.1 and in 3.0."""
_OF_A_MARKUP = ("Header", "Topic", "Comment", "Viewpoints")


@dataclass(frozen=True)
class Form:
    """A version: lists stand beside each other in 2.1, and each in an element of its own in 3.0."""

    version: Version

    @property
    def is_3(self) -> bool:
        """Whether it is 3.0."""
        return self.version == "3.0"

    def comments(self, root: ElementTree.Element) -> list[ElementTree.Element]:
        """Those of a topic, in the order of the file."""
        return root.findall("Topic/Comments/Comment" if self.is_3 else "Comment")

    def new_comment(self, root: ElementTree.Element, guid: str) -> ElementTree.Element:
        """One more, at the end."""
        parent = self._within(topic_of(root), "Comments") if self.is_3 else root
        return ElementTree.SubElement(parent, "Comment", Guid=guid)

    def viewpoints(self, root: ElementTree.Element) -> list[ElementTree.Element]:
        """The entries that name viewpoint and picture."""
        return root.findall("Topic/Viewpoints/ViewPoint" if self.is_3 else "Viewpoints")

    def new_viewpoint(self, root: ElementTree.Element, guid: str) -> ElementTree.Element:
        """One more entry."""
        if self.is_3:
            return ElementTree.SubElement(self._within(topic_of(root), "Viewpoints"), "ViewPoint", Guid=guid)
        return ElementTree.SubElement(root, "Viewpoints", Guid=guid)

    def labels(self, root: ElementTree.Element) -> list[str]:
        """The labels of a topic."""
        found = root.findall("Topic/Labels/Label" if self.is_3 else "Topic/Labels")
        return [element.text or "" for element in found]

    def set_labels(self, root: ElementTree.Element, labels: Iterable[str]) -> None:
        """Put other labels in the place of those that are there."""
        topic = topic_of(root)
        for element in topic.findall("Labels"):
            topic.remove(element)
        for label in labels:
            parent = self._within(topic, "Labels") if self.is_3 else topic
            ElementTree.SubElement(parent, "Label" if self.is_3 else "Labels").text = xml_text(label)

    def add_file(self, root: ElementTree.Element, name: str, reference: str, ifc_project: str) -> None:
        """The model that the topic is about; it lies outside of the BCF file."""
        header = ElementTree.SubElement(root, "Header")
        parent = ElementTree.SubElement(header, "Files") if self.is_3 else header
        project = {"IfcProject": ifc_project} if ifc_project else {}
        outside = {"IsExternal" if self.is_3 else "isExternal": "true"}
        file = ElementTree.SubElement(parent, "File", {**project, **outside})
        put(file, "Filename", name)
        put(file, "Reference", reference)

    def add_table(self, root: ElementTree.Element, guid: str, name: str, description: str) -> None:
        """A document: in the topic's own folder in 2.1, in that of all documents in 3.0."""
        topic = topic_of(root)
        if self.is_3:
            parent = self._within(topic, "DocumentReferences")
            document = ElementTree.SubElement(parent, "DocumentReference", Guid=guid)
            put(document, "DocumentGuid", guid)
        else:
            document = ElementTree.SubElement(topic, "DocumentReference", Guid=guid, isExternal="false")
            put(document, "ReferencedDocument", name)
        put(document, "Description", description)

    def in_order(self, root: ElementTree.Element) -> None:
        """The schema is a sequence; what it does not know stays at the end."""
        names = [pair[1 if self.is_3 else 0] for pair in _OF_A_TOPIC]
        for parent, order in ((root, _OF_A_MARKUP), (topic_of(root), names)):
            rank = {name: place for place, name in enumerate(order)}
            parent[:] = sorted(parent, key=lambda element: rank.get(element.tag, len(rank)))

    def _within(self, parent: ElementTree.Element, name: str) -> ElementTree.Element:
        found = parent.find(name)
        return ElementTree.SubElement(parent, name) if found is None else found


def topic_of(root: ElementTree.Element) -> ElementTree.Element:
    """The topic of a markup, which was seen to have one."""
    topic = root.find("Topic")
    assert topic is not None, "a markup without a topic is refused when it is read"
    return topic


def put(parent: ElementTree.Element, name: str, text: str) -> None:
    """The text of a child, which is made where it is missing."""
    element = parent.find(name)
    if element is None:
        element = ElementTree.SubElement(parent, name)
    element.text = xml_text(text)


def xml_text(text: str) -> str:
    """A text with the signs that XML 1.0 cannot hold replaced."""
    return _NOT_IN_XML.sub("\ufffd", text)


def xml_bytes(root: ElementTree.Element, *, indent: bool = True) -> bytes:
    """The file."""
    if indent:
        ElementTree.indent(root)
    written: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return written
