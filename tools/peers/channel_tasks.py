"""Impulse responses of configuration A of Barry et al. 1993: the room, and the bins that are compared."""

import csv
import dataclasses
import pathlib

import numpy as np

from tasks import ROOT
from with_lichtmc import lichtmc

SPEED_OF_LIGHT = 299_792_458.0  # m/s
SIZE = (5.0, 3.0, 5.0)  # m, Y up
LAMP = (2.5, 3.0, 2.5)  # Lambert's law downwards, 1 W
EYE = (0.5, 0.0, 1.0)  # looks upwards
AREA = 1e-4  # m², of the eye
REFLECTANCES = {"walls": 0.8, "ceiling": 0.8, "floor": 0.3}


@dataclasses.dataclass
class Bins:
    """All bins from 0 to the span are measured, and those from `first` on are compared."""

    width_ns: float
    first_ns: float
    reference: str  # table of tests/data/channel
    span_ns: float = 60.0

    @property
    def title(self):
        return f"bins of {self.width_ns:g} ns, {self.first_ns:g} to {self.span_ns:g} ns"

    @property
    def count(self):
        return round(self.span_ns / self.width_ns)

    def compared(self, values):
        """The compared ones of all bins."""
        return values[round(self.first_ns / self.width_ns) : self.count]


# The line of sight arrives at 13.03 ns, the first reflected light at 15.01 ns.
BINS = [Bins(0.2, 30.0, "barry_0.2ns.csv"), Bins(1.0, 15.0, "barry_1ns.csv")]


def write_room(folder):
    room = folder / "barry.glb"
    light = "lambert:{},{},{}:0,-1,0:1:1W".format(*LAMP)
    reflectances = [text for name, value in REFLECTANCES.items() for text in (f"--{name}", value)]
    lichtmc("cuboid", "--size", *SIZE, *reflectances, "--light", light, "-o", room)
    return room


def write_eye(folder, fov):
    """The table of the receiver, with this half angle in degrees."""
    table = folder / f"eye_{fov}.csv"
    row = ",".join(map(str, EYE))
    table.write_text(f"name,x,y,z,nx,ny,nz,area,fov\neye,{row},0,1,0,{AREA},{fov}\n")
    return table


def read_table(path, where):
    """Columns of the rows that `where` accepts; lines with # are comments."""
    with open(path, newline="") as file:
        rows = [row for row in csv.DictReader(line for line in file if not line.startswith("#")) if where(row)]
    return lambda name: np.array([float(row[name]) for row in rows])


def reference(bins):
    """h of reflected light in 1/s, and its standard error: half angle of the field of view 85°."""
    table: pathlib.Path = ROOT / "tests/data/channel" / bins.reference
    column = read_table(table, lambda row: True)
    width = bins.width_ns * 1e-9
    return bins.compared(column("total") - column("k0")) / width, bins.compared(column("se_total")) / width
