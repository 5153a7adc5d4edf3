#pragma once
#include <robosim/run/registry.h>

robosim::ControllerType argosDiffusionType();
robosim::ControllerType argosFlockingType();
robosim::ControllerType argosForagingType();
/// The items that robots carry to the nest: what ARGoS's loop functions do.
robosim::ObserverType argosFoodType();
