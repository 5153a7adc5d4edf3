"""The decoder of readings and the encoder of commands, compared with the classes that protobuf generates."""
import unittest

import numpy as np

from robosim._step_readings import StepAnswer, StepDecoder, StepReadings
from robosim.v1 import robots_pb2 as v1
from robosim.v1 import sensors_pb2


def random_step(random, robots, is_regular):
    """Readings of robots with four sensors: floats, doubles, flags and a camera."""
    step = v1.StepReadings(step=int(random.choice([0, 1, 127, 128, 20000])))
    sizes = [8, 3, 5, 9]
    for _ in range(robots):
        robot = step.robots.add()
        for sensor, size in enumerate(sizes):
            measurement = robot.measurements.add()
            if not is_regular and random.random() < 0.2:
                continue  # no measurement in this step
            if sensor == 0:
                measurement.floats.extend(random.normal(size=size).astype(np.float32).tolist())
            elif sensor == 1:
                measurement.doubles.extend(random.normal(size=size).tolist())
            elif sensor == 2:
                measurement.flags = bytes(random.integers(0, 2, size).tolist())
            else:
                measurement.jpeg = random.bytes(size if is_regular else int(random.integers(0, 300)))
            measurement.step = step.step
            measurement.is_new = True
        robot.stalled = bool(random.random() < 0.3)
        robot.is_too_far = bool(random.random() < 0.1)
        if random.random() < 0.2:
            robot.laser_pan_rad = 0.5
            robot.inbox.add(**{"from": "R1", "text": random.bytes(3)})
    if random.random() < 0.3:
        step.winner = "R1"
    return step


class StepReadingsTest(unittest.TestCase):
    def expect_equal(self, read, step):
        self.assertEqual((read.step, read.winner), (step.step, step.winner))
        np.testing.assert_array_equal(read.stalled, [robot.stalled for robot in step.robots])
        np.testing.assert_array_equal(read.is_too_far, [robot.is_too_far for robot in step.robots])
        for index, robot in enumerate(step.robots):
            self.assertEqual(read.inboxes.get(index, []), [(getattr(m, "from"), m.text) for m in robot.inbox])
            self.assertEqual(read.file(index, 0, 3), robot.measurements[3].jpeg)
        for sensor, field in enumerate(("floats", "doubles", "flags")):
            numbers = read.numbers(0, sensor, 1)
            self.assertFalse(numbers.flags.writeable)
            for row, robot in zip(numbers, step.robots):
                expected = list(getattr(robot.measurements[sensor], field))
                if expected:
                    self.assertEqual(row.ravel().tolist(), expected)
                elif field != "flags":
                    self.assertTrue(np.isnan(row).all())

    def test_equal_the_generated_classes(self):
        random = np.random.default_rng(1)
        for robots in (1, 2, 7, 200):
            decoder = StepDecoder([4], [np.arange(robots)])
            for trial in range(40):
                step = random_step(random, robots, is_regular=trial % 2 == 0)
                data = v1.DriveResponse(readings=step).SerializeToString()
                with self.subTest(robots=robots, trial=trial):
                    self.expect_equal(StepReadings(data, decoder), step)

    def test_of_robots_at_equal_distances_are_views_of_the_message(self):
        step = v1.StepReadings(step=5)
        for index in range(4):
            step.robots.add().measurements.add(floats=[index, 10 + index], step=5, is_new=True)
        data = v1.DriveResponse(readings=step).SerializeToString()
        read = StepReadings(data, StepDecoder([1], [np.arange(4)]))
        numbers = read.numbers(0, 0, 2)
        self.assertTrue(np.may_share_memory(numbers, np.frombuffer(data, np.uint8)))
        self.assertEqual(numbers.tolist(), [[[0, 10]], [[1, 11]], [[2, 12]], [[3, 13]]])

    def test_without_a_measurement_are_empty(self):
        step = v1.StepReadings(step=5)
        for index in range(4):
            robot = step.robots.add(stalled=index == 1)
            robot.measurements.add(floats=[index], step=5, is_new=True)
            robot.measurements.add()
        read = StepReadings(v1.DriveResponse(readings=step).SerializeToString(), StepDecoder([2], [np.arange(4)]))
        self.assertEqual(read.numbers(0, 0, 1).tolist(), [[[0]], [[1]], [[2]], [[3]]])
        self.assertEqual(read.numbers(0, 1, 1).shape, (4, 0, 1))
        self.assertEqual(read.stalled.tolist(), [False, True, False, False])

    def test_skip_fields_of_later_versions(self):
        later = b"\x78\x01" + b"\x7a\x02ab" + b"\x79" + bytes(8) + b"\x7d" + bytes(4)  # field 15 of every wire type
        measurement = sensors_pb2.Measurement(floats=[1, 2], step=1).SerializeToString() + later
        robot = b"\x0a" + bytes([len(measurement)]) + measurement + later + b"\x10\x01"
        step = b"\x08\x01" + later + b"\x12" + bytes([len(robot)]) + robot + later
        data = b"\x12" + bytes([len(step)]) + step
        read = StepReadings(data, StepDecoder([1], [np.arange(1)]))
        self.assertEqual((read.step, read.stalled.tolist()), (1, [True]))
        self.assertEqual(read.numbers(0, 0, 2).tolist(), [[[1, 2]]])

    def test_refuse_readings_of_another_number_of_robots_or_sensors(self):
        step = v1.StepReadings()
        step.robots.add().measurements.add(floats=[1])
        data = v1.DriveResponse(readings=step).SerializeToString()
        with self.assertRaisesRegex(ValueError, "readings of 1 robots; there are 2"):
            StepReadings(data, StepDecoder([1], [np.arange(2)]))
        with self.assertRaisesRegex(ValueError, "readings of 1 sensors for a robot that has 2"):
            StepReadings(data, StepDecoder([2], [np.arange(1)]))

    def test_refuse_every_truncated_message(self):
        step = random_step(np.random.default_rng(2), 2, is_regular=True)
        data = v1.DriveResponse(readings=step).SerializeToString()
        for size in range(len(data)):
            with self.subTest(size), self.assertRaises((ValueError, IndexError)):
                StepReadings(data[:size], StepDecoder([4], [np.arange(2)]))


class StepAnswerTest(unittest.TestCase):
    def test_equals_the_generated_classes(self):
        for robots in (1, 2, 127, 128, 129, 16400):
            answer = StepAnswer(robots)
            answer.commands[...] = np.arange(2 * robots).reshape(-1, 2) / 8
            others = v1.StepAnswer(win_checks=[0])
            others.messages.add(process_robot=0, to="R2", text=b"hello")
            for step in (0, 127, 128, 1 << 40):
                read = v1.DriveRequest.FromString(answer.message(step, others.SerializeToString())).answer
                self.assertEqual((read.step, list(read.win_checks), read.messages), (step, [0], others.messages))
            self.assertEqual([command.process_robot for command in read.commands], list(range(robots)))
            speeds = [[command.command.speed_mps, command.command.turn_radps] for command in read.commands]
            np.testing.assert_array_equal(speeds, answer.commands)


if __name__ == "__main__":
    unittest.main()
