"""The example that is a referee."""
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.join(os.path.dirname(__file__), "../../doc/examples/soccer.py")


class SoccerExampleTest(unittest.TestCase):
    def test_counts_goals_and_makes_kick_offs_that_replay_repeats(self):
        with tempfile.TemporaryDirectory() as folder:
            recording = os.path.join(folder, "game.rawlog")
            game = subprocess.run([sys.executable, PROGRAM, "120", recording], check=True, capture_output=True, text=True).stdout
            goals = [line for line in game.splitlines() if line.startswith("at ")]
            self.assertGreater(len(goals), 0, game)
            robosim = os.path.join(os.environ["ROBOSIM_PREFIX"], "bin", "robosim")
            check = subprocess.run([robosim, "replay", "--check", "soccer", recording], capture_output=True, text=True)
            self.assertEqual(check.returncode, 0, check.stdout + check.stderr)


if __name__ == "__main__":
    unittest.main()
