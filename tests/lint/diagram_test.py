"""Diagrams of the documentation's site, as text for Graphviz."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "doc/site"))
import diagram  # noqa: E402


class DiagramTest(unittest.TestCase):
    def test_a_chain_has_an_arrow_from_each_to_each(self):
        lines = diagram.dot("```mermaid\nflowchart TB\n a --> b & c --> d; e --> a\n```").splitlines()
        self.assertEqual([line for line in lines if "->" in line], ["a -> b", "a -> c", "b -> d", "c -> d", "e -> a"])

    def test_a_node_lies_in_the_group_in_which_it_begins_an_arrow(self):
        drawn = diagram.dot("flowchart TB\nsubgraph upper\n a --> b\n c\nend\nsubgraph lower\n b --> d\nend\nd --> a")
        self.assertIn('label="upper"; style=rounded; a c }', drawn)
        self.assertIn('label="lower"; style=rounded; b d }', drawn)

    def test_a_node_has_its_text(self):
        self.assertIn('o [label="run/outputs"]', diagram.dot('flowchart TB\no["run/outputs"] --> run'))

    def test_what_is_no_node_is_named(self):
        with self.assertRaisesRegex(ValueError, "'a b' is no node"):
            diagram.dot("flowchart TB\na b --> c")
