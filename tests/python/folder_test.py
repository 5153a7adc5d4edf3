"""Where an installation puts the package: on the path of the interpreter, for each prefix."""
import os
import subprocess
import sys
import tempfile
import unittest


def run(*command, **environment):
    without_path = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    return subprocess.run(command, env={**without_path, **environment}, capture_output=True, text=True)


class FolderTest(unittest.TestCase):
    def test_for_a_user_is_found_without_further_settings(self):
        ended = run(sys.executable, "-c", "import robosim; print(robosim.World.generate('maze').name)",
                    HOME=os.environ["ROBOSIM_HOME"])
        self.assertEqual((ended.stdout, ended.returncode), ("maze\n", 0), ended.stderr)

    def test_for_usr_local_is_in_a_folder_of_the_interpreter(self):
        folders = run(sys.executable, "-c", "import site; print(*site.getsitepackages())").stdout.split()
        local = [folder for folder in folders if folder.startswith("/usr/local/")]
        with tempfile.TemporaryDirectory() as root:
            ended = run("cmake", "--install", os.environ["ROBOSIM_BUILD"], "--component", "python3-robosim", "--prefix",
                        "/usr/local", DESTDIR=root)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertEqual([folder for folder in local if os.path.exists(f"{root}{folder}/robosim/_robosim.so")],
                             local[:1])


if __name__ == "__main__":
    unittest.main()
