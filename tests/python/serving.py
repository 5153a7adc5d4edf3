"""`robosim serve` of the installation, for tests."""
import os
import subprocess
import tempfile


class Serving:
    """Serves a world, of a text, at `address`; its summary is the JSON text that finish() returns."""

    def __init__(self, text, *options):
        self._folder = tempfile.TemporaryDirectory()
        file = os.path.join(self._folder.name, "scene.xml")
        with open(file, "w", encoding="utf-8") as world:
            world.write(text)
        program = os.path.join(os.environ["ROBOSIM_PREFIX"], "bin", "robosim")
        self._program = subprocess.Popen([program, "serve", file, "--listen", ":0", "--wait-for-robots", "--json",
                                          "--step-deadline", "600", *options],
                                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        said = ""
        for line in self._program.stderr:
            said += line
            if "listening on " in line:
                self.address = line.split("listening on ")[1].strip()
                return
        raise AssertionError("robosim serve has ended: " + said)

    def kill(self):
        self._program.kill()
        self._program.wait()

    def finish(self):
        """Waits for the end of the run."""
        return self._program.communicate()[0]

    def __enter__(self):
        return self

    def __exit__(self, *args):
        self._program.kill()
        self._program.communicate()
        self._folder.cleanup()
