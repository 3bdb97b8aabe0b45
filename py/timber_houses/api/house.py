# SPDX-License-Identifier: GPL-2.0-or-later
"""A house file as an object. Needs no YADE."""
from functools import cached_property
from pathlib import Path

from ..base.atomic_write import write_text
from ..base.errors import os_errors
from ..house import build_house, changed_house, free_bays, load_house
from ..house.parser import house_text


class House:
    """A house: a shipped one, or a house file of your own.

    Parameters
    ----------
    name : str or Path
        Name of a shipped house (``"A"``, ``"B"``, ``"C"``, ``"B1"``, ``"B2"``, ``"C1"``, ``"C2"``, ``"l_house"``,
        ``"storehouse"``, ``"tiled_house"``), or path of a YAML or BTLx file.

    Raises
    ------
    HouseError
        One line with file and line, for a file that is missing or describes no house.

    Examples
    --------
    >>> house = th.house("C2")
    >>> house.counts()["joints"]
    382
    """

    def __init__(self, name):
        self.given = name.given if isinstance(name, House) else str(name)
        self._description = load_house(self.given)
        self._models = {}

    def __repr__(self):
        model = self.model()
        mass = sum(element.mass for element in model.elements if not element.fixed and element.kind != "snow") / 1000
        return (f"<House {self.name}: {len(model.elements)} elements, {model.joints_text}, {mass:.1f} t of timber;"
                f" {self.path.name}>")

    @property
    def name(self):
        """Name in the house file."""
        return self._description.name

    @property
    def path(self):
        """House file."""
        return self._description.path

    @property
    def description(self):
        """The house file's description in a few words."""
        return self._description.data["description"]

    @cached_property
    def free_bays(self):
        """Names of the braces that `variant` can add, one for each free bay: ``"main.brace1.NS.x0.1-2"``."""
        return free_bays(self._description)

    def model(self, snow=None):
        """HouseModel with elements and joints, the same object for each depth of snow.

        Parameters
        ----------
        snow : float, optional
            Depth of snow on the roofs [m]; by default the house file's.
        """
        if snow not in self._models:
            self._models[snow] = build_house(self._description, snow)
        return self._models[snow]

    def counts(self, snow=None):
        """Dictionary of numbers of elements, columns, braces and joints, and masses [kg]. snow: as in `model`"""
        return self.model(snow).counts()

    def draw(self, path=None, snow=None):
        """Draw plans and elevations.

        Parameters
        ----------
        path : str or Path, optional
            Picture to write, PNG or PDF by its ending; by default ``house_NAME.png`` in this folder.
        snow : float, optional
            Depth of snow on the roofs [m]; by default the house file's.

        Returns
        -------
        list of Path
            The written files.
        """
        from ..pictures import drawings

        with os_errors(lambda fault: f"{path}: the drawing cannot be written: {fault}"):
            return drawings.write(Path(path or f"house_{self.name}.png"), self.model(snow))

    def variant(self, path, settings=(), braces=(), strength=1.0):
        """Write a changed copy to a house file, and return it as a house.

        Parameters
        ----------
        path : str or Path
            House file to write. The name of the file is the name of the house.
        settings : sequence of str
            Changed keys of the house file: ``"joint_types.corner_fitting.strength=7000"``.
        braces : sequence of str
            Braces to add, from `free_bays`.
        strength : float
            Factor on the strength of all joints [-].

        Returns
        -------
        House
        """
        data = changed_house(self.path, settings, braces, strength, where=lambda change: f"{self.name}, {change}")
        data["name"] = Path(path).stem
        with os_errors(lambda fault: f"{path}: the house file cannot be written: {fault}"):
            write_text(Path(path), f"# House {self.name} with changes\n{house_text(data)}")
        return House(Path(path).absolute())
