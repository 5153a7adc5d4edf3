"""Pickles, deep copies and spawned processes."""
import copy
import multiprocessing
import pickle
import unittest

import numpy as np

import robosim
import scene


def pickled(value):
    return pickle.loads(pickle.dumps(value))


def started(env, steps=13):
    """After some random steps, in the middle of an episode of some environments and at the end of one of others."""
    env.reset(seed=3)
    env.action_space.seed(1)
    for _ in range(steps):
        env.step(env.action_space.sample())
    return env


def next_steps(env, steps=25):
    """Results of steps whose actions the copied space of actions draws."""
    return [tuple(result.copy() for result in env.step(env.action_space.sample())[:4]) for _ in range(steps)]


def digest_of(world):
    """In a spawned process, too."""
    with robosim.Simulation(world, controller="wander") as simulation:
        simulation.step(20)
        return simulation.digest


class WorldTest(unittest.TestCase):
    def test_pickles_contain_the_texts_of_all_files(self):
        for name in ("foraging", "opho2_1"):  # with scattered objects; a map
            with self.subTest(name):
                world = robosim.World.load(name, seed=3)
                again = pickled(world)
                self.assertEqual((again.name, again.file, again.seed), (world.name, world.file, 3))
                self.assertEqual(again.to_xml(), world.to_xml())
        world = scene.world(2)
        self.assertEqual(digest_of(pickled(world)), digest_of(world))

    def test_copies_are_the_same_object_because_worlds_do_not_change(self):
        for constant in (scene.world(1), robosim.WorldGenerator("maze")):
            self.assertIs(copy.copy(constant), constant)
            self.assertIs(copy.deepcopy([constant])[0], constant)

    def test_pickled_generators_make_the_same_worlds(self):
        mazes = robosim.WorldGenerator("maze", columns=3, rows=4, robots=2, types=["scout"], controller="wander", gold=False)
        again = pickled(mazes)
        self.assertEqual(again.kind, "maze")
        self.assertEqual(again.generate(7).to_xml(), mazes.generate(7).to_xml())

    def test_worlds_and_environments_can_be_sent_to_spawned_processes(self):
        env = started(robosim.VectorEnv(robosim.WorldGenerator("maze", columns=3, rows=3), 3, max_steps=9))
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            self.assertEqual(pool.apply(digest_of, (scene.world(2),)), digest_of(scene.world(2)))
            theirs = pool.apply(next_steps, (env,))
        for own, other in zip(next_steps(env), theirs):
            for a, b in zip(own, other):
                np.testing.assert_array_equal(a, b)


class EnvironmentTest(unittest.TestCase):
    def assert_continues(self, env, other):
        for own, theirs in zip(next_steps(env), next_steps(other)):
            for a, b in zip(own, theirs):
                np.testing.assert_array_equal(a, b)
        np.testing.assert_array_equal(env._batch.all_poses, other._batch.all_poses)

    def test_copies_continue_bit_for_bit(self):
        made = {
            "generated worlds": lambda: robosim.VectorEnv(
                robosim.WorldGenerator("maze", columns=3, rows=3, robots=2), 5, robots=2, max_steps=9),
            "given worlds": lambda: robosim.VectorEnv(scene.world(2), 4, observations=("sonar", "odometry"), max_steps=9),
            "movable objects": lambda: robosim.VectorEnv("pucks", 3, observations=("pose",), random_starts=False,
                                                         max_steps=20, others="still"),
        }
        for name, make in made.items():
            for of in (pickled, copy.deepcopy):
                with self.subTest(name, copy=of.__name__):
                    env = started(make())
                    self.assert_continues(env, of(env))

    def test_keeps_interventions_and_the_number_of_the_episode(self):
        env = robosim.VectorEnv(scene.world(1), 2, observations=("pose",), max_steps=5)
        env.reset(seed=1, options={"interventions": {1: ['<place name="R1" x="0" y="1" direction="0.5"/>']}})
        other = pickled(env)
        np.testing.assert_array_equal(other.reset()[0], env.reset()[0])
        np.testing.assert_allclose(other.reset()[0][1], [0, 1, 0.5])

    def test_copies_are_independent(self):
        env = started(robosim.VectorEnv(scene.world(1), 2, observations=("pose",)))
        other = copy.deepcopy(env)
        before = env._batch.all_poses
        other.step(np.ones((2, 2)))
        np.testing.assert_array_equal(env._batch.all_poses, before)

    def test_environments_before_their_first_reset_and_closed_ones_can_be_pickled(self):
        env = robosim.VectorEnv(scene.world(1), 2)
        with self.assertRaisesRegex(RuntimeError, "call reset"):
            pickled(env).step(np.zeros((2, 2)))
        env.close()
        self.assertTrue(pickled(env).closed)

    def test_controllers_of_other_robots_are_copied_by_deepcopy_only(self):
        def make():
            return robosim.VectorEnv("soccer", 2, robots=3, observations=("beacons", "bumper"), random_starts=False,
                                     max_steps=40)
        env = started(make())
        self.assert_continues(env, copy.deepcopy(env))
        with self.assertRaisesRegex(ValueError, 'environment 0 cannot be pickled within an episode: .*others="still"'):
            pickle.dumps(env)
        pickled(make()).reset()

    def test_teams_of_a_parallel_env_continue(self):
        env = robosim.ParallelEnv(scene.world(2), max_steps=30)
        env.reset(seed=1)
        actions = {"R1": [1, 0.2], "R2": [0.5, -0.4]}
        env.step(actions)
        for other in (pickled(env), copy.deepcopy(env)):
            np.testing.assert_array_equal(other.step(actions)[0]["R2"], copy.deepcopy(env).step(actions)[0]["R2"])

    def test_simulations_are_deep_copied_by_fork_and_not_pickled(self):
        with robosim.Simulation(scene.world(2), controller="wander") as simulation:
            simulation.step(5)
            other = copy.deepcopy(simulation)
            simulation.step(5)
            other.step(5)
            self.assertEqual(other.digest, simulation.digest)
            with self.assertRaisesRegex(TypeError, r"pickle its World and the bytes of save\(\)"):
                pickle.dumps(simulation)


if __name__ == "__main__":
    unittest.main()
