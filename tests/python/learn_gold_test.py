"""The example that learns to find gold."""
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.join(os.path.dirname(__file__), "../../doc/examples/learn_gold.py")


def learn(folder, *arguments):
    return subprocess.run([sys.executable, PROGRAM, "--policy", os.path.join(folder, "policy.npz"), *arguments], check=True,
                          capture_output=True, text=True).stdout


class LearnGoldTest(unittest.TestCase):
    def test_trains_stores_its_policy_and_compares_it_with_other_controllers(self):
        with tempfile.TemporaryDirectory() as folder:
            table = learn(folder, "--minutes", "0.001", "--mazes", "2")
            rows = [line.split("|")[1].strip() for line in table.splitlines() if line.startswith("| ")]
            self.assertEqual(rows, ["controller", "wander", "wall_follower", "gold_finder", "learned"])
            again = learn(folder, "--evaluate", os.path.join(folder, "policy.npz"), "--mazes", "2")
            self.assertEqual(again, table)  # one policy and one seed give the same times


if __name__ == "__main__":
    unittest.main()
