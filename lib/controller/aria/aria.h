#pragma once

/// @file
/// All of the interface with ARIA's names (doc/from_aria.md), as ARIA's Aria.h.

#include "aria/actions/action_bumpers.h"
#include "aria/actions/action_decelerating_limiter.h"
#include "aria/actions/action_group.h"
#include "aria/actions/action_input.h"
#include "aria/actions/action_joydrive.h"
#include "aria/actions/action_keydrive.h"
#include "aria/actions/action_ratio_input.h"
#include "aria/gripper.h"
#include "aria/key_handler.h"
#include "aria/laser_device.h"
#include "aria/pioneer_map.h"
#include "aria/pioneer_robot.h"
#include "aria/ptz.h"
#include "aria/sonar_device.h"
#include "aria/stock_actions.h"
