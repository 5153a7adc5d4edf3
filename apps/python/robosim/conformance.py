"""Checks whether an environment follows the interface of Gymnasium's VectorEnv or PettingZoo's ParallelEnv."""
import numpy as np

from ._arguments import refuse
from .parallel_env import ParallelEnv


def check_env(env, steps=200):
    """Raises AssertionError when an environment violates its interface. Takes `steps` random steps, and closes it.

    env: an environment with the interface of gymnasium.vector.VectorEnv 1.0 with next-step autoreset, or of
        pettingzoo.ParallelEnv (with possible_agents). Its episodes must not depend on anything but seeds and actions.
    """
    if not hasattr(env, "reset") or not hasattr(env, "step"):
        refuse("env", env, "an environment with reset() and step()", 'robosim.VectorEnv("small_maze")')
    if isinstance(env, ParallelEnv) or hasattr(env, "possible_agents"):
        _check_parallel(env, steps)
    else:
        _check_vector(env, steps)


def _require(condition, text):
    if not condition:
        raise AssertionError(text)


def _require_refusal(call, text):
    try:
        call()
    except (ValueError, TypeError, AssertionError):
        return
    raise AssertionError(text)


def _check_vector(env, steps):
    _check_attributes(env)
    env.action_space.seed(0)
    actions = [env.action_space.sample() for _ in range(steps)]
    first = _checked_episodes(env, actions)
    again = _checked_episodes(env, actions)
    for a, b in zip(first, again):
        _require(all(np.array_equal(x, y) for x, y in zip(a, b)), "equal seeds and actions must give equal steps")
    bad = np.full(env.action_space.shape, np.nan, env.action_space.dtype)
    _require_refusal(lambda: env.step(bad), "step() must refuse actions that are not finite")
    _require_refusal(lambda: env.step(actions[0][..., :-1]), "step() must refuse actions of another shape")
    env.close()
    _require(env.closed, "close() must set closed")
    env.close()
    _require_refusal(lambda: env.step(actions[0]), "step() must refuse a closed environment")


def _check_attributes(env):
    _require(isinstance(env.num_envs, int) and env.num_envs > 0, "num_envs must be a positive int")
    mode = env.metadata.get("autoreset_mode")
    _require(getattr(mode, "value", mode) == "NextStep", "metadata must have the autoreset_mode NEXT_STEP")
    for name in ("spec", "render_mode", "closed", "np_random", "unwrapped"):
        _require(hasattr(env, name), f"the environment must have the attribute {name}")
    for name in ("observation_space", "action_space"):
        _check_batched(getattr(env, name), getattr(env, "single_" + name), env.num_envs, name)


def _check_batched(whole, single, count, name):
    if hasattr(single, "spaces"):
        _require(hasattr(whole, "spaces") and set(whole.spaces) == set(single.spaces),
                 f"{name} must have the names of single_{name}")
        for part in single.spaces:
            _check_batched(whole[part], single[part], count, name)
        return
    _require(whole.shape == (count, *single.shape), f"{name} must be the batched single_{name}")
    _require(whole.dtype == single.dtype, f"{name} and single_{name} must have one type")


def _arrays_of(observation):
    """Copies of an observation's array, or of the arrays of a dict in the order of their names."""
    if isinstance(observation, dict):
        return [array.copy() for _, array in sorted(observation.items())]
    return [observation.copy()]


def _checked_episodes(env, actions):
    observations, infos = env.reset(seed=7)
    _check_observations(env, observations, infos)
    over = np.zeros(env.num_envs, bool)
    steps = [_arrays_of(observations)]
    for action in actions:
        observations, rewards, terminated, truncated, infos = env.step(action)
        _check_observations(env, observations, infos)
        _require(rewards.dtype == np.float64 and rewards.shape[0] == env.num_envs,
                 "rewards must be float64 by environment")
        for flags in (terminated, truncated):
            _require(flags.dtype == bool and flags.shape == (env.num_envs,), "ends must be bool by environment")
        _require(not np.any(terminated & truncated), "an episode must end either way, not both")
        _require(not np.any((terminated | truncated) & over),
                 "the step after an episode's end must begin the next episode")
        _require(not np.any(rewards[over]), "the step after an episode's end must have reward 0")
        steps.append([*_arrays_of(observations), rewards.copy(), terminated.copy(), truncated.copy()])
        over = terminated | truncated
    return steps


def _check_observations(env, observations, infos):
    _require(isinstance(infos, dict), "infos must be a dict")
    _require(env.observation_space.contains(observations), "observations must be elements of observation_space")


def _check_parallel(env, steps):
    agents = list(env.possible_agents)
    _require(env.max_num_agents == len(agents) > 0, "max_num_agents must be the number of possible_agents")
    for i, agent in enumerate(agents):
        _require(env.action_space(agent) is env.action_space(agent),
                 "action_space() must return the same object each time")
        env.action_space(agent).seed(i)
    actions = [{agent: env.action_space(agent).sample() for agent in agents} for _ in range(steps)]
    _require(_checked_team(env, actions) == _checked_team(env, actions),
             "equal seeds and actions must give equal steps")
    env.reset(seed=7)
    _require_refusal(lambda: env.step({}), "step() must refuse missing actions")
    bad = {agent: np.full(env.action_space(agent).shape, np.nan, np.float32) for agent in agents}
    _require_refusal(lambda: env.step(bad), "step() must refuse actions that are not finite")
    env.close()


def _checked_team(env, actions):
    """The rewards and observations of all steps."""
    seen = []
    _check_team(env, env.reset(seed=7))
    for action in actions:
        if not env.agents:
            _check_team(env, env.reset())
        agents = set(env.agents)
        results = env.step({agent: action[agent] for agent in env.agents})
        _require(len(results) == 5, "step() must return five dicts")
        _require(all(set(result) == agents for result in results), "each result must be of all agents that acted")
        observations, rewards, terminated, truncated, _ = results
        for agent in agents:
            _require(env.observation_space(agent).contains(observations[agent]),
                     "observations must be elements of their space")
        over = {agent for agent in agents if terminated[agent] or truncated[agent]}
        _require(set(env.agents) == agents - over, "agents must be those whose episode has not ended")
        seen.append((sorted(rewards.items()), [array.tobytes() for agent in sorted(agents) for array in _arrays_of(observations[agent])]))
    return seen


def _check_team(env, returned):
    observations, infos = returned
    _require(set(observations) == set(infos) == set(env.agents) == set(env.possible_agents),
             "reset() must return observations and infos of all agents")
    for agent, observation in observations.items():
        _require(env.observation_space(agent).contains(observation), "observations must be elements of their space")
