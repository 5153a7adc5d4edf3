"""Perception and steering of the hand-written policies, for arrays of robots: shapes (…,) and (…, beams)."""
import numpy as np


def wrap(angle_rad):
    """The same angle in [-π, π)."""
    return (angle_rad + np.pi) % (2 * np.pi) - np.pi


def ring_bearings(beams, field_of_view_rad):
    """Bearings of the beams of a laser [rad], from the right to the left."""
    return np.linspace(-field_of_view_rad / 2, field_of_view_rad / 2, beams)


def position_of(ranges, half_length_m, half_width_m):
    """x, y [m] from the ranges to beacons at the south-west, south-east, north-east and north-west corner: the difference of
    the squares of two of them is linear in the position."""
    squares = np.asarray(ranges, np.float64) ** 2
    sw, se, ne, nw = (squares[..., i] for i in range(4))
    return (sw - se + nw - ne) / (8 * half_length_m), (sw - nw + se - ne) / (8 * half_width_m)


def nearest_low(low, high, bearings, radius_m, allowed=True):
    """Range to the centre [m] and bearing of the nearest low object of this radius, which the lower of two lasers meets and
    the upper one does not; infinite without one. allowed: beams that count."""
    ranges = np.where((low + 0.05 < high) & allowed, low, np.inf)
    nearest = ranges.min(axis=-1, keepdims=True)
    weight = (ranges <= nearest + radius_m / 4) & np.isfinite(ranges)
    bearing = np.arctan2((weight * np.sin(bearings)).sum(-1), (weight * np.cos(bearings)).sum(-1))
    return nearest[..., 0] + radius_m, bearing


def free_direction(ranges, bearings, wanted_rad, radius_m, look_m=0.5, margin_m=0.04):
    """The bearing nearest to the wanted one in which no echo is in the way; the wanted one if all are blocked."""
    steps = np.array([side * i * np.pi / 18 for i in range(14) for side in (1, -1)])
    directions = wanted_rad[..., None] + steps
    apart = bearings - directions[..., None]  # (…, directions, beams)
    along, aside = ranges[..., None, :] * np.cos(apart), ranges[..., None, :] * np.sin(apart)
    blocks = ((ranges[..., None, :] <= radius_m + look_m) & (along > 0.3 * ranges[..., None, :])
              & (np.abs(aside) < radius_m + margin_m)).any(-1)
    first = np.where(blocks.all(-1), 0, blocks.argmin(-1))
    return np.take_along_axis(directions, first[..., None], -1)[..., 0]


def steer(bearing_rad, speed, turn_max_radps):
    """Action towards a bearing: turns on the spot for large ones. speed: fraction of the maximum."""
    bearing_rad = wrap(bearing_rad)
    return np.stack([speed * np.maximum(0, 1 - np.abs(bearing_rad)), np.clip(4 * bearing_rad / turn_max_radps, -1, 1)], -1)


def push(distance_m, bearing_rad, error_rad, contact_m, speed, turn_max_radps, free):
    """Action that pushes a disc to a target.

    distance_m, bearing_rad: of the disc. error_rad: direction to the disc minus direction from the disc to the target.
    contact_m: sum of the radii. free(bearing): the bearing nearest to another in which the way is free.
    """
    wanted = np.clip(-error_rad, -0.45, 0.45)
    pushing = (distance_m < contact_m + 0.05) & (np.abs(error_rad) < 0.8) & (np.abs(bearing_rad) < 1)
    turn = speed * np.sin(bearing_rad) / contact_m + 4 * (bearing_rad - wanted)
    pushed = np.stack([speed * np.clip(1.3 - np.abs(bearing_rad - wanted), 0.2, 1), np.clip(turn / turn_max_radps, -1, 1)], -1)
    # Round the disc, at most along a tangent of the circle that passes it.
    pass_m = contact_m + 0.12
    inside = np.pi / 2 + np.minimum(1, (pass_m - distance_m) / 0.12) * np.pi / 6
    outside = np.arcsin(np.clip(pass_m / np.maximum(distance_m, 1e-6), 0, 1))
    tangent = np.where(distance_m > pass_m, outside, inside)
    offset = np.minimum(1.6 * np.abs(error_rad), np.maximum(tangent, 0.8))
    round_it = steer(free(bearing_rad + np.copysign(offset, error_rad)), speed, turn_max_radps)
    return np.where(pushing[..., None], pushed, round_it)


def sectors(ranges, count):
    """Smallest range of each of so many equal sectors of the beams."""
    usable = ranges.shape[-1] // count * count
    return ranges[..., :usable].reshape(*ranges.shape[:-1], count, -1).min(-1)
