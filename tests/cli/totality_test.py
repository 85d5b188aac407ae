"""A drawn part of `make totality`: every job takes keys at the ends of their ranges, and beyond, within its bounds."""
import pathlib
import tempfile
import unittest

from tool import costly_cases, main
from totality import Case, bases, cases, run, text_of, write_worlds


class Totality(unittest.TestCase):
    def setUp(self):
        home = tempfile.TemporaryDirectory(prefix="outrider-totality-")
        self.addCleanup(home.cleanup)
        self.folder = pathlib.Path(home.name)
        write_worlds(self.folder)

    def test_the_bases_themselves_are_answered(self):
        """Otherwise their keys would be tried in vain."""
        for base in bases():
            with self.subTest(base):
                result = run(Case(base, {}), self.folder)
                self.assertEqual(result.complaint, "")
                self.assertLess(result.status, 2, text_of(Case(base, {})))

    def test_drawn_values_and_pairs(self):
        for case in cases(costly_cases(20), seed=62):
            with self.subTest(case.named()):
                self.assertEqual(run(case, self.folder).complaint, "", case.words or text_of(case)[:1000])


if __name__ == "__main__":
    main()
