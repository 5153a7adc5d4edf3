"""Checks the learning environments against the Gymnasium and PettingZoo that are installed.

    python -m robosim.check

Runs robosim.check_env(), which needs neither, then PettingZoo's own tests and Gymnasium's wrappers of vector environments.
Exit code: 0: all checks passed; 1: a check failed; 2: the others passed, but a package is not installed.
"""
import argparse
import sys
import traceback

from . import ParallelEnv, VectorEnv, WorldGenerator, _robosim, check_env, make


def _mazes(robots=1):
    return WorldGenerator("maze", columns=3, rows=3, robots=robots)


def _vector_env(**options):
    return VectorEnv(_mazes(2), 4, **{"robots": 1, "max_steps": 25, **options})


def _parallel_env():
    return ParallelEnv(_mazes(3), observations=("sonar", "odometry"), max_steps=40)


def _own_checks():
    yield "robosim.check_env(VectorEnv)", lambda: check_env(_vector_env())
    yield "robosim.check_env(VectorEnv) of a team", lambda: check_env(_vector_env(robots=2))
    yield "robosim.check_env(ParallelEnv)", lambda: check_env(_parallel_env())
    yield "robosim.check_env(robosim.make(…))", lambda: check_env(make("pursuit-v1", 2))


def _is_a_vector_env():
    import gymnasium
    env = _vector_env()
    assert isinstance(env, gymnasium.vector.VectorEnv), "VectorEnv is not derived from Gymnasium's"
    for space in (env.observation_space, env.single_observation_space, env.action_space, env.single_action_space):
        assert isinstance(space, gymnasium.spaces.Box), f"{space} is not a space of Gymnasium"
    assert env.observation_space == gymnasium.vector.utils.batch_space(env.single_observation_space, env.num_envs)
    assert env.metadata["autoreset_mode"] is gymnasium.vector.AutoresetMode.NEXT_STEP


def _closing(env, other):
    env.close()
    return other


def _wrapped(*wrappers, steps=60):
    """Steps a VectorEnv in wrappers of Gymnasium."""
    env = _vector_env()
    for wrapper in wrappers:
        env = wrapper(env)
    env.reset(seed=1)
    env.action_space.seed(1)
    ended = 0
    for _ in range(steps):
        observations, _, terminated, truncated, infos = env.step(env.action_space.sample())
        assert observations.shape == env.observation_space.shape
        ended += int((terminated | truncated).sum())
    assert ended > 0, "no episode has ended"
    env.close()
    return infos


def _gymnasium_checks():
    from gymnasium.wrappers import vector
    yield "gymnasium: base class, spaces, autoreset mode", _is_a_vector_env
    yield "gymnasium.wrappers.vector.RecordEpisodeStatistics", lambda: _wrapped(vector.RecordEpisodeStatistics)
    yield "gymnasium.wrappers.vector.NormalizeObservation, NormalizeReward", lambda: _wrapped(
        vector.NormalizeObservation, vector.NormalizeReward)
    yield "gymnasium.wrappers.vector.DictInfoToList", lambda: _wrapped(vector.DictInfoToList)
    yield "gymnasium.wrappers.vector.RecordEpisodeStatistics of a task", lambda: _wrapped(
        lambda env: vector.RecordEpisodeStatistics(_closing(env, make("gold-v1", 4))), steps=2001)


def _pettingzoo_checks():
    from pettingzoo.test import parallel_api_test, parallel_seed_test
    yield "pettingzoo.test.parallel_api_test", lambda: parallel_api_test(_parallel_env(), num_cycles=200)
    yield "pettingzoo.test.parallel_seed_test", lambda: parallel_seed_test(_parallel_env, num_cycles=50)

    def task():
        return make("pursuit-v1", interface="parallel")

    yield "pettingzoo.test.parallel_api_test of a task", lambda: parallel_api_test(task(), num_cycles=200)
    yield "pettingzoo.test.parallel_seed_test of a task", lambda: parallel_seed_test(task, num_cycles=50)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python -m robosim.check", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--verbose", action="store_true", help="print the traceback of each failure")
    options = parser.parse_args(arguments)
    print(f"robosim {_robosim.__version__}")
    failed, missing = 0, 0
    for package, checks in ((None, _own_checks), ("gymnasium", _gymnasium_checks), ("pettingzoo", _pettingzoo_checks)):
        try:
            if package:
                print(f"{package} {__import__(package).__version__}")
            checks = list(checks())
        except ImportError as error:
            print(f"missing: {package}: {error}; install it: pip install {package}")
            missing += 1
            continue
        for name, check in checks:
            try:
                check()
                print(f"passed: {name}")
            except Exception as error:  # of whatever kind: the next check is independent
                failed += 1
                print(f"FAILED: {name}: {type(error).__name__}: {error}")
                if options.verbose:
                    traceback.print_exc()
    return 1 if failed else 2 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
