#!/usr/bin/env python3
"""What words.py finds, and what it does not."""
import unittest

from words import faults_of, rules_of

RULES = rules_of("# a comment\nrun over\tended\ngadget|widget\tdevice\n")


class Words(unittest.TestCase):
    def words(self, line):
        return [word for word, _ in faults_of(line, RULES)]

    def test_of_a_text_are_found_as_whole_words_in_either_case(self):
        self.assertEqual(self.words("Gadget; a widgets' file"), ["Gadget"])

    def test_of_an_identifier_are_found_between_underscores_and_capitals(self):
        self.assertEqual(self.words("bool isRunOver();"), ["Run Over"])
        self.assertEqual(self.words("bool is_run_over = false;"), ["run over"])
        self.assertEqual(self.words("TEST(Run, WithHTTPGadget)"), ["Gadget"])

    def test_that_only_resemble_a_rejected_one_are_accepted(self):
        self.assertEqual(self.words("run overflow_ gadgets widgetry"), [])

    def test_have_the_advice_of_their_line(self):
        self.assertEqual(faults_of("gadget", RULES), [("gadget", "device")])


if __name__ == "__main__":
    unittest.main()
