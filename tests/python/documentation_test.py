"""Type stubs, docstrings, and the programs in doc/python.md."""
import ast
import inspect
import os
import re
import subprocess
import sys
import tempfile
import unittest

import robosim


def stub():
    folder = os.path.dirname(robosim.__file__)
    with open(os.path.join(folder, "__init__.pyi"), encoding="utf-8") as file:
        return ast.parse(file.read())


def names_in(body):
    """Names of the public functions, classes and annotated variables of a module or class."""
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return {name for name in names if not name.startswith("_")}


class StubTest(unittest.TestCase):
    def test_has_every_public_name(self):
        self.assertEqual(names_in(stub().body), set(robosim.__all__))
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(robosim.__file__), "py.typed")))

    def test_has_every_member_of_every_class(self):
        for node in stub().body:
            if not isinstance(node, ast.ClassDef) or node.name.startswith("_"):
                continue
            real = getattr(robosim, node.name)
            members = {name for name in vars(real) if not name.startswith("_")}
            with self.subTest(node.name):
                # Attributes that a constructor sets are in the stub only.
                self.assertEqual(members - names_in(node.body) - {"NEXT_STEP", "SAME_STEP", "DISABLED"}, set())
                functions = {of.name for of in node.body if isinstance(of, ast.FunctionDef)}
                self.assertEqual({name for name in functions if not hasattr(real, name)}, set())


class DocstringTest(unittest.TestCase):
    def test_is_there_for_every_class_and_function(self):
        for name in robosim.__all__:
            with self.subTest(name):
                self.assertTrue(inspect.getdoc(getattr(robosim, name)))

    def test_states_shapes_and_units_of_arrays(self):
        for member in (robosim.Simulation.poses, robosim.Simulation.commands, robosim.Robot.sonar):
            self.assertRegex(member.__doc__, r"float(32|64), shape \(")
            self.assertRegex(member.__doc__, r"\[(m|m/s)\]")


class PageTest(unittest.TestCase):
    def test_programs_run(self):
        with open(os.environ["ROBOSIM_PAGE"], encoding="utf-8") as file:
            programs = re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)
        self.assertGreaterEqual(len(programs), 5)
        with tempfile.TemporaryDirectory() as folder:
            for program in programs:
                ended = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True)
                self.assertEqual(ended.returncode, 0, program + ended.stderr)


if __name__ == "__main__":
    unittest.main()
