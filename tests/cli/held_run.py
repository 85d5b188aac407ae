"""A run of the tool that a test holds: it waits while a descriptor to which it tells is full (docs/server.md)."""
import array
import fcntl
import os
import subprocess
import termios

from tool import TOOL, until

PIPE_BYTES = 4096


class HeldRun(subprocess.Popen):
    """Runs the tool; what it writes to the descriptor that `variable` names waits to be read. Of the pipe's few
    kilobytes `room` bytes are free."""

    def __init__(self, *words, variable="OUTRIDER_LIVE", room=PIPE_BYTES, **options):
        self.told, its = os.pipe()
        fcntl.fcntl(its, fcntl.F_SETPIPE_SZ, PIPE_BYTES)
        self.filled = PIPE_BYTES - room
        os.write(its, b"\n" * self.filled)
        super().__init__([TOOL, *map(str, words)], stdin=subprocess.DEVNULL, pass_fds=[its],
                         env={**os.environ, variable: str(its)}, **options)
        os.close(its)

    def wait_until_held(self):
        """Waits until it has told something; what does not fit into the room holds it."""
        waiting = array.array("i", [0])

        def more():
            fcntl.ioctl(self.told, termios.FIONREAD, waiting)
            return waiting[0] > self.filled

        until("what the run tells", more)

    def read(self, count):
        """The next bytes that it told, fewer only at its end."""
        data = b""
        while len(data) < count and (more := os.read(self.told, min(count - len(data), 65536))):
            data += more
        return data

    def let_go(self):
        """Lets it go on without anybody who listens."""
        if self.told is not None:
            os.close(self.told)
        self.told = None

    def __exit__(self, *fault):
        self.let_go()
        super().__exit__(*fault)
