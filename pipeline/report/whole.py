"""Files that are whole, or as they were: what a script writes has its name only when all of it is on the disk."""

import contextlib
import filecmp
import os
import pathlib
import platform


@contextlib.contextmanager
def replacing(path, keep=False):
    """A name beside `path` to write to, which becomes `path` at the end; keep: unless it holds the same already. OSError: names `path`, which is as it
    was, and nothing is left beside it. Another process that writes the same, as parts of a campaign do, is not in the way."""
    path = pathlib.Path(path)
    temporary = path.with_name(f"{path.name}.{platform.node()}.{os.getpid()}.tmp")
    try:
        yield temporary
        with open(temporary, "rb") as written:
            os.fsync(written.fileno())
        if keep and path.exists() and filecmp.cmp(temporary, path, shallow=False):
            temporary.unlink()
        else:
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
