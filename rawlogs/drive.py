"""Drives one robot of a RoboSim environment by a fixed list of commands, one per time step.

    /usr/bin/python3 drive.py HOST:PORT NAME

It requires the modules in `robosim` described in doc/examples/python_robot/README.md; make.sh generates them.
"""
import queue
import sys

import grpc
from robosim.v1 import robots_pb2 as v1
from robosim.v1 import robots_pb2_grpc

# Steps of 0.1 s, speed [m/s], turn [rad/s]: past the red crate, north along the east wall, to the gold.
PLAN = [(10, 0, 0), (75, 0.5, 0), (20, 0, 0.8), (25, 0.4, 0), (15, 0, 0.5), (28, 0.2, 0), (15, 0, 0)]


def commands():
    for steps, speed_mps, turn_radps in PLAN:
        for _ in range(steps):
            yield v1.Command(speed_mps=speed_mps, turn_radps=turn_radps, by_driver=True)


def drive(address, name):
    requests = queue.SimpleQueue()
    requests.put(v1.DriveRequest(hello=v1.RobotsHello(protocol=1, names=[name])))
    plan = commands()
    with grpc.insecure_channel(address) as channel:
        stream = robots_pb2_grpc.RobotsStub(channel).Drive(iter(requests.get, None))
        next(stream)  # the welcome
        for response in stream:
            command = v1.RobotCommand(process_robot=0, command=next(plan, v1.Command(by_driver=True)))
            requests.put(v1.DriveRequest(answer=v1.StepAnswer(step=response.readings.step, commands=[command])))


if __name__ == "__main__":
    try:
        drive(sys.argv[1], sys.argv[2])
    except grpc.RpcError as error:
        sys.exit("the environment ended the connection: " + error.details())
