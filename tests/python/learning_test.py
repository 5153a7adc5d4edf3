"""Learning environments: semantics of Gymnasium's VectorEnv and PettingZoo's ParallelEnv, and misuse."""
import unittest

import numpy as np

import robosim
import scene


def at_the_start(num_envs=2, **options):
    """Environments whose robot heads towards the gold at (4, 0) from (0, 0)."""
    return robosim.VectorEnv(scene.world(1), num_envs, observations=("pose",), random_starts=False, **options)


class VectorEnvTest(unittest.TestCase):
    def test_infos_have_steps_and_winners(self):
        env = at_the_start(max_steps=1000)
        self.assertEqual(env.reset()[1]["step"].tolist(), [0, 0])
        terminated, count = [False], 0
        while not terminated[0]:
            _, _, terminated, _, infos = env.step(np.array([[1, 0], [0, 0]]))
            count += 1
            self.assertEqual(infos["step"].tolist(), [count, count])
            self.assertEqual(infos["_step"].tolist(), [True, True])
            np.testing.assert_allclose(infos["time_s"], [count / 10, count / 10])
            self.assertEqual(infos["gold_found"].tolist(), [terminated[0], False])
            self.assertEqual("winner" in infos, terminated[0])
        self.assertEqual((infos["winner"].tolist(), infos["_winner"].tolist()), (["R1", None], [True, False]))
        self.assertEqual((infos["ended_by"].tolist(), infos["_ended_by"].tolist()), (["win", None], [True, False]))
        infos = env.step(np.zeros((2, 2)))[4]
        self.assertEqual(infos["step"].tolist(), [0, count + 1])
        self.assertEqual(infos["gold_found"].tolist(), [False, False])

    def test_episodes_begin_with_the_interventions_of_their_environment(self):
        wall = ('<add><cube><name>wall</name><x>1</x><y>0</y><z>0.5</z><length>0.2</length><width>2</width>'
                '<height>1</height></cube></add>')

        def run(threads):
            env = robosim.VectorEnv(scene.world(1), 3, observations=("sonar", "pose"), random_starts=False, max_steps=2,
                                    threads=threads)
            seen = [env.reset(seed=1, options={"interventions": {
                1: [wall], 2: ['<place name="R1" x="0" y="1" direction="0.5"/>']}})[0].copy()]
            seen += [env.step(np.ones((3, 2)))[0].copy() for _ in range(4)]
            env.set_interventions(1, [])
            seen.append(env.reset(seed=1)[0].copy())
            return env.observation_parts, np.array(seen)

        parts, seen = run(1)
        sonar, pose = parts["sonar"], parts["pose"]
        # The front face of the wall is 0.9 m from the robot's centre.
        self.assertLess(seen[0, 1, sonar].min(), 0.9)
        self.assertGreater(seen[0, 0, sonar].min(), seen[0, 1, sonar].min())
        np.testing.assert_allclose(seen[0, 2, pose], [0, 1, 0.5])
        np.testing.assert_array_equal(seen[3, 1:, pose], seen[0, 1:, pose], "the next episode begins alike")
        np.testing.assert_array_equal(seen[5, 1], seen[5, 0], "the wall has been left out again")
        np.testing.assert_array_equal(run(3)[1], seen, "for any number of threads")

    def test_refuses_interventions_that_are_impossible(self):
        env = at_the_start()
        with self.assertRaisesRegex(robosim.ConfigError, "environment 1: .* 'box' is not the name of a robot or an object"):
            env.reset(options={"interventions": {1: '<remove name="box"/>'}})
        with self.assertRaisesRegex(robosim.ConfigError, "cannot begin with its end"):
            env.set_interventions(0, ['<end outcome="over"/>'])
        with self.assertRaisesRegex(robosim.ConfigError, "is no change of a run"):
            env.set_interventions(0, ['<move/>'])
        with self.assertRaisesRegex(ValueError, "the environment is 2"):
            env.set_interventions(2, [])
        env.set_interventions(1, [])
        env.reset()

    def test_infos_name_the_limit_of_steps_as_the_end(self):
        env = at_the_start(max_steps=1)
        env.reset()
        infos = env.step(np.zeros((2, 2)))[4]
        self.assertEqual(infos["ended_by"].tolist(), ["max_steps", "max_steps"])
        self.assertNotIn("winner", infos)

    def test_other_robots_are_driven_by_the_controllers_that_the_world_names(self):
        world = robosim.World.parse(scene.text(3).replace(
            "<name>R2</name>", '<name>R2</name><controller name="wander"/>'))
        for others, moves in (("controllers", True), ("still", False)):
            with self.subTest(others=others):
                env = robosim.VectorEnv(world, 2, robots=1, observations="pose", random_starts=False, others=others)
                env.reset(seed=1)
                for _ in range(10):
                    env.step(np.zeros((2, 2)))
                # What a simulation with the world's controllers does; R1 and R3 have none here.
                poses = env._batch.poses(1)
                self.assertEqual(bool(np.any(poses[1] != [0, 1, 0])), moves)
                np.testing.assert_array_equal(poses[[0, 2]], [[0, 0, 0], [0, 2, 0]])
        with self.assertRaisesRegex(ValueError, "others is 'none'; it must be 'controllers' or 'still'"):
            robosim.VectorEnv(world, others="none")

    def test_refuses_controllers_that_cannot_drive_other_robots(self):
        world = robosim.World.parse(scene.text(2).replace(
            "<name>R2</name>", '<name>R2</name><controller>gold_finder</controller><sensors><laser/></sensors>'))
        with self.assertRaisesRegex(robosim.ConfigError, "robot 'R2': its controller gold_finder requires a sensor of "
                                    'kind heat; add one, make the robot an agent, or use others="still"'):
            robosim.VectorEnv(world)
        robosim.VectorEnv(world, robots=2, observations="pose")
        robosim.VectorEnv(world, others="still")

    def test_random_starts_keep_a_distance_from_the_gold(self):
        def nearest(**options):
            env = robosim.VectorEnv(scene.world(1), 200, observations=("pose",), **options)
            poses = env.reset()[0]
            return np.hypot(poses[:, 0] - 4, poses[:, 1]).min() - 0.2  # to the pillar's outline

        self.assertGreaterEqual(nearest(), 1.5 - 1e-6)  # the range of the heat sensor
        self.assertGreaterEqual(nearest(start_distance_m=6), 6 - 1e-6)
        self.assertLess(nearest(start_distance_m=0), 1.5)
        with self.assertRaisesRegex(robosim.ConfigError, "has no effect without random starts"):
            nearest(start_distance_m=1, random_starts=False)
        with self.assertRaisesRegex(robosim.ConfigError, "must be at least 0"):
            nearest(start_distance_m=-1)

    def test_observes_sensors_by_label(self):
        world = robosim.World.parse(scene.text(1).replace(
            "</robot>", '<sensors><laser range_max_m="1"/><laser range_max_m="3"/></sensors></robot>', 1))
        labels = [sensor.label for sensor in world.robots[0].sensors if sensor.kind == "laser"]
        env = robosim.VectorEnv(world, observations=("laser", labels[1]))
        first, second = env.observation_parts.values()
        self.assertEqual(env.single_observation_space.high[first].max(), 1)
        self.assertEqual(env.single_observation_space.high[second].max(), 3)
        with robosim.Simulation(world, controller="none") as simulation:
            simulation.step()
            robot = simulation.robot("R1")
            np.testing.assert_array_equal(robot.readings(labels[1]), simulation.readings(labels[1])[0])
            self.assertEqual(robot.points(labels[1]).shape, (len(robot.readings(labels[1])), 3))
            self.assertEqual(robot.readings("laser").max(), 1)
            self.assertIsNone(robot.readings("infrared"))
            with self.assertRaisesRegex(ValueError, f"has no sensor with the label 'radar'.*{labels[1]}"):
                robot.readings("radar")

    def test_observes_every_sensor_with_numbers_but_those_of_pictures(self):
        sensors = ('<camera rate_hz="5"/><blob_finder><color name="gold" rgb="1 0.8 0.1"/></blob_finder>'
                   '<range_and_bearing count="1"/><gripper/>')
        world = robosim.World.parse(scene.text(2).replace("</robot>", f"<sensors>{sensors}</sensors></robot>"))
        env = robosim.VectorEnv(world, observations=("range_and_bearing", "odometry"), random_starts=False)
        robot, range_m, bearing_rad = env.reset()[0][0, :3]
        self.assertEqual((robot, range_m), (1, 1))  # R2 is 1 m to the left of R1
        self.assertAlmostEqual(bearing_rad, np.pi / 2, 6)
        with self.assertRaisesRegex(robosim.ConfigError, "cannot observe 'blob_finder' in a learning environment, which takes "
                                    r"no pictures of the model opengl; use <camera model=.raycast.>, or Simulation.readings"):
            robosim.VectorEnv(world, observations="blob_finder")
        with self.assertRaisesRegex(robosim.ConfigError, "robot 'R1' cannot observe 'camera'"):
            robosim.VectorEnv(world, observations="camera")

    def test_observes_the_pictures_of_raycast_cameras(self):
        camera = ('<camera model="raycast" layers="rgb depth identity" width_px="32" height_px="24" z_m="0.2" x_m="0.3" '
                  'range_max_m="6"/><blob_finder><color name="gold" rgb="1 0.8 0"/></blob_finder>')
        world = robosim.World.parse(scene.text(1).replace("</robot>", f"<sensors>{camera}</sensors></robot>"))
        env = robosim.VectorEnv(world, 2, observations=("camera", "odometry", "blob_finder"), random_starts=False, threads=2)
        self.assertEqual(env.single_observation_space["camera"].shape, (24, 32, 3))
        self.assertEqual(env.observation_space["camera_depth"].shape, (2, 24, 32))
        seen, _ = env.reset(seed=1)
        self.assertEqual({name: (array.dtype.name, array.shape) for name, array in seen.items()},
                         {"camera": ("uint8", (2, 24, 32, 3)), "camera_depth": ("float32", (2, 24, 32)),
                          "camera_identity": ("uint32", (2, 24, 32)), "numbers": ("float32", (2, 12))})
        self.assertIn({name: array[0] for name, array in seen.items()}, env.single_observation_space)
        # The gold of 0.2 m radius is 4 m from the robot, and 3.5 m before the camera. It glows.
        self.assertEqual(seen["camera"][0, 12, 16].tolist(), [255, 204, 0])
        self.assertEqual(seen["camera_identity"][0, 12, 16], 0)
        self.assertAlmostEqual(float(seen["camera_depth"][0, 12, 16]), 3.51, delta=0.005)
        self.assertEqual((seen["camera_identity"][0, 0, 0], seen["camera_depth"][0, 0, 0]), (2**32 - 1, 0))
        self.assertGreater(seen["numbers"][0, 5], 3, "pixels of the gold")
        near = env.step(np.array([[1, 0], [0, 0.5]]))[0]
        self.assertTrue((near["camera"][0] != near["camera"][1]).any())
        only = robosim.VectorEnv(world, 1, observations="camera", random_starts=False)
        np.testing.assert_array_equal(only.reset(seed=1)[0]["camera"][0], seen["camera"][0])
        self.assertNotIn("numbers", only.observation_space.keys())
        agents = robosim.ParallelEnv(world, observations=("camera", "odometry"), random_starts=False)
        observed = agents.reset(seed=1)[0]["R1"]
        self.assertIn(observed, agents.observation_space("R1"))
        np.testing.assert_array_equal(observed["camera"], seen["camera"][0])
        with robosim.Simulation(world, controller="none") as simulation:
            robot = simulation.robot("R1")
            np.testing.assert_array_equal(robot.image, seen["camera"][0])
            self.assertEqual(next(s for s in world.robots[0].sensors if s.kind == "camera").image_layers,
                             ("rgb", "depth", "identity"))
            np.testing.assert_array_equal(robot.depth_of(), seen["camera_depth"][0])
            np.testing.assert_array_equal(robot.identity_of("camera"), seen["camera_identity"][0])

    def test_agents_observe_pictures_of_their_own_cameras_only(self):
        camera = '<sensors><camera model="raycast" width_px="8" height_px="6" z_m="0.2"/></sensors></robot>'
        text = scene.text(2).replace("</robot>", camera, 1)
        world = robosim.World.parse(text)
        agents = robosim.ParallelEnv(world, observations=("camera", "odometry"), random_starts=False, max_steps=9)
        self.assertEqual(sorted(agents.observation_space("R1").keys()), ["camera", "numbers"])
        self.assertEqual(list(agents.observation_space("R2").keys()), ["numbers"])
        observed = agents.reset(seed=1)[0]
        self.assertIn(observed["R1"], agents.observation_space("R1"))
        self.assertIn(observed["R2"], agents.observation_space("R2"))
        robosim.check_env(agents, steps=20)
        robosim.check_env(robosim.VectorEnv(world, 2, robots=2, observations=("camera", "odometry"), max_steps=9), steps=20)
        robosim.check_env(robosim.VectorEnv(world, 2, observations="camera", max_steps=9), steps=20)

    def test_refuses_cameras_whose_pictures_have_one_name(self):
        def environment(*labels):
            cameras = "".join(f'<camera model="raycast" layers="rgb depth" width_px="8" height_px="6" label="{label}"/>'
                              for label in labels)
            world = robosim.World.parse(scene.text(1).replace("</robot>", f"<sensors>{cameras}</sensors></robot>"))
            return robosim.VectorEnv(world, observations=("odometry", *labels))

        self.assertEqual(len(environment("left", "right").single_observation_space), 5)
        with self.assertRaisesRegex(ValueError, "two parts of observations have the name 'eye_depth'; give the camera"):
            environment("eye", "eye_depth")
        with self.assertRaisesRegex(ValueError, "'numbers'"):
            environment("numbers")

    def test_seeds_are_0_to_the_largest_number_of_64_bits(self):
        env = at_the_start()
        env.reset(seed=2**64 - 1)  # the second environment has the seed 0
        for seed, error, text in ((-1, ValueError, "the seed is -1; it must be 0 to 2\\^64 - 1"),
                                  (2**64, ValueError, "it must be 0 to"),
                                  (1.5, TypeError, "the seed must be a whole number, not float"),
                                  ([1, "a"], TypeError, "the seed must be a whole number, not str")):
            with self.assertRaisesRegex(error, text):
                env.reset(seed=seed)

    def test_conforms(self):
        mazes = [robosim.World.generate("maze", columns=3, rows=3, robots=2, seed=seed) for seed in range(3)]
        for robots in (1, 2):
            with self.subTest(robots=robots):
                robosim.check_env(robosim.VectorEnv(mazes, 5, robots=robots, observations=("sonar", "heat", "odometry"),
                                                    max_steps=23))

    def test_the_checker_detects_violations(self):
        class WithoutReset(robosim.VectorEnv):
            def step(self, actions):
                observations, rewards, terminated, truncated, infos = super().step(actions)
                return observations, rewards + 1, terminated, truncated, infos

        with self.assertRaisesRegex(AssertionError, "reward 0"):
            robosim.check_env(WithoutReset(scene.world(1), 2, max_steps=5))

    def test_spaces_describe_observations_and_actions(self):
        env = robosim.VectorEnv(scene.world(3), 4, robots=2, observations=("sonar", "stalled"))
        self.assertEqual(env.single_observation_space.shape, (2, 17))
        self.assertEqual(env.observation_space.shape, (4, 2, 17))
        self.assertEqual(env.action_space, robosim.Box(-1, 1, (4, 2, 2)))
        self.assertEqual(env.observation_parts, {"sonar": slice(0, 16), "stalled": slice(16, 17)})
        self.assertEqual(env.agent_names, ("R1", "R2"))
        self.assertEqual(env.single_observation_space.low.min(), 0)

    def test_the_step_after_the_end_begins_the_next_episode(self):
        env = at_the_start(max_steps=1000, reward={"win": 10, "step": -1})
        env.reset(seed=1)
        ahead = np.array([[1, 0], [0, 0]], np.float32)
        terminated = [False, False]
        while not terminated[0]:
            observations, rewards, terminated, truncated, infos = env.step(ahead)
        self.assertGreater(observations[0, 0], 2)  # the final observation
        np.testing.assert_array_equal(rewards, [9, -1])
        np.testing.assert_array_equal(terminated, [True, False])
        observations, rewards, terminated, truncated, infos = env.step(ahead)
        np.testing.assert_array_equal(observations[0], [0, 0, 0])
        np.testing.assert_array_equal(rewards, [0, -1])
        self.assertFalse(terminated.any() or truncated.any())

    def test_truncates_after_max_steps(self):
        env = at_the_start(max_steps=3)
        env.reset()
        flags = [env.step(np.zeros((2, 2)))[3][0] for _ in range(8)]
        self.assertEqual(flags, [0, 0, 1, 0, 0, 0, 1, 0])

    def test_results_keep_their_values_for_one_more_step(self):
        env = at_the_start()
        before, _ = env.reset()
        after = env.step(np.ones((2, 2)))[0]
        np.testing.assert_array_equal(before, np.zeros((2, 3)))
        self.assertFalse(np.shares_memory(before, after))
        third = env.step(np.ones((2, 2)))[0]
        self.assertTrue(np.shares_memory(before, third))

    def test_resets_selected_environments(self):
        env = at_the_start()
        env.reset()
        for _ in range(5):
            moved = env.step(np.ones((2, 2), np.float32))[0].copy()
        observations, _ = env.reset(options={"reset_mask": np.array([True, False])})
        np.testing.assert_array_equal(observations[0], [0, 0, 0])
        np.testing.assert_array_equal(observations[1], moved[1])

    def test_seeds_determine_the_starts(self):
        env = robosim.VectorEnv(scene.world(1), 3, observations=("pose",))
        first = env.reset(seed=5)[0].copy()
        second = env.reset()[0].copy()
        self.assertFalse(np.array_equal(first, second))
        np.testing.assert_array_equal(env.reset(seed=[5, 6, 7])[0], first)
        self.assertEqual(env.reset(seed=5)[0].tolist(), first.tolist())
        self.assertEqual(env.np_random_seed, 5)

    def test_gives_the_same_batch_for_any_number_of_threads(self):
        world = robosim.World.generate("maze", columns=3, rows=3)
        of_one = None
        for threads in (1, 3):
            env = robosim.VectorEnv(world, 11, threads=threads, max_steps=20)
            env.reset(seed=1)
            env.action_space.seed(1)
            rewards = [env.step(env.action_space.sample())[0].copy() for _ in range(30)]
            of_one = rewards if of_one is None else of_one
            np.testing.assert_array_equal(rewards, of_one)

    def test_generates_a_world_for_each_episode(self):
        mazes = robosim.WorldGenerator("maze", columns=3, rows=3)
        env = robosim.VectorEnv(mazes, 3, observations=("sonar",), random_starts=False, max_steps=5)
        self.assertEqual(env.world_seeds.tolist(), [0, 0, 0])
        observations, _ = env.reset(seed=1)
        seeds = env.world_seeds
        self.assertEqual(len(set(seeds.tolist())), 3)
        for observed, seed in zip(observations, seeds):
            with robosim.Simulation(mazes.generate(int(seed)), controller="none") as simulation:
                np.testing.assert_array_equal(simulation.readings("sonar")[0], observed)
        for _ in range(6):
            env.step(np.zeros((3, 2)))
        self.assertTrue(set(seeds.tolist()).isdisjoint(env.world_seeds.tolist()))
        env.reset(seed=1)
        np.testing.assert_array_equal(env.world_seeds, seeds)

    def test_gives_the_same_generated_episodes_for_any_number_of_threads(self):
        of_one = None
        for threads in (1, 3):
            env = robosim.VectorEnv(robosim.WorldGenerator("maze", columns=3, rows=3), 7, threads=threads, max_steps=9)
            env.reset(seed=1)
            env.action_space.seed(1)
            observed = [env.step(env.action_space.sample())[0].copy() for _ in range(25)]
            of_one = observed if of_one is None else of_one
            np.testing.assert_array_equal(observed, of_one)

    def test_conforms_with_generated_worlds(self):
        robosim.check_env(robosim.VectorEnv(robosim.WorldGenerator("cave", width_m=8, length_m=8), 3, max_steps=7))

    def test_reports_misuse_and_stays_usable(self):
        env = at_the_start()
        with self.assertRaisesRegex(RuntimeError, r"call reset\(\) before the first step"):
            env.step(np.zeros((2, 2)))
        env.reset()
        with self.assertRaisesRegex(ValueError, r"actions have the shape \(2, 3\); it must be \(2, 2\)"):
            env.step(np.zeros((2, 3)))
        with self.assertRaisesRegex(ValueError, "the action of agent 0 in environment 1 is not finite"):
            env.step([[0, 0], [0, np.inf]])
        with self.assertRaisesRegex(TypeError, "actions must be an array of numbers"):
            env.step(np.array([["a", "b"], ["c", "d"]]))
        with self.assertRaisesRegex(TypeError, r"reset_mask must be a bool array of shape \(2,\)"):
            env.reset(options={"reset_mask": np.ones(3, bool)})
        with self.assertRaisesRegex(ValueError, "unknown options"):
            env.reset(options={"mask": None})
        with self.assertRaisesRegex(ValueError, "there are 3 seeds; 2 are required"):
            env.reset(seed=[1, 2, 3])
        self.assertEqual(env.step(np.zeros((2, 2)))[0].shape, (2, 3))
        env.close()
        with self.assertRaisesRegex(ValueError, "the environment is closed"):
            env.reset()

    def test_reports_invalid_options(self):
        world = scene.world(1)
        with self.assertRaisesRegex(robosim.ConfigError, "robot 'R1' cannot observe 'radar'"):
            robosim.VectorEnv(world, observations="radar")
        with self.assertRaisesRegex(TypeError, "no reward 'luck'; rewards are win, forward, heat, stall, step"):
            robosim.VectorEnv(world, reward={"luck": 1})
        with self.assertRaisesRegex(ValueError, "num_envs is 0; it must be 1 to 2147483647"):
            robosim.VectorEnv(world, 0)
        with self.assertRaisesRegex(robosim.ConfigError, "2 agents are required"):
            robosim.VectorEnv(world, robots=2)


def mixed_world():
    """A Pioneer, R1, which has a laser, and a Scout, R2, which has none."""
    before, after = scene.text(2).rsplit("<model>pioneer3dx</model>", 1)
    return robosim.World.parse(before + "<model>scout</model>" + after)


class MixedTeamTest(unittest.TestCase):
    parts = ("sonar", "laser", "heat")

    def test_each_agent_of_a_parallel_env_has_its_own_spaces(self):
        env = robosim.ParallelEnv(mixed_world(), observations=self.parts)
        self.assertEqual(list(env.observation_parts("R1")), list(self.parts))
        self.assertEqual(list(env.observation_parts("R2")), ["sonar", "heat"])
        self.assertGreater(env.observation_space("R1").shape, env.observation_space("R2").shape)
        observations, _ = env.reset(seed=1)
        for agent in env.agents:
            self.assertIn(observations[agent], env.observation_space(agent))
        robosim.check_env(env)

    def test_shorter_observations_of_a_vector_env_end_with_zeros(self):
        env = robosim.VectorEnv(mixed_world(), 2, robots=2, observations=self.parts)
        parts = env.agent_observation_parts
        used = parts["R2"]["heat"].stop
        self.assertLess(used, parts["R1"]["heat"].stop)
        self.assertEqual(env.single_observation_space.shape, (2, parts["R1"]["heat"].stop))
        self.assertEqual(env.single_observation_space.high[1, used:].max(), 0)
        observations, _ = env.reset(seed=1)
        np.testing.assert_array_equal(observations[:, 1, used:], 0)
        robosim.check_env(env)

    def test_refuses_parts_that_no_agent_has(self):
        with self.assertRaisesRegex(robosim.ConfigError, "robot 'R1' cannot observe 'radar'"):
            robosim.ParallelEnv(mixed_world(), observations=("sonar", "radar"))
        with self.assertRaisesRegex(robosim.ConfigError, "robot 'R2' cannot observe laser; observations may be "):
            robosim.ParallelEnv(mixed_world(), observations="laser")


class ParallelEnvTest(unittest.TestCase):
    def test_omnidirectional_agents_take_three_numbers(self):
        builder = robosim.WorldBuilder(x_m=(-5, 5), y_m=(-5, 5))
        world = builder.robot("mpo500", "A", 0, 0).build()
        env = robosim.ParallelEnv(world, observations="pose", random_starts=False)
        env.reset(seed=1)
        self.assertEqual(env.action_space("A").shape, (3,))
        for _ in range(20):
            observations, *_ = env.step({"A": [0, 0, 1]})
        self.assertGreater(observations["A"][1], 0.5)  # to the left

    def test_accepts_options_as_pettingzoo_requires_and_reports_steps(self):
        env = robosim.ParallelEnv(scene.world(2))
        start = {"step": 0, "time_s": 0, "gold_found": False}
        self.assertEqual(env.reset(seed=0, options={"options": 1})[1], {"R1": start, "R2": start})
        first = {"step": 1, "time_s": 0.1, "gold_found": False}
        self.assertEqual(env.step({"R1": [0, 0], "R2": [0, 0]})[4], {"R1": first, "R2": first})

    def test_infos_name_the_winner_and_the_end(self):
        env = robosim.ParallelEnv(scene.world(2), observations="pose", random_starts=False)
        env.reset()
        while env.agents:
            infos = env.step({"R1": [1, 0], "R2": [0, 0]})[4]
        for agent in ("R1", "R2"):
            self.assertEqual((infos[agent]["ended_by"], infos[agent]["winner"], infos[agent]["gold_found"]),
                             ("win", "R1", True))

    def test_conforms(self):
        world = robosim.World.generate("maze", columns=3, rows=3, robots=3)
        robosim.check_env(robosim.ParallelEnv(world, observations=("sonar", "odometry"), max_steps=30))

    def test_generates_a_world_for_each_episode(self):
        env = robosim.ParallelEnv(robosim.WorldGenerator("maze", columns=3, rows=3, robots=2))
        env.reset(seed=1)
        first = env.world_seed
        env.reset()
        self.assertNotEqual(env.world_seed, first)
        env.reset(seed=1)
        self.assertEqual(env.world_seed, first)

    def test_ends_the_episode_of_all_agents(self):
        env = robosim.ParallelEnv(scene.world(2), observations="pose", random_starts=False, max_steps=2,
                                  reward={"forward": 1})
        observations, infos = env.reset(seed=1)
        self.assertEqual(env.agents, ["R1", "R2"])
        np.testing.assert_array_equal(observations["R2"], [0, 1, 0])
        actions = {"R1": [1, 0], "R2": [0, 0]}
        _, rewards, terminated, truncated, _ = env.step(actions)
        self.assertGreater(rewards["R1"], 0)
        self.assertEqual(rewards["R2"], 0)
        self.assertEqual((terminated, truncated), ({"R1": False, "R2": False}, {"R1": False, "R2": False}))
        self.assertEqual(env.step(actions)[3], {"R1": True, "R2": True})
        self.assertEqual(env.agents, [])
        self.assertEqual(env.step({}), ({}, {}, {}, {}, {}))

    def test_refuses_actions_of_other_agents(self):
        env = robosim.ParallelEnv(scene.world(2))
        env.reset()
        with self.assertRaisesRegex(ValueError, r"actions are of the agents \['R1'\]; they must be of \['R1', 'R2'\]"):
            env.step({"R1": [0, 0]})


class BoxTest(unittest.TestCase):
    def test_samples_lie_within_all_kinds_of_bounds(self):
        box = robosim.Box(np.array([0, -np.inf, 3, -np.inf]), np.array([1, 5, np.inf, np.inf]), seed=1)
        for _ in range(100):
            self.assertIn(box.sample(), box)
        self.assertNotIn(np.array([2, 0, 4, 0], np.float32), box)
        self.assertNotIn(np.zeros(3, np.float32), box)
        self.assertTrue(robosim.Box(0, 1, (2,)).is_bounded())
        self.assertFalse(box.is_bounded("below"))


if __name__ == "__main__":
    unittest.main()
