"""The examples for PyTorch, TorchRL and BenchMARL, as far as that is possible without these packages."""
import ast
import glob
import os
import subprocess
import sys
import unittest

FOLDER = os.path.join(os.path.dirname(__file__), "../../doc/examples/torch")


class TorchExamplesTest(unittest.TestCase):
    def test_are_programs_of_python(self):
        files = sorted(glob.glob(os.path.join(FOLDER, "*.py")))
        self.assertEqual([os.path.basename(file) for file in files], ["benchmarl_task.py", "ppo_gold.py", "torchrl_env.py"])
        for file in files:
            with open(file, encoding="utf-8") as text:
                self.assertTrue(ast.get_docstring(ast.parse(text.read())))

    def test_options_of_the_program_for_pytorch_need_no_pytorch(self):
        text = subprocess.run([sys.executable, os.path.join(FOLDER, "ppo_gold.py"), "--help"], check=True, capture_output=True,
                              text=True).stdout
        self.assertIn("--iterations", text)


if __name__ == "__main__":
    unittest.main()
