// Orders that steer the robot by a fixed amount: the change of the speed, or a turn for a moment, as fractions of the
// robot's maximum. The rows of kOrders in lib/controller/remote/orders.h, with which a test compares this file.

export const STEERING = {
  accelerate: { speed: 0.1 },
  decelerate: { speed: -0.1 },
  turn_left: { turn: 0.5 },
  turn_right: { turn: -0.5 },
};
