"""Files that are whole, or as they were: what a script writes has its name only when all of it is on the disk."""

import contextlib
import os
import pathlib


@contextlib.contextmanager
def replacing(path):
    """A name beside `path` to write to, which becomes `path` at the end. OSError: names `path`, which is as it was, and nothing is left beside it."""
    path = pathlib.Path(path)
    temporary = path.with_name(path.name + ".tmp")
    try:
        yield temporary
        with open(temporary, "rb") as written:
            os.fsync(written.fileno())
        os.replace(temporary, path)
    except BaseException as error:
        with contextlib.suppress(OSError):
            temporary.unlink()
        if isinstance(error, OSError) and error.errno and error.filename in (None, str(temporary), temporary):
            raise OSError(error.errno, error.strerror, str(path)) from None
        raise


def write_text(path, text):
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
