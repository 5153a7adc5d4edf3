# robosim_add_test(NAME command…)
#
# Adds a ctest whose processor time ./dev test reports.
#
# robosim_add_suites(TARGET PREFIX [EXCEPT suite])
#
# Adds a ctest PREFIX.SUITE for each GoogleTest suite of a test program; it runs all tests of the suite in one process,
# because for most tests to load the shared libraries takes longer than the test. The program is asked for its suites
# after each build, so this file is also the script that does this.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(ROBOSIM_SUITES_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
  set(ROBOSIM_TIMED ${CMAKE_CURRENT_LIST_DIR}/timed.sh ${CMAKE_BINARY_DIR}/suite_times)
  function(robosim_add_test name)
    add_test(NAME ${name} COMMAND ${ROBOSIM_TIMED} ${name} ${ARGN})
  endfunction()
  function(robosim_add_suites target prefix)
    add_dependencies(robosim_tests ${target})
    cmake_parse_arguments(SUITES "" "EXCEPT" "" ${ARGN})
    set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    add_custom_command(TARGET ${target} POST_BUILD VERBATIM
      COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${target}> -DPREFIX=${prefix} -DEXCEPT=${SUITES_EXCEPT} -DLIST=${list}
              "-DTIMED=${ROBOSIM_TIMED}"
              -P ${ROBOSIM_SUITES_SCRIPT})
    file(WRITE ${list}.include "if(EXISTS [[${list}]])\n  include([[${list}]])\nelse()\n  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\nendif()\n")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list}.include)
  endfunction()
  return()
endif()

cmake_policy(VERSION 3.25)
# Suites that take longest start first, so that none runs alone at the end.
set(long_suites AriaExamples BenchSpeed Camera ChosenControllers ConsoleSessionProperty Control Faults Fit InputFiles LostRobot Rawlogs Replay Sdk
    Video View ViewWindow OfEveryController/Standstill InputFiles/WaitingForAPipe Worlds/Golden)

# No other test runs beside these, on two processors: programs drive robots through ARCOS in real time, or faster.
set(suites_sensitive_to_delays ArcosSerialLine AriaExamples)

execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE tests COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n]+\\." suites "${tests}")  # tests are indented
set(script "")
list(TRANSFORM TIMED REPLACE "(.+)" "[[\\1]]" OUTPUT_VARIABLE timed)
list(JOIN timed " " timed)
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" suite "${suite}")
  if(suite STREQUAL EXCEPT)
    continue()
  endif()
  string(APPEND script
    "add_test([[${PREFIX}.${suite}]] ${timed} [[${PREFIX}.${suite}]] [[${PROGRAM}]] [[--gtest_filter=${suite}.*]] --gtest_brief=1)\n")
  if(suite IN_LIST long_suites)
    string(APPEND script "set_tests_properties([[${PREFIX}.${suite}]] PROPERTIES COST 100)\n")
  endif()
  if(suite IN_LIST suites_sensitive_to_delays)
    string(APPEND script "set_tests_properties([[${PREFIX}.${suite}]] PROPERTIES PROCESSORS 3)\n")
  endif()
endforeach()
file(WRITE ${LIST} "${script}")
