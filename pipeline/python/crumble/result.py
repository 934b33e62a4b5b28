"""A result file, read. What it may hold, and what each name means, stands in SCHEMA.md; units are those of the file."""

import pathlib
import tomllib

import h5py
import numpy

from . import gsd_file
from .arrays import Array, Table

# What the numbers of `events.kind` mean, in the words of SCHEMA.md.
EVENT_KINDS = ("slip", "twist", "roll", "rupture", "contact made", "fragment lost")
# Major version of the format that this module reads.
FORMAT = 1
# Groups that are not results: they have members of their own in `Result`, or say where the file comes from.
OTHERS = ("h5md", "particles", "contacts", "connectivity", "observables", "series", "events", "parameters")


class FileError(ValueError):
    """The file is no result that can be read. `agglomerate check` says everything that is wrong with a file."""


def text_of(value):
    return value.decode() if isinstance(value, bytes) else value


def array(data, rows=()):
    """A dataset, or rows of it, as an Array; text as str."""
    values = data[rows]
    if isinstance(values, (bytes, str)):
        return text_of(values)
    return Array(values, text_of(data.attrs.get("unit", "")))


class Result:
    """What `read` gives. Frames are counted from 0; -1 is the last. Everything is read when it is asked for."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        with self._file() as file:
            about = file.get("h5md/modules/agglomerate")
            if about is None:
                raise FileError(f"{path}: not a result of Crumble: /h5md/modules/agglomerate is missing")
            major, minor = (int(part) for part in about.attrs["version"])
            if major != FORMAT:
                raise FileError(f"{path}: its format is {major}.{minor}, this module reads {FORMAT}")
            if not about.attrs["complete"]:
                raise FileError(f"{path}: not complete: its run is going on, or was stopped")
            self.stage, self.state = text_of(about.attrs["stage"]), text_of(about.attrs["state"])
            position = file["particles/all/position"]
            self.number = len(file["particles/all/radius"])
            self.frames = Table({"step": array(position["step"]), "time": array(position["time"])})

    def _file(self):
        try:
            return h5py.File(self.path)
        except FileNotFoundError:
            raise FileNotFoundError(f"{self.path}: no such file") from None
        except OSError as problem:
            raise FileError(f"{self.path}: cannot be read as HDF5: {problem}") from None

    def __repr__(self):
        return f"<{self.path}: {self.number} particles, {len(self.frames)} frames, {self.state}, by {self.stage}>"

    def __getitem__(self, path):
        """Any array by its name in SCHEMA.md.

        >>> import crumble
        >>> round(float(crumble.read("data/hollow.h5")["morphology/diameter"]), 2)
        156.57
        """
        with self._file() as file:
            found = file.get(path)
            if isinstance(found, h5py.Group):
                found = found.get("value")
            if not isinstance(found, h5py.Dataset):
                raise KeyError(f"{self.path}: no array {path}")
            return array(found)

    def _frame(self, frame):
        count = len(self.frames)
        if not -count <= frame < count:
            raise IndexError(f"{self.path}: no frame {frame}, there are {count}")
        return frame % count

    def particles(self, frame=-1):
        """Radii, masses and names, and whatever is stored of a frame.

        >>> import crumble
        >>> granule = crumble.read("data/hollow.h5")
        >>> granule.particles(0)
        <115 rows: id, mass [kg], radius [nm], species, angular_velocity [rad s-1], position [nm], velocity [m s-1]>
        >>> granule.particles().position.shape
        (115, 3)
        """
        frame = self._frame(frame)
        with self._file() as file:
            members = file["particles/all"]
            fixed = {name: array(data) for name, data in members.items() if isinstance(data, h5py.Dataset)}
            moving = {name: array(group["value"], frame) for name, group in members.items()
                      if isinstance(group, h5py.Group) and "value" in group}
        return Table(fixed | moving)

    def contacts(self, frame=-1):
        """The bonds of a frame, one a row: the pair, its gap and normal, displacements, forces and torques.

        >>> import crumble
        >>> contacts = crumble.read("data/hollow.h5").contacts()
        >>> contacts.pair[0].tolist(), contacts.units["rolling_torque"]
        ([0, 20], 'N m')
        """
        frame = self._frame(frame)
        with self._file() as file:
            rows = slice(*file["contacts/offset"][frame:frame + 2])
            return Table({name: array(data, rows) for name, data in file["contacts"].items() if name != "offset"})

    def _sampled(self, name):
        with self._file() as file:
            members = file.get(name, {})
            columns = {key: array(group["value"]) for key, group in members.items()}
            times = [array(group["time"]) for group in members.values()]
            if times and all(numpy.array_equal(times[0], time) for time in times):
                columns = {"time": times[0]} | columns
        return Table(columns)

    @property
    def observables(self):
        """Numbers of each frame, with its time.

        >>> import crumble
        >>> observables = crumble.read("data/hollow.h5").observables
        >>> observables.droplet_radius.unit, int(observables.contact_count[-1])
        ('nm', 170)
        """
        return self._sampled("observables")

    @property
    def series(self):
        """Numbers that are sampled more densely than the frames, with their time. Empty where the stage writes none.

        >>> import crumble
        >>> series = crumble.read("data/samples/breaker-1.2.h5").series
        >>> series.flow_stress.unit, len(series)
        ('Pa', 4)
        """
        return self._sampled("series")

    @property
    def events(self):
        """What happened to the contacts of a breakup: `kind` counts in EVENT_KINDS.

        >>> import crumble
        >>> events = crumble.read("data/samples/breaker-1.2.h5").events
        >>> crumble.EVENT_KINDS[events.kind[0]], events.stress.unit
        ('roll', 'Pa')
        """
        with self._file() as file:
            members = file.get("events", {})
            return Table({name: array(data) for name, data in members.items() if not name.startswith("fragment_")})

    def fragments(self, event=-1):
        """Particles in each piece after an event of a breakup, the largest first.

        >>> import crumble
        >>> crumble.read("data/samples/breaker-1.2.h5").fragments().tolist()
        [7, 1]
        """
        offset = self["events/fragment_offset"]
        event = range(len(offset) - 1)[event]
        return self["events/fragment_sizes"][offset[event]:offset[event + 1]]

    def to_gsd(self, path):
        """All frames with their times, contacts as bonds, for OVITO, MDAnalysis and what else reads GSD. Needs Debian's python3-gsd.

        >>> import crumble, gsd.hoomd
        >>> crumble.read("data/samples/breaker-1.2.h5").to_gsd(folder / "breakup.gsd")
        >>> last = gsd.hoomd.open(str(folder / "breakup.gsd"))[-1]
        >>> last.particles.N, last.bonds.N, last.log["particles/fragment"].tolist()
        (8, 8, [0, 0, 0, 0, 1, 0, 0, 0])
        """
        gsd_file.write(self, path)

    @property
    def results(self):
        """Everything else by its path: morphology, critical stresses, errors, material.

        >>> import crumble
        >>> results = crumble.read("data/samples/rigidstress-1.2.h5").results
        >>> stress = results["flows/elongation-worst/critical_stress"]
        >>> print(f"{stress:.0f} {stress.unit}")
        54096 Pa
        """
        found = {}

        def take(path, member):
            if isinstance(member, h5py.Dataset) and path.split("/")[0] not in OTHERS:
                found[path] = array(member)

        with self._file() as file:
            file.visititems(take)
        return found

    @property
    def scene(self):
        """Every parameter as the run had it: {section: {key: value}}; keys that nobody set are absent.

        >>> import crumble
        >>> crumble.read("data/hollow.h5").scene["particle"]["number"]
        115
        """
        return tomllib.loads(self["parameters/resolved"])

    @property
    def provenance(self):
        """Program, version, commit, command, seed and parent.

        >>> import crumble
        >>> crumble.read("data/hollow.h5").provenance["program"]
        'dryer'
        """
        with self._file() as file:
            return {name: text_of(value) for name, value in file["parameters/provenance"].attrs.items()}


def read(path):
    """The result in a file of any program."""
    return Result(path)
