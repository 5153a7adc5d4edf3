"""The driver of the comparison, with a stand-in for ARGoS (stand_in.py) that simulates nothing."""
import contextlib
import io
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import peers
from programs import Argos, Failed, MVSim, Simulator, first_readings, found, run
from scene import WORKLOADS, exact_ranges, make_scene

SCENE = make_scene(WORKLOADS["proximity"], 12, 1)


class Fixed(Simulator):
    """One that takes a second of processor time for each simulated one, or long_s for all longer runs, until its run number fails_at."""

    def __init__(self, name, readings=None, fails_at=math.inf, long_s=None):
        super().__init__(name, "none", "proximity")
        self.fixed_readings, self.fails_at, self.long_s, self.runs = readings, fails_at, long_s, 0

    def processor_s(self, scene, folder, seconds):
        self.runs += 1
        if self.runs >= self.fails_at:
            raise Failed("fell behind")
        return seconds if self.long_s is None else self.long_s

    def readings(self, scene, folder):
        return self.fixed_readings


class DriverTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def program(self, name):
        """A copy of the stand-in, whose name determines what it does."""
        return str(shutil.copy(Path(__file__).with_name("stand_in.py"), self.folder / name))

    def runner(self, name="argos3"):
        return peers.Runner(Argos("ARGoS", self.program(name), "proximity", 10), SCENE, self.folder / "run")

    def test_computes_the_rate_net_of_the_start(self):
        runner = self.runner()
        runner.calibrate(0.3)
        runner.measure()
        # 1 ms a step of twelve robots, whatever the start takes
        self.assertAlmostEqual(runner.rates[0], 12000, delta=4000)

    def test_lengthens_the_long_run_until_it_takes_long_enough(self):
        runner = self.runner()
        runner.calibrate(0.3)
        self.assertGreaterEqual(runner.used_s(), 0.1)

    def test_compares_the_readings_with_brute_force(self):
        exact = exact_ranges(SCENE)
        shares = self.runner().errors(exact)
        # The stand-in sees nothing.
        self.assertEqual(shares, [(0.1 - exact > limit).sum() / exact.size for limit in (0.002, 0.005, 0.01)])
        self.assertGreater(shares[0], 0)

    def test_reports_a_program_that_fails_with_its_last_lines(self):
        with self.assertRaisesRegex(Failed, r"faulty .*: ended with 3: \[FATAL\] no such plugin"):
            self.runner("faulty").errors(exact_ranges(SCENE))

    def test_reports_a_robot_without_readings(self):
        with self.assertRaisesRegex(Failed, "has printed no readings of r11"):
            self.runner("silent").errors(exact_ranges(SCENE))

    def test_reports_a_missing_program_with_its_option(self):
        with self.assertRaisesRegex(Failed, "--argos /nowhere/argos3: is no executable program; name the installed one"):
            found("/nowhere/argos3", "--argos")

    def test_takes_numbers_with_exponents_and_rays_without_an_echo(self):
        self.assertEqual(first_readings("[INFO] READINGS r0 1 inf 2.5e-05 \nREADINGS r0 7", 1, 3), [[1, math.inf, 2.5e-05]])
        self.assertTrue(math.isnan(first_readings("READINGS r0 -nan", 1, 1)[0][0]))

    def test_reports_a_robot_without_a_reading_of_each_ray(self):
        with self.assertRaisesRegex(Failed, "has printed 2 readings of r1 in place of 3"):
            first_readings("READINGS r0 1 2 3\nREADINGS r1 1 2 failed", 2, 3)

    def test_counts_readings_that_are_no_numbers_as_wrong(self):
        exact = exact_ranges(SCENE)
        runner = peers.Runner(Fixed("fixed", readings=[[math.nan] + list(ranges[1:]) for ranges in exact]), SCENE, self.folder / "run")
        self.assertEqual(runner.errors(exact), [1 / exact.shape[1]] * 3)

    def test_leaves_out_a_simulator_that_fails_in_a_round_and_prints_the_others(self):
        rows = [Fixed("steady"), Fixed("tiring", fails_at=4), Fixed("idle", long_s=0)]
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            peers.measure(rows, 4, peers.parse_arguments(["robosim", "--rounds", "2", "--at-least", "1"]), self.folder)
        # One second of processor time for a simulated one of 4 robots
        self.assertEqual([line.split(" | ")[1:4] for line in out.getvalue().splitlines()], [["steady", "4", "40"]])
        self.assertEqual(errors.getvalue().splitlines(),
                         ["idle, 4 robots: uses 0 s of processor time for 1e+07 simulated seconds, too little to be measured; "
                          "use more --robots or a smaller --at-least", "tiring, 4 robots: fell behind"])

    def test_refuses_a_round_in_which_the_long_run_took_no_more_time(self):
        runner = peers.Runner(Fixed("idle", long_s=0), SCENE, self.folder / "run")
        with self.assertRaisesRegex(Failed, "has used less processor time for 8 simulated seconds than for 2"):
            runner.measure()

    def test_refuses_mvsim_that_uses_a_processor_as_too_slow_net_of_its_start(self):
        mvsim = MVSim("MVSim", "mvsim", "sonar")
        mvsim.check_speed(0.8, 1, 12)
        with self.assertRaisesRegex(Failed, "does not keep up with real time with 12 robots"):
            mvsim.check_speed(1, 1, 12)

    def test_ends_mvsim_when_it_is_interrupted(self):
        pid = self.folder / "pid"

        def interrupted_wait(*_):
            while not (pid.exists() and pid.read_text()):
                pass
            raise KeyboardInterrupt

        with mock.patch("os.wait4", interrupted_wait), self.assertRaises(KeyboardInterrupt):
            MVSim("MVSim", self.program("mvsim"), "sonar").processor_s(SCENE, self.folder, 600)
        with self.assertRaises(ProcessLookupError):
            os.kill(int(pid.read_text()), 0)

    def test_reports_stage_without_headers(self):
        arguments = peers.parse_arguments(["robosim", "--stage", self.program("stage")])
        stage = peers.simulators(arguments)[1]
        with self.assertRaisesRegex(Failed, "has no headers in .*; name the program of a complete installation"):
            stage.prepare(SCENE, self.folder)

    def test_reports_mvsim_that_ends_by_itself(self):
        mvsim = MVSim("MVSim", "/bin/true", "sonar")
        with self.assertRaisesRegex(Failed, "ended by itself, with 0"):
            mvsim.processor_s(SCENE, self.folder, 5)

    def test_reports_an_option_without_its_partner(self):
        ended = subprocess.run([sys.executable, peers.__file__, "robosim", "--stage-cell", "0.1"], capture_output=True, text=True)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("--stage-cell needs --stage", ended.stderr)

    def test_prints_a_table_with_date_machine_and_what_was_not_measured(self):
        command = [peers.__file__, os.environ["ROBOSIM_PROGRAM"], "--argos", self.program("argos3"), "--robots", "4", "--rounds", "1",
                   "--at-least", "0.2"]
        text, _ = run(command, self.folder)
        lines = text.splitlines()
        self.assertRegex(lines[0], r"^\d+ \w+ \d{4}, .*one thread each, .*; not measured: stage, mvsim$")
        self.assertEqual([line.split(" | ")[1] for line in lines[4:]],
                         ["RoboSim", "RoboSim", "ARGoS, defaults", "ARGoS, one sub-step"])
        self.assertIn("| 0.0 / 0.0 / 0.0 % |", lines[4])


if __name__ == "__main__":
    unittest.main()
