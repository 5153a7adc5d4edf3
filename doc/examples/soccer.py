#!/usr/bin/python3
"""A referee for the world soccer: counts goals, and makes the kick-offs by interventions.

soccer.py [SECONDS] [RECORDING.rawlog]
"""
import sys

import robosim

GOAL_LINE_M = 4.5
BALL_RADIUS_M = 0.11


def ball_x(simulation):
    return next(thing.pose[0] for thing in simulation.objects if thing.name == "Ball")


def kick_off(simulation, starts):
    """The ball at the centre, and all robots at their starts."""
    for name in starts:
        simulation.remove(name)  # so that no start is occupied
    simulation.place("Ball", 0, 0)
    for name, (x, y, heading) in starts.items():
        simulation.place(name, x, y, heading)


def main():
    time_s = float(sys.argv[1]) if len(sys.argv) > 1 else 300
    goals = {"east": 0, "west": 0}
    with robosim.Simulation(robosim.World.load("soccer"), seed=3) as simulation:
        starts = {robot.name: tuple(pose) for robot, pose in zip(simulation.robots, simulation.poses.copy())}
        if len(sys.argv) > 2:
            simulation.record(sys.argv[2])
        while simulation.time_s < time_s:
            simulation.step()
            x = ball_x(simulation)
            if abs(x) > GOAL_LINE_M + BALL_RADIUS_M:
                goals["east" if x > 0 else "west"] += 1
                print(f"at {simulation.time_s:.1f} s: {goals['east']} : {goals['west']}")
                kick_off(simulation, starts)
    print(f"blue {goals['east']}, yellow {goals['west']}")


if __name__ == "__main__":
    main()
