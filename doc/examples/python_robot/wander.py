"""Drives robots of a RoboSim environment from Python: each drives ahead, and turns at obstacles measured by its sonars.

    /usr/bin/python3 wander.py HOST:PORT NAME...

A token, if required, is read from ROBOSIM_TOKEN. README.md describes how to generate the modules in `robosim`.
"""
import os
import queue
import sys

import grpc
from robosim.v1 import robots_pb2 as v1
from robosim.v1 import robots_pb2_grpc


def free_m(readings, sensors):
    """Free distance ahead of the robot's centre within its width, measured by the sonars."""
    distance = float("inf")
    for reading, sensor in zip(readings.measurements, sensors):
        if sensor.kind == "sonar":
            names = [field.name for field in sensor.fields]
            xs_m, ys_m = (reading.floats[names.index(name) :: len(names)] for name in ("x", "y"))
            for x_m, y_m in zip(xs_m, ys_m):
                if x_m > 0 and abs(y_m) < 0.3:
                    distance = min(distance, x_m)
    return distance


def decide(i, readings, sensors):
    if readings.stalled or free_m(readings, sensors) < 0.6:
        return v1.RobotCommand(process_robot=i, command=v1.Command(speed_mps=0, turn_radps=0.8))
    return v1.RobotCommand(process_robot=i, command=v1.Command(speed_mps=0.3))


def drive(address, names):
    requests = queue.SimpleQueue()
    requests.put(v1.DriveRequest(hello=v1.RobotsHello(protocol=1, names=names)))
    token = os.environ.get("ROBOSIM_TOKEN")
    metadata = [("authorization", "Bearer " + token)] if token else []
    with grpc.insecure_channel(address) as channel:
        stream = robots_pb2_grpc.RobotsStub(channel).Drive(iter(requests.get, None), metadata=metadata)
        welcome = next(stream).welcome
        sensors = [welcome.sensor_sets[robot.sensor_set].sensors for robot in welcome.robots]
        steps = 0
        for response in stream:
            step = response.readings
            commands = [decide(i, readings, sensors[i]) for i, readings in enumerate(step.robots)]
            requests.put(v1.DriveRequest(answer=v1.StepAnswer(step=step.step, commands=commands)))
            steps = step.step
        print("the run is over after step", steps)


if __name__ == "__main__":
    try:
        drive(sys.argv[1], sys.argv[2:])
    except grpc.RpcError as error:
        sys.exit("error from the environment: " + error.details())
