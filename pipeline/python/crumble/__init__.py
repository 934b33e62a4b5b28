"""Results of Crumble as named arrays with their units, and its programs as functions.

A result is read by `read`; a stage is run by `run`, which gives its report. The examples are run in the top folder of Crumble.

>>> import crumble
>>> granule = crumble.read("data/hollow.h5")
>>> granule
<data/hollow.h5: 115 particles, 22 frames, dry, by dryer>
>>> contacts = granule.contacts()            # of the last frame
>>> contacts.gap.unit, len(contacts)
('nm', 170)
>>> print(f"largest tension {contacts.normal_force.max():.2g} {contacts.normal_force.unit}")
largest tension 5.7e-11 N
"""

from .arrays import Array, Table
from .programs import ProgramError, agglomerate, run
from .result import EVENT_KINDS, FileError, Result, read

__all__ = ["EVENT_KINDS", "Array", "FileError", "ProgramError", "Result", "Table", "agglomerate", "read", "run"]
