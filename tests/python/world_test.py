"""Worlds in Python: reading, generating, writing, and errors in them."""
import os
import subprocess
import sys
import tempfile
import unittest

import robosim

WORLD = """<world><surface>
<size><xmin>-5</xmin><xmax>5</xmax><ymin>-4</ymin><ymax>4</ymax></size>
<object><shape><primitive><cylinder><name>Gold</name><x>2</x><y>1</y><z>0.25</z><radius>0.2</radius>
<height>0.5</height><color>1 0.8 0</color><hot>20</hot><stationary>1</stationary></cylinder></primitive></shape></object>
<object><shape><robot><model>pioneer3dx</model><name>R1</name><x>-1</x><y>0.5</y><direction>0</direction>
</robot></shape></object>
</surface></world>"""


class WorldTest(unittest.TestCase):
    def test_describes_its_contents(self):
        world = robosim.World.parse(WORLD, name="small")
        self.assertEqual(world.name, "small")
        self.assertEqual(world.bounds, (-5, 5, -4, 4))
        (robot,) = world.robots
        self.assertEqual((robot.name, robot.type, robot.start), ("R1", "pioneer3dx", (-1, 0.5, 0)))
        self.assertIn("sonar", [sensor.kind for sensor in robot.sensors])
        (gold,) = world.objects
        self.assertEqual((gold.name, gold.shape, gold.pose[:2], gold.heat_celsius), ("Gold", "cylinder", (2, 1), 20))
        self.assertEqual(gold.size_m, (0.4, 0.4))

    def test_describes_errors_and_measurement_times_of_sensors(self):
        laser = '<sensors><laser rate_hz="5" phase_s="0.1"><noise std_m="0.02"/></laser><odometry/></sensors></robot>'
        (robot,) = robosim.World.parse(WORLD.replace("</robot>", laser), name="small").robots
        (laser,) = [sensor for sensor in robot.sensors if sensor.kind == "laser"]
        self.assertEqual((laser.rate_hz, laser.phase_s, laser.noise_std_m), (5, 0.1, 0.02))
        self.assertEqual((laser.beam_width_rad, laser.bearing_std_rad), (0, 0))

    def test_reports_all_faults_with_file_and_line(self):
        text = WORLD.replace("pioneer3dx", "tortoise").replace("<xmax>5<", "<xmax>five<")
        with self.assertRaises(robosim.ConfigError) as raised:
            robosim.World.parse(text, folder="/tmp", name="bad")
        self.assertEqual(len(raised.exception.errors), 2)
        self.assertTrue(raised.exception.errors[0].startswith("/tmp/bad.xml:2: "), raised.exception)
        self.assertIn("tortoise", raised.exception.errors[1])
        self.assertIsInstance(raised.exception, ValueError)

    def test_reports_a_missing_file(self):
        with self.assertRaisesRegex(robosim.ConfigError, "^missing.xml: no such file; check the path; searched are also "):
            robosim.World.load("missing.xml")

    def test_loads_installed_worlds_and_finds_installed_robot_types(self):
        share = os.path.join(os.environ["ROBOSIM_PREFIX"], "share", "robosim")
        world = robosim.World.load(os.path.join(share, "worlds", "small_maze.xml"))
        self.assertEqual([robot.type for robot in world.robots], ["pioneer3dx", "scout"])

    def test_finds_installed_worlds_and_maps_by_name_as_the_command_line_does(self):
        share = os.path.join(os.environ["ROBOSIM_PREFIX"], "share", "robosim")
        for name, file in (("opho2_1", "worlds/opho2_1.xml"), ("worlds/opho2_1.xml", "worlds/opho2_1.xml"),
                           ("office.map", "maps/office.map")):
            with self.subTest(name=name):
                world = robosim.World.load(name)
                self.assertTrue(os.path.samefile(world.file, os.path.join(share, file)), world.file)
        self.assertEqual(len(robosim.VectorEnv("small_maze").reset()[0]), 1)

    def test_generates_equal_worlds_for_equal_seeds(self):
        def maze(seed):
            return robosim.World.generate("maze", columns=4, rows=3, robots=2, seed=seed).to_xml()

        self.assertEqual(maze(3), maze(3))
        self.assertNotEqual(maze(3), maze(4))
        for kind in ("cave", "office", "open"):
            self.assertEqual(len(robosim.World.generate(kind, robots=3).robots), 3)

    def test_refuses_unknown_generators_and_options(self):
        with self.assertRaisesRegex(robosim.ConfigError, "no generator 'castle'; use maze, cave, office or open"):
            robosim.World.generate("castle")
        with self.assertRaisesRegex(TypeError, "no option 'clutter'; its options are columns, rows, braid, cell_m"):
            robosim.World.generate("maze", clutter=1)
        with self.assertRaisesRegex(TypeError, "columns must be a whole number"):
            robosim.World.generate("maze", columns="many")
        with self.assertRaisesRegex(robosim.ConfigError, "it must be 2 to 1000"):
            robosim.World.generate("maze", columns=1)

    def test_a_written_world_is_read_as_the_same_world(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "cave.xml")
            world = robosim.World.generate("cave", robots=2)
            world.write(file)
            self.assertEqual(robosim.World.load(file).to_xml(), world.to_xml())
            with self.assertRaises(robosim.ConfigError):
                world.write(os.path.join(folder, "missing", "cave.xml"))

    def test_scattered_robots_depend_on_the_seed(self):
        share = os.path.join(os.environ["ROBOSIM_PREFIX"], "share", "robosim")
        file = share + "/worlds/scatter_swarm.xml"
        starts = [robosim.World.load(file, seed=seed).robots[0].start for seed in (1, 1, 2)]
        self.assertEqual(starts[0], starts[1])
        self.assertNotEqual(starts[0], starts[2])


class ImportTest(unittest.TestCase):
    def test_loads_neither_the_engine_nor_numpy(self):
        program = "import sys, robosim; print([m for m in ('numpy', 'robosim._robosim') if m in sys.modules])"
        self.assertEqual(subprocess.check_output([sys.executable, "-c", program], text=True), "[]\n")

    def test_names_the_version_and_unknown_attributes(self):
        self.assertRegex(robosim.__version__, r"^\d+\.\d+\.\d+$")
        with self.assertRaisesRegex(AttributeError, "module 'robosim' has no attribute 'Wrold'"):
            robosim.Wrold


if __name__ == "__main__":
    unittest.main()
