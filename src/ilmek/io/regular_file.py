"""Opening of files of others: a regular file alone, and without waiting for a pipe or a device."""

import errno
import io
import os
import stat
from pathlib import Path


def open_regular(path: Path, *, follow: bool = True) -> tuple[io.BufferedReader, int]:
    """A regular file, open for reading, and its size [bytes]; the caller closes it.

    follow  links; else a link is no regular file
    Raises OSError with the system's reason, IsADirectoryError for a folder, and OSError "Is a pipe or a device" for
    everything else that is no file. A null character in the path is a file that does not exist.
    """
    try:
        _require_regular(path.stat(follow_symlinks=follow))
        # Between the two checks the path may become a pipe, which would block without O_NONBLOCK.
        flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
        flags |= 0 if follow else getattr(os, "O_NOFOLLOW", 0)
        file = os.fdopen(os.open(path, flags), "rb")
    except ValueError:  # a null character
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT)) from None
    try:
        status = os.fstat(file.fileno())
        _require_regular(status)
    except BaseException:
        file.close()
        raise
    return file, status.st_size


def _require_regular(status: os.stat_result) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(status.st_mode):
        raise OSError(errno.EINVAL, "Is a pipe or a device")
