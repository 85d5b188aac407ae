"""Some hostile files of every format: the tool ends by itself, with one sentence, soon and in little memory.

hostile_soak.py does the same with thousands; it names the file that ended badly.
"""
import unittest

import hostile
import hostile_chains
import hostile_seeds
from tool import ToolTest, costly_cases, in_soak, main


class Hostile(ToolTest):
    def setUp(self):
        super().setUp()
        hostile_seeds.beside(self.folder, lambda words: hostile.run(words, self.folder))

    def ends_well(self, name, label, file, content, words):
        ended = hostile.try_file(self.folder, file, content, words)
        with self.subTest(file=name, variant=label):
            self.assertEqual(ended.wrong, "", f"{words}: {ended.output[:500]}")
        return ended

    def test_variants_of_valid_files(self):
        for number, seed in enumerate([*hostile_seeds.seeds(self.folder)]):
            valid = self.ends_well(seed.name, "valid", seed.file, seed.content, seed.words)
            self.assertIn(valid.status >> 8, (0, 1), f"{seed.name}: {valid.output}")
            made = hostile.variants(seed, hostile.generator(1, seed.name), 0.02 * costly_cases(1))
            for label, content in made if in_soak() else made[number % 2::2]:  # every second kind of damage
                self.ends_well(seed.name, label, seed.file, content, seed.words)

    def test_chains_and_nestings(self):
        for family, made in (("databases", hostile_chains.databases()), ("chains", hostile_chains.chains()),
                             ("nestings", hostile_chains.nestings(every_depth=in_soak()))):
            for name, file, content, words in made:
                self.ends_well(family, name, file, content(), [file if word is hostile_seeds.FILE else word for word in words])


if __name__ == "__main__":
    main()
