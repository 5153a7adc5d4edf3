"""The examples that learn to find gold."""
import os
import subprocess
import sys
import tempfile
import unittest

EXAMPLES = os.path.join(os.path.dirname(__file__), "../../doc/examples")


def learn(program, folder, *arguments):
    return subprocess.run([sys.executable, os.path.join(EXAMPLES, program), "--policy", os.path.join(folder, "policy.npz"), *arguments],
                          check=True, capture_output=True, text=True).stdout


def table_of(output):
    return [line for line in output.splitlines() if line.startswith("| ")]


class LearnGoldTest(unittest.TestCase):
    def check(self, program, controllers, *tests):
        with tempfile.TemporaryDirectory() as folder:
            table = table_of(learn(program, folder, "--minutes", "0.001", *tests))
            self.assertEqual([line.split("|")[1].strip() for line in table], ["controller", *controllers])
            again = learn(program, folder, "--evaluate", os.path.join(folder, "policy.npz"), *tests)
            self.assertEqual(table_of(again), table)  # one policy and one seed give the same times

    def test_trains_stores_its_policy_and_compares_it_with_other_controllers(self):
        self.check("learn_gold.py", ["wander", "wall_follower", "gold_finder", "learned"], "--mazes", "2")

    def test_learns_from_pictures(self):
        self.check("learn_gold_pixels.py", ["untrained", "gold_finder, with the heat only", "learned"], "--rooms", "2")


if __name__ == "__main__":
    unittest.main()
