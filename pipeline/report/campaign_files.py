"""The granules of a campaign and where their files are, by its table granules.csv."""

import csv
import dataclasses
import pathlib


@dataclasses.dataclass(frozen=True)
class Granule:
    kind: str             # name of the scene that it was dried from
    seed: int
    folder: pathlib.Path
    ids: dict             # stage -> id of its files

    @property
    def name(self):
        """As of the links that `campaign run --names` makes."""
        return f"{self.kind}-{self.seed}"

    def file(self, stage, ending):
        return self.folder / stage / f"{self.ids[stage]}{ending}"


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        yield from csv.DictReader(line for line in file if not line.startswith("#"))


def read(path, *stages):
    """Those that all of these stages ended well for, in the order of the table."""
    for row in rows(path):
        ids = {"dry": row["id"], **{stage: row[f"{stage}_id"] for stage in ("stress", "breakup") if row.get(f"{stage}_id")}}
        if row.get("dry_sha256") and ids.keys() >= set(stages):
            yield Granule(row.get("dry.scene [1]") or path.parent.name, int(row["seed"]), path.parent, ids)


def by_kind(path, *stages):
    found = {}
    for granule in read(path, *stages):
        found.setdefault(granule.kind, []).append(granule)
    return found
