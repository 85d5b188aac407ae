"""The hardening of a release, as its file tells: cmake/Harden.cmake."""
import platform
import re
import shutil
import subprocess
import unittest

from tool import TOOL


def readelf(*flags, file=TOOL):
    return subprocess.run(["readelf", "--wide", *flags, file], capture_output=True, text=True, check=True).stdout


def functions(file):
    """The functions that a file offers to the libraries it is loaded with, without their versions."""
    columns = [line.split() for line in readelf("--dyn-syms", file=file).splitlines()]
    return {row[7].split("@")[0] for row in columns if len(row) > 7 and row[3] == "FUNC" and row[6] != "UND"}


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

    def test_no_function_of_the_c_library_is_replaced(self):
        loaded = subprocess.run(["ldd", TOOL], capture_output=True, text=True, check=True).stdout
        library = re.search(r"libc\.so\.6 => (\S+)", loaded).group(1)
        offered = functions(library)
        self.assertTrue({"malloc", "pthread_create", "pthread_attr_init"} <= offered)
        self.assertEqual(functions(TOOL) & offered, set())

    @unittest.skipUnless(platform.machine() in ("x86_64", "AMD64"), "of processors of x86")
    def test_jumps_are_marked(self):
        disassembled = subprocess.run(["objdump", "--disassemble=main", "--no-show-raw-insn", TOOL], capture_output=True,
                                      text=True, check=True).stdout
        self.assertTrue("endbr64" in disassembled, "main() does not begin with endbr64")


if __name__ == "__main__":
    unittest.main()
