"""Drives robots of a RoboSim environment in another process with NumPy arrays: ahead, and turning at obstacles.

    robosim serve worlds/small_maze.xml --wait-for-robots --time 60
    /usr/bin/python3 remote_robots.py 127.0.0.1:3000 Pioneer1 Scout1

It requires the Python package robosim, python3-grpcio and python3-protobuf. A token is read from ROBOSIM_TOKEN.
"""
import os
import sys

import numpy as np

import robosim


def drive(address, names):
    with robosim.RemoteRobots(address, names, token=os.environ.get("ROBOSIM_TOKEN")) as robots:
        is_running = True
        while is_running:
            x_m, y_m = robots.points("sonar")[..., 0], robots.points("sonar")[..., 1]
            ahead_m = np.where((x_m > 0) & (np.abs(y_m) < 0.3), x_m, np.inf).min(axis=1)
            is_free = (ahead_m > 0.6) & ~robots.stalled
            robots.commands[:, 0] = np.where(is_free, 0.3, 0)
            robots.commands[:, 1] = np.where(is_free, 0, 0.8)
            is_running = robots.step()
        print("the run is over after step", robots.step_count)


if __name__ == "__main__":
    try:
        drive(sys.argv[1], sys.argv[2:])
    except robosim.RemoteError as error:
        sys.exit(f"error from the environment: {error}")
