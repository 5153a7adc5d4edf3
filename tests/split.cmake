# With ROBOSIM_SPLIT_TESTS, as in .ci/run, a test is built and run either in Release or with the sanitizers: Release for
# browsers, programs of others, digests, vectorised code, limits of memory, output, and statistics of many runs; the
# sanitizers for everything else, above all for what reads untrusted input. ./dev test and ./dev verify sanitize run every
# test in their builds.
option(ROBOSIM_SPLIT_TESTS "Build each test only in Release or only with sanitizers, as .ci/run does" OFF)
set(ROBOSIM_RUNS_RELEASE_TESTS ON)
set(ROBOSIM_RUNS_SANITIZED_TESTS ON)
if(ROBOSIM_SPLIT_TESTS)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    set(ROBOSIM_RUNS_SANITIZED_TESTS OFF)
    list(APPEND ROBOSIM_TEST_OPTIONS -O1)  # compiles the tests themselves in 30 % less time
  else()
    set(ROBOSIM_RUNS_RELEASE_TESTS OFF)
  endif()
endif()

# Modules whose tests run in both builds: geometry and environment have vectorised loops, the tests of recording run MRPT's
# programs.
set(ROBOSIM_MODULES_TESTED_TWICE geometry environment recording)
# Files of tests/scenarios, without _test.cpp, that run in Release.
set(ROBOSIM_RELEASE_SCENARIOS
  aria_examples bench_parts bench_speed bench_views check digest error_texts export fit gold_report installation instructions
  laser_grid libraries lockstep output_files printed_text python_robot rawlogs reverse_proxy run sdk search_strategies security
  shared_step slam standstill table1 world_changes)
