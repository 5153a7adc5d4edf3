#!/usr/bin/python3
"""Measures robosim.RemoteRobots beside a client with the generated classes, alternating, each with a server of its own.

remote.py ROBOSIM [SECONDS]; the package robosim must be on Python's path. Pioneers (sonars, laser, odometry, …) in an open
area; each step reads the sonars' ranges and commands all robots. Prints steps per second and the client's processor time.
"""
import os
import queue
import statistics
import subprocess
import sys
import tempfile
import time

import grpc

import robosim
from robosim.v1 import robots_pb2 as v1
from robosim.v1 import robots_pb2_grpc

ROUNDS = 7


def serve(program, world):
    server = subprocess.Popen([program, "serve", world, "--listen", ":0", "--wait-for-robots", "--time", "1e8"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    for line in server.stderr:
        if "listening on " in line:
            return server, line.split("listening on ")[1].strip()
    raise RuntimeError("robosim serve has ended")


def steps_of_classes(address, names):
    """Takes a step at each next()."""
    requests = queue.SimpleQueue()
    requests.put(v1.DriveRequest(hello=v1.RobotsHello(protocol=1, names=names)))
    with grpc.insecure_channel(address, [("grpc.max_receive_message_length", -1)]) as channel:
        stream = robots_pb2_grpc.RobotsStub(channel).Drive(iter(requests.get, None))
        next(stream)
        for response in stream:
            step = response.readings
            for robot in step.robots:
                robot.measurements[0].floats[::4]
            commands = [v1.RobotCommand(process_robot=i, command=v1.Command(speed_mps=0.3, turn_radps=0.1))
                        for i in range(len(names))]
            requests.put(v1.DriveRequest(answer=v1.StepAnswer(step=step.step, commands=commands)))
            yield


def steps_of_arrays(address, names):
    with robosim.RemoteRobots(address, names) as robots:
        while True:
            robots.readings("sonar")
            robots.commands = (0.3, 0.1)
            robots.step()
            yield


def measure(program, robots, min_s):
    """Steps per second and processor time of a step [µs] of each client: medians of the rounds."""
    world = robosim.World.generate("open", robots=robots, width_m=50, length_m=50)
    figures = {steps_of_classes: [], steps_of_arrays: []}
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "open.xml")
        world.write(file)
        servers = {client: serve(program, file) for client in figures}
        clients = {client: client(servers[client][1], [robot.name for robot in world.robots]) for client in figures}
        for _ in range(ROUNDS):
            for client, steps in clients.items():
                begin, used, count = time.perf_counter(), time.process_time(), 0
                while time.perf_counter() - begin < min_s / ROUNDS:
                    next(steps)
                    count += 1
                figures[client].append((count / (time.perf_counter() - begin), (time.process_time() - used) / count * 1e6))
        for client in figures:
            servers[client][0].kill()
            servers[client][0].wait()
    return [[statistics.median(column) for column in zip(*rounds)] for rounds in figures.values()]


def main():
    program, min_s = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 5.0
    print("robots   generated classes      RemoteRobots")
    for robots in (1, 100):
        (classes, of_classes), (arrays, of_arrays) = measure(program, robots, min_s)
        print(f"{robots:>6} {classes:>7,.0f}/s {of_classes:>6,.0f} µs {arrays:>7,.0f}/s {of_arrays:>6,.0f} µs", flush=True)
    os._exit(0)  # without waiting for gRPC's threads


if __name__ == "__main__":
    main()
