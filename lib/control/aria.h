#pragma once

/// @file
/// All of the interface with ARIA's names (doc/from_aria.md), as ARIA's Aria.h.

#include "control/actions/action_bumpers.h"
#include "control/actions/action_decelerating_limiter.h"
#include "control/actions/action_group.h"
#include "control/actions/action_input.h"
#include "control/actions/action_joydrive.h"
#include "control/actions/action_keydrive.h"
#include "control/actions/action_ratio_input.h"
#include "control/key_handler.h"
#include "control/laser_device.h"
#include "control/pioneer_map.h"
#include "control/pioneer_robot.h"
#include "control/sonar_device.h"
#include "control/stock_actions.h"
