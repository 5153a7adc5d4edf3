#!/usr/bin/env python3
"""Compares a run on ranks of MPI with one on as many threads, run alternately: `./dev bench ranks`."""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile


def parse_arguments():
    parser = argparse.ArgumentParser(prog='./dev bench ranks', description=__doc__)
    parser.add_argument('programs', help=argparse.SUPPRESS)
    parser.add_argument('--robots', action='append', type=int, help='repeatable; default: 10000 and 100000')
    parser.add_argument('--ranks', type=int, default=2, help='ranks, and threads to compare with (default: 2)')
    parser.add_argument('--rounds', type=int, default=5, help='measurements of each (default: 5)')
    parser.add_argument('--steps', type=int, help='steps of 0.1 s (default: 2,000,000 robot-steps, at least 10 steps)')
    parser.add_argument('--workload', default='sonar', help='workload of robosim_bench speed (default: sonar)')
    parser.add_argument('--exchange', default='auto', help='robosim run --exchange: auto, near or all (default: auto)')
    return parser.parse_args()


def run(command):
    environment = dict(os.environ, ROBOSIM_LOG_LEVEL='debug', OMPI_ALLOW_RUN_AS_ROOT='1',
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1', OMPI_MCA_rmaps_base_oversubscribe='1')
    ended = subprocess.run(command, capture_output=True, text=True, env=environment)
    if ended.returncode != 0:
        sys.exit(f'{" ".join(command)}\n{ended.stderr}')
    figures = json.loads(ended.stdout)
    return figures['wall_s'] / figures['steps'], figures['digest'], ended.stderr


def main():
    arguments = parse_arguments()
    for robots in arguments.robots or [10000, 100000]:
        steps = arguments.steps or max(10, 2000000 // robots)
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([f'{arguments.programs}/robosim_bench', 'speed', '--write-world', folder, '--workload',
                            arguments.workload, '--robots', str(robots)], check=True, stdout=subprocess.DEVNULL)
            alone = [f'{arguments.programs}/robosim', 'run', f'{folder}/{arguments.workload}.xml', '--json', '--time',
                     str(steps / 10)]
            on_ranks = ['mpirun', '-n', str(arguments.ranks)] + alone + ['--exchange', arguments.exchange]
            threads, ranks, digests, text = [], [], set(), ''
            for i in range(arguments.rounds):
                # The order changes, so that a machine that becomes slower favours neither.
                pair = [(alone + ['--threads', str(arguments.ranks)], threads), (on_ranks, ranks)]
                for command, times in pair[::1 if i % 2 == 0 else -1]:
                    step_s, digest, log = run(command)
                    times.append(step_s)
                    digests.add(digest)
                    text = log or text
            ratios = [a / b for a, b in zip(threads, ranks)]
            print(f'{robots:,} robots, {arguments.ranks} threads {statistics.median(threads) * 1e3:.2f} ms per step, '
                  f'{arguments.ranks} ranks {statistics.median(ranks) * 1e3:.2f} ms; efficiency '
                  f'{statistics.median(ratios):.3f} ({min(ratios):.3f} to {max(ratios):.3f}); '
                  f'{"same digest" if len(digests) == 1 else "DIGESTS DIFFER"}', flush=True)
            print(re.sub('^robosim run: ', '  ', text, flags=re.MULTILINE), flush=True)


if __name__ == '__main__':
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
