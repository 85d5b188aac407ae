"""A witness of what is opened in a folder: the kernel's own word (inotify), which shares no code with the tool."""
import ctypes
import os
import struct

IN_ACCESS, IN_OPEN, IN_ISDIR = 0x1, 0x20, 0x40000000
LIBC = ctypes.CDLL(None, use_errno=True)


class Witness:
    """Names the files of a folder that anybody opened since it was asked last."""

    def __init__(self, folder):
        self.descriptor = LIBC.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        assert self.descriptor >= 0
        watch = LIBC.inotify_add_watch(self.descriptor, os.fsencode(folder), IN_OPEN | IN_ACCESS)
        assert watch >= 0, ctypes.get_errno()

    def opened(self):
        names = set()
        while True:
            try:
                data = os.read(self.descriptor, 65536)
            except BlockingIOError:
                return names
            while data:
                _, mask, _, length = struct.unpack_from("iIII", data)
                name = data[16:16 + length].rstrip(b"\0").decode(errors="replace")
                data = data[16 + length:]
                if not mask & IN_ISDIR:
                    names.add(name)

    def close(self):
        os.close(self.descriptor)
