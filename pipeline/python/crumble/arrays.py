"""Arrays that know their unit, and tables of them."""

import numpy


class Array(numpy.ndarray):
    """An array of numpy with the `unit` that stands in the file; "" is dimensionless.

    A part of an array has the unit of the whole. What is computed is an array of numpy without a unit, since its unit may be another:

    >>> length = Array([1.0, 2.0], "nm")
    >>> length[:1].unit
    'nm'
    >>> type(length * length).__name__
    'ndarray'
    """

    def __new__(cls, values, unit=""):
        made = numpy.asarray(values).view(cls)
        made.unit = unit
        return made

    def __array_finalize__(self, whole):
        self.unit = getattr(whole, "unit", "")

    def __array_ufunc__(self, function, method, *inputs, out=None, **more):
        plain = [value.view(numpy.ndarray) if isinstance(value, Array) else value for value in inputs]
        if out is not None:
            more["out"] = tuple(value.view(numpy.ndarray) if isinstance(value, Array) else value for value in out)
        return getattr(function, method)(*plain, **more)


class Table:
    """Arrays of equal length by their names: `table.gap` or `table["gap"]`. Iteration gives the names, `len` the number of rows.

    >>> table = Table({"gap": Array([0.1, -0.1], "nm"), "pair": Array([[0, 1], [1, 2]])})
    >>> table.gap.unit, len(table), list(table)
    ('nm', 2, ['gap', 'pair'])
    """

    def __init__(self, columns):
        self._columns = dict(columns)

    def __getitem__(self, name):
        if name not in self._columns:
            raise KeyError(f"no {name} here; there are {', '.join(self) or 'none'}")
        return self._columns[name]

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as missing:
            raise AttributeError(missing.args[0]) from None

    def __iter__(self):
        return iter(self._columns)

    def __contains__(self, name):
        return name in self._columns

    def __len__(self):
        return len(next(iter(self._columns.values()), ()))

    def __dir__(self):
        return [*super().__dir__(), *self]

    def __repr__(self):
        names = (f"{name} [{array.unit}]" if array.unit else name for name, array in self._columns.items())
        return f"<{len(self)} rows: {', '.join(names)}>"

    @property
    def units(self):
        return {name: array.unit for name, array in self._columns.items()}

    def to_pandas(self):
        """A DataFrame. Vectors become columns name_x, name_y, name_z, other rows of numbers name_0, name_1, ...; its `attrs["units"]` has
        the unit of each column.

        >>> import crumble
        >>> frame = crumble.read("data/hollow.h5").contacts().to_pandas()
        >>> frame.shape, frame.attrs["units"]["sliding_x"]
        ((170, 23), 'nm')
        >>> int((frame.normal_force > 0).sum())     # contacts under tension
        86
        """
        import pandas  # not needed for anything else

        columns, units = {}, {}
        for name, array in self._columns.items():
            parts = {name: array}
            if array.ndim > 1:
                flat = array.reshape(len(array), -1)
                ends = "xyz" if flat.shape[1] == 3 else range(flat.shape[1])
                parts = {f"{name}_{end}": flat[:, k] for k, end in enumerate(ends)}
            for part, values in parts.items():
                columns[part], units[part] = numpy.asarray(values), array.unit
        frame = pandas.DataFrame(columns)
        frame.attrs["units"] = units
        return frame
