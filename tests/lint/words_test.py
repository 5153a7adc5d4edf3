#!/usr/bin/env python3
"""What words.py finds, and what it does not."""
import unittest

from words import faults_of, rules_of

RULES = rules_of("# a comment\nis told\treceives\nnobody|stranger\tno robot\n")


class Words(unittest.TestCase):
    def words(self, line):
        return [word for word, _ in faults_of(line, RULES)]

    def test_of_a_text_are_found_as_whole_words_in_either_case(self):
        self.assertEqual(self.words("Nobody knows; a strangers' file"), ["Nobody"])

    def test_of_an_identifier_are_found_between_underscores_and_capitals(self):
        self.assertEqual(self.words("bool isToldOfWinner();"), ["is Told"])
        self.assertEqual(self.words("bool is_told_of_winner = false;"), ["is told"])
        self.assertEqual(self.words("TEST(Run, WithHTTPNobody)"), ["Nobody"])

    def test_that_only_resemble_a_rejected_one_are_accepted(self):
        self.assertEqual(self.words("this told_ nobodys strangeness"), [])

    def test_have_the_advice_of_their_line(self):
        self.assertEqual(faults_of("nobody", RULES), [("nobody", "no robot")])


if __name__ == "__main__":
    unittest.main()
