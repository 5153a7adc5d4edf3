# Which tests a build contains: all (./dev test, ./dev build), or those that ./dev sanitize repeats with the sanitizers: of what
# reads untrusted input, serves other processes, or handles memory by itself. The others, such as digests, statistics of many runs,
# pictures, browsers and programs of others, gain little from sanitizers and take several times as long with them; ./dev verify
# sanitize runs them, too.
set(ROBOSIM_TESTS ALL CACHE STRING "Tests to build: ALL, or SANITIZED, those that ./dev sanitize runs")
set_property(CACHE ROBOSIM_TESTS PROPERTY STRINGS ALL SANITIZED)
if(NOT ROBOSIM_TESTS MATCHES "^(ALL|SANITIZED)$")
  message(FATAL_ERROR "ROBOSIM_TESTS is ${ROBOSIM_TESTS}; it must be ALL or SANITIZED")
endif()

# Modules whose tests are not repeated with the sanitizers.
set(ROBOSIM_UNSANITIZED_MODULES geometry generation learning maze distributed calibration outputs rendering benchmark)
# Files of tests/scenarios, without _test.cpp, that are repeated with the sanitizers.
set(ROBOSIM_SANITIZED_SCENARIOS
  arcos_board arcos_hardware arcos_programs arcos_serial arcos_server attack bad_input console_permissions control controller_parameters faults
  first_connection first_message flood foreign_recording fork geometry_worker input_files joystick load lost_robot reconnection
  requested_recording rpc_permissions run_operator soak standard_services tokens wrong_worker)

# Builds all test programs, and what they start.
add_custom_target(robosim_tests)

# Whether the tests of a module are built.
function(robosim_tests_module name result)
  set(${result} ON PARENT_SCOPE)
  if(ROBOSIM_TESTS STREQUAL SANITIZED AND name IN_LIST ROBOSIM_UNSANITIZED_MODULES)
    set(${result} OFF PARENT_SCOPE)
  endif()
endfunction()
