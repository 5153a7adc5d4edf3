"""Ready tasks: their first episodes never change, and they follow the interfaces of Gymnasium and PettingZoo."""
import copy
import hashlib
import os
import pickle
import re
import subprocess
import sys
import unittest

import numpy as np

import robosim
from robosim import tasks
from robosim.tasks import train

# Of the first episode in the first held-out world with fixed actions: a version never changes. What changes one of these
# digests needs a task of another version.
FIRST_EPISODES = {
    "gold-v1": "a9a76fcf6f46b68c",
    "coverage-v1": "d4a122c43893a482",
    "foraging-v1": "64cf04e7068a1d93",
    "pursuit-v1": "8abecb94277287ea",
    "formation-v1": "4a8e462cc44d553b",
    "soccer-v1": "9f8b94f2091a92fe",
}


def scripted(step, env):
    """Actions that every processor computes alike."""
    agents = np.arange(env.task.agents)
    actions = np.stack([(7 * step + 3 * agents) % 11 / 10 - 0.2, ((5 * (step // 8) + 4 * agents) % 9 - 4) / 8], -1)
    return np.broadcast_to(actions.astype(np.float32).reshape(env.action_space.shape[1:]), env.action_space.shape)


def first_episode(name):
    """Digest, and the number of steps, of observations, rewards and metrics."""
    digest = hashlib.sha256()
    with robosim.make(name, split="test") as env:
        observations, _ = env.reset(seed=tasks.evaluation.EVALUATION_SEED)
        step, is_over = 0, False
        while not is_over:
            digest.update(np.ascontiguousarray(observations))
            observations, rewards, terminated, truncated, infos = env.step(scripted(step, env))
            digest.update(np.round(rewards * 1e6).astype(np.int64))
            is_over, step = bool(terminated[0] | truncated[0]), step + 1
        for metric in env.task.metrics:
            digest.update(np.round(infos[metric] * 1e6).astype(np.int64))
    return digest.hexdigest()[:16]


class TasksTest(unittest.TestCase):
    def test_first_episodes_never_change(self):
        self.assertEqual({name: first_episode(name) for name in tasks.names()}, FIRST_EPISODES)

    def test_all_tasks_conform_to_the_interfaces(self):
        for name in tasks.names():
            with self.subTest(name):
                robosim.check_env(robosim.make(name, 2), steps=12)
                robosim.check_env(robosim.make(name, interface="parallel"), steps=6)

    def test_training_and_held_out_worlds_differ(self):
        training, held_out = tasks.task.TRAINING_WORLDS, tasks.task.HELD_OUT_WORLDS
        self.assertTrue(set(training).isdisjoint(held_out))
        for name in tasks.names():
            task = tasks.task_class(name)
            with self.subTest(name):
                worlds = [(task.world(seed).to_xml(), task.changes(seed)) for seed in (*training[:2], *held_out[:2])]
                self.assertEqual(len({str(world) for world in worlds}), 4)

    def test_copies_continue_bit_for_bit(self):
        for name in ("gold-v1", "pursuit-v1"):
            env = robosim.make(name, 3)
            env.reset(seed=1)
            for step in range(5):
                env.step(scripted(step, env))
            for other in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
                with self.subTest(name):
                    own = copy.deepcopy(env)
                    for step in range(5, 10):
                        for a, b in zip(own.step(scripted(step, env))[:4], other.step(scripted(step, env))[:4]):
                            np.testing.assert_array_equal(a, b)

    def test_evaluations_repeat_and_have_confidence_intervals(self):
        first, again = (robosim.evaluate("pursuit-v1", "handwritten", worlds=4) for _ in range(2))
        for metric, values in first.episodes.items():
            np.testing.assert_array_equal(again.episodes[metric], values)
        for mean, low, high in first.metrics.values():
            self.assertTrue(low <= mean <= high)
        self.assertIn("| caught | ", first.table())
        still = robosim.evaluate("formation-v1", lambda observations: np.zeros((len(observations), 4, 2)), worlds=3)
        self.assertEqual(still.metrics["formed"][0], 0)

    def test_wilson_intervals_of_shares(self):
        # Of 50 of 100: 0.5 ± 1.96 / 1.0384 · √(0.0025 + 1.96² / 40000).
        np.testing.assert_allclose(tasks.evaluation._share(np.repeat([0.0, 1.0], 50)), (0.5, 0.4038, 0.5962), atol=1e-4)
        np.testing.assert_allclose(tasks.evaluation._mean(np.array([1.0, 3.0])), (2, 2 - 1.96, 2 + 1.96))

    def test_trained_baselines_act(self):
        for name in tasks.names():
            with self.subTest(name):
                policy = tasks.baseline(name, "trained")
                env = robosim.make(name, 2)
                policy.reset(2)
                actions = policy(env.reset()[0])
                self.assertTrue(env.action_space.contains(actions.astype(np.float32)))

    def test_the_program_of_the_page_runs(self):
        with open(os.path.join(os.path.dirname(__file__), "../../doc/tasks.md"), encoding="utf-8") as page:
            program = re.search(r"```python\n(.*?)```", page.read(), re.DOTALL).group(1)
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("| caught | ", ended.stdout)

    def test_trains(self):
        weights, taken = train.train("formation-v1", 0)
        self.assertEqual(taken["generations"], 0)
        self.assertEqual(robosim.evaluate("formation-v1", tasks.NetworkPolicy(tasks.Formation, weights), worlds=2).policy,
                         "trained")

    def test_wrong_names_and_arguments_are_explained(self):
        for error, text, call in (
                (ValueError, "there is no task 'gold'; the tasks are gold-v1, ", lambda: robosim.make("gold")),
                (TypeError, "the name of a task must be one of .*, not int; for example \"gold-v1\"", lambda: robosim.make(1)),
                (ValueError, "split is 'all'; it must be 'train' or 'test'", lambda: robosim.make("gold-v1", split="all")),
                (ValueError, "num_envs is 2; a parallel environment has 1",
                 lambda: robosim.make("gold-v1", 2, interface="parallel")),
                (TypeError, "policy must be a function from observations to actions, not int",
                 lambda: robosim.evaluate("gold-v1", 5)),
                (ValueError, "kind is 'best'; it must be 'handwritten' or 'trained'", lambda: robosim.evaluate("gold-v1", "best")),
                (ValueError, "worlds is 101; it must be 1 to 100", lambda: robosim.evaluate("gold-v1", "trained", worlds=101))):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                call()


class RewardsTest(unittest.TestCase):
    def test_coverage_rewards_each_cell_once(self):
        with robosim.make("coverage-v1") as env:
            env.reset(seed=1)
            total = sum(env.step(np.ones((1, 4, 2)) * [1, 0])[1].sum() for _ in range(20))
            # Four robots drive 1 m/s at most for 2 s: the sum is that of the cells of 0.25 m² beyond their first ones.
            self.assertAlmostEqual(total, env.task.results(env._env)["covered_m2"][0] - 4 * 0.25)

    def test_coverage_does_not_depend_on_other_environments(self):
        actions = np.ones((1, 4, 2)) * [1, 0.1]
        with robosim.make("coverage-v1") as alone:
            alone.reset(seed=1)
            expected = [alone.step(actions)[1][0].sum() for _ in range(1200)]
        with robosim.make("coverage-v1", 2) as env:
            both = np.repeat(actions, 2, axis=0)
            env.reset(seed=1)
            for _ in range(100):
                env.step(both)
            env.reset(options={"reset_mask": np.array([True, False])})
            # The other one ends its episode, and begins another, in the middle of this one.
            rewards = [env.step(both)[1][0].sum() for _ in range(1200)]
        self.assertEqual(rewards, expected)

    def test_pursuit_ends_when_the_evader_is_reached(self):
        with robosim.make("pursuit-v1", 8, split="test") as env:
            observations, _ = env.reset(seed=1)
            policy = tasks.baseline("pursuit-v1")
            policy.reset(8)
            ended = np.zeros(8, bool)
            while not ended.any():
                observations, rewards, terminated, truncated, infos = env.step(policy(observations))
                ended = terminated | truncated
            first = int(ended.argmax())
            self.assertEqual((infos["ended_by"][first], infos["caught"][first]), ("task", 1))
            self.assertGreater(rewards[first].min(), 0.9)
            env.step(policy(observations))  # begins the next episode
            self.assertEqual(env.step(policy(observations))[4]["step"][first], 1)

    def test_foraging_counts_pucks_in_the_nest(self):
        with robosim.make("foraging-v1") as env:
            env.reset(seed=1)
            self.assertEqual(env.task.results(env._env)["collected"][0], 0)
            env._env.set_interventions(0, ['<place name="West1" x="0.5" y="0.75"/>', '<place name="East1" x="0" y="1.1"/>'])
            env.reset(seed=1)
            self.assertEqual(env.task.results(env._env)["collected"][0], 1)  # the nest's radius is 1 m


if __name__ == "__main__":
    unittest.main()
