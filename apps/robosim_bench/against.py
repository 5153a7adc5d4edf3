#!/usr/bin/env python3
"""Compares the speed of two builds of robosim_bench, run alternately: `./dev bench --against REVISION`."""
import argparse
import json
import statistics
import subprocess
import sys


def parse_arguments():
    parser = argparse.ArgumentParser(prog='./dev bench --against REVISION', description=__doc__)
    parser.add_argument('old', help=argparse.SUPPRESS)
    parser.add_argument('new', help=argparse.SUPPRESS)
    parser.add_argument('--workload', action='append', choices=['sonar', 'sector', 'laser', 'infrared'],
                        help='repeatable; default: all')
    parser.add_argument('--robots', action='append', type=int, help='repeatable; default: 100, 1000 and 10000')
    parser.add_argument('--rounds', type=int, default=5, help='measurements of each build (default: 5)')
    parser.add_argument('--at-least', type=float, default=1, metavar='SECONDS',
                        help='minimum duration of a measurement (default: 1 s)')
    parser.add_argument('--vectors', choices=['sse2', 'avx2', 'avx512'], help='width of vectors; default: the widest')
    arguments = parser.parse_args()
    if arguments.rounds < 1 or any(number < 1 for number in arguments.robots or []):
        parser.error('--rounds and --robots must be positive')
    return arguments


def robot_steps_per_s(program, workload, robots, arguments):
    command = [program, 'speed', '--json', '--workload', workload, '--robots', str(robots), '--at-least',
               str(arguments.at_least)]
    if arguments.vectors:
        command += ['--vectors', arguments.vectors]
    ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode != 0:
        sys.exit(f'{" ".join(command)}\n{ended.stderr}')
    figures = json.loads(ended.stdout.splitlines()[0])
    return figures['robot_steps_per_s'], figures['digest']


def main():
    arguments = parse_arguments()
    print(f'{"workload":9} {"robots":>7} {"old [robot-steps/s]":>20} {"new [robot-steps/s]":>20} {"new/old":>8}'
          f' {"least":>6} {"most":>6}  same digest', flush=True)
    for workload in arguments.workload or ['sonar', 'sector', 'laser', 'infrared']:
        for robots in arguments.robots or [100, 1000, 10000]:
            old, new, digests = [], [], set()
            for i in range(arguments.rounds):
                # The order changes, so that a machine that becomes slower favours neither.
                for program, speeds in [(arguments.old, old), (arguments.new, new)][::1 if i % 2 == 0 else -1]:
                    speed, digest = robot_steps_per_s(program, workload, robots, arguments)
                    speeds.append(speed)
                    digests.add(digest)
            ratios = [b / a for a, b in zip(old, new)]
            print(f'{workload:9} {robots:7,} {statistics.median(old):20,.0f} {statistics.median(new):20,.0f}'
                  f' {statistics.median(ratios):8.3f} {min(ratios):6.3f} {max(ratios):6.3f}'
                  f'  {"yes" if len(digests) == 1 else "no"}', flush=True)


if __name__ == '__main__':
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
