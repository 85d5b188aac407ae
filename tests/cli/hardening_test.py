"""What a release was built with, as its file tells: cmake/Harden.cmake."""
import platform
import re
import shutil
import subprocess
import unittest

from tool import TOOL


def readelf(*flags):
    return subprocess.run(["readelf", "--wide", *flags, TOOL], capture_output=True, text=True, check=True).stdout


@unittest.skipUnless(shutil.which("readelf"), "readelf (binutils) is not installed")
class Hardening(unittest.TestCase):
    def test_it_may_be_loaded_anywhere(self):
        self.assertRegex(readelf("--file-header"), r"Type: +DYN")
        self.assertRegex(readelf("--dynamic"), r"FLAGS_1.*\bPIE\b")

    def test_tables_of_calls_are_read_only(self):
        self.assertIn("GNU_RELRO", readelf("--program-headers"))
        self.assertRegex(readelf("--dynamic"), r"\bBIND_NOW\b|FLAGS_1.*\bNOW\b")

    def test_no_segment_is_written_and_executed(self):
        for line in readelf("--program-headers").splitlines():
            self.assertFalse(re.match(r" +(LOAD|GNU_STACK) .* RWE ", line), line)

    def test_stack_and_buffers_are_checked(self):
        symbols = readelf("--dyn-syms")
        self.assertIn("__stack_chk_fail", symbols)
        self.assertRegex(symbols, r"\b__(mem|str|v?s?n?printf|v?fprintf|read|recv|fread|poll|fdelt)\w*_chk\b")

    @unittest.skipUnless(platform.machine() in ("x86_64", "AMD64"), "of processors of x86")
    def test_jumps_are_marked(self):
        disassembled = subprocess.run(["objdump", "--disassemble=main", "--no-show-raw-insn", TOOL], capture_output=True,
                                      text=True, check=True).stdout
        self.assertTrue("endbr64" in disassembled, "main() does not begin with endbr64")


if __name__ == "__main__":
    unittest.main()
