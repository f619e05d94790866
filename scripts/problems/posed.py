"""A problem of the collection before it is answered."""

from dataclasses import dataclass, field


@dataclass
class Posed:
    """A contact problem with what is known of it beforehand."""

    group: str
    about: str
    document: dict
    closed: list = field(default_factory=list)  # impulses of a closed form or of an engine; empty where there are none
    closed_by: str = ""  # how they come about
    engine: bool = False  # whether they are an engine's, which need not solve the problem as well as a closed form
    solution: dict = None  # what else the engine's answer has: the impulses on the edges of a pyramid
    no_solution: str = ""  # why there is none, in a sentence

    @property
    def name(self):
        """The problem's name, that of its file."""
        return self.document["name"]

    @property
    def contacts(self):
        """The number of contacts."""
        return len(self.document["friction"])
