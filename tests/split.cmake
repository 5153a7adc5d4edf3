# With ROBOSIM_SPLIT_TESTS, as in .ci/run, a test is built and run either in Release or with the sanitizers. The sanitizers
# are for what reads untrusted input or serves other processes; Release is for everything else: browsers, programs of
# others, digests, vectorised code, limits of memory, output, statistics of many runs, pictures. ./dev test, ./dev sanitize
# and ./dev verify sanitize run every test in their builds.
option(ROBOSIM_SPLIT_TESTS "Build each test only in Release or only with sanitizers, as .ci/run does" OFF)
set(ROBOSIM_RUNS_RELEASE_TESTS ON)
set(ROBOSIM_RUNS_SANITIZED_TESTS ON)
if(ROBOSIM_SPLIT_TESTS)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    set(ROBOSIM_RUNS_SANITIZED_TESTS OFF)
    # To compile in 20 % to 30 % less time: the tests themselves, and modules and programs in which little time is spent.
    list(APPEND ROBOSIM_TEST_OPTIONS -O1)
    set(ROBOSIM_SERVICE_OPTIONS -O1)
  else()
    set(ROBOSIM_RUNS_RELEASE_TESTS OFF)
  endif()
endif()

# Modules whose tests run in Release only, and in both builds: environment has vectorised loops and reads saved states, the
# tests of recording run MRPT's programs. All others: with the sanitizers.
set(ROBOSIM_RELEASE_MODULES geometry generation learning maze distributed calibration outputs rendering benchmark)
set(ROBOSIM_MODULES_TESTED_TWICE environment recording)
# Files of tests/scenarios, without _test.cpp, that run with the sanitizers.
set(ROBOSIM_SANITIZED_SCENARIOS
  arcos_board arcos_hardware arcos_serial arcos_server attack bad_input console_permissions control controller_parameters faults
  first_connection first_message flood foreign_recording fork geometry_worker input_files joystick load lost_robot reconnection
  requested_recording rpc_permissions run_operator soak standard_services tokens wrong_worker)

# Whether the tests of a module are built.
function(robosim_tests_module name result)
  set(${result} OFF PARENT_SCOPE)
  if(name IN_LIST ROBOSIM_MODULES_TESTED_TWICE
     OR (ROBOSIM_RUNS_RELEASE_TESTS AND name IN_LIST ROBOSIM_RELEASE_MODULES)
     OR (ROBOSIM_RUNS_SANITIZED_TESTS AND NOT name IN_LIST ROBOSIM_RELEASE_MODULES))
    set(${result} ON PARENT_SCOPE)
  endif()
endfunction()
