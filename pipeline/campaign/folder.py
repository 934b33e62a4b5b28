"""One campaign at a time writes to a folder."""

import fcntl
import os
import platform

from scene_text import Fault


def own(folder, part=False):
    """Keeps `folder` for this process until it ends, however it ends; parts of one campaign have it together. Fault: another one has it, named with
    process and machine."""
    place = folder / ".campaign.lock"
    file = open(place, "a+", encoding="utf-8")
    try:
        fcntl.flock(file, (fcntl.LOCK_SH if part else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except BlockingIOError:
        file.seek(0)
        raise Fault(f"{folder}: a campaign is written there by {file.read().strip() or 'another process'}; wait for it, end it, or write elsewhere") from None
    file.truncate(0)
    file.write(f"process {os.getpid()} on {platform.node()}\n")
    file.flush()
    return file
