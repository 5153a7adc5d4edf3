"""The checks of python -m robosim.check, with what is installed."""
import subprocess
import sys
import unittest


class CheckTest(unittest.TestCase):
    def test_passes_its_own_checks_and_names_missing_packages(self):
        ended = subprocess.run([sys.executable, "-m", "robosim.check"], capture_output=True, text=True)
        self.assertIn(ended.returncode, (0, 2), ended.stdout + ended.stderr)  # 2: a package is not installed
        self.assertEqual(ended.returncode == 2, "missing: " in ended.stdout)
        self.assertIn("passed: robosim.check_env(ParallelEnv)", ended.stdout)


if __name__ == "__main__":
    unittest.main()
