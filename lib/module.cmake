# robosim_module(PATH [PORTABLE] [COMPUTING | SERVICE] [COMPUTING_TESTS] [WITHOUT folder…] USES module… LINKS target…)
#
# Defines a module, from the sources in PATH, relative to the storey, and in the folders there; WITHOUT those that are modules of their
# own. The last component of PATH is its NAME, but all of it in arcos/ (arcos_board): the target robosim::NAME, and the program
# robosim_NAME_test from the *_test.cpp.
# Its headers are included as "PATH/file.h". Sources in PATH/testing, such as brute-force references, are the target robosim::NAME_testing,
# which only the tests of NAME and of the modules that use it are linked to, and benchmarks that need it.
# USES are the modules that NAME may include, all declared before it; the test includes.NAME fails on an #include of any other.
# LINKS are external libraries.
# PORTABLE: a run's digest depends on what the module computes; the test portable.NAME fails when it calls a function whose results
# differ between processors or C libraries.
# COMPUTING: its tests would take long without optimisation. SERVICE: it exchanges data with other processes and files or presents it,
# so that little of the time of a step is spent in it.
# COMPUTING_TESTS: its tests themselves compute, such as brute-force references; the others are compiled without optimisation, in a quarter
# to a third less time.
function(robosim_module path)
  cmake_parse_arguments(MODULE "PORTABLE;COMPUTING;SERVICE;COMPUTING_TESTS" "" "WITHOUT;USES;LINKS" ${ARGN})
  get_filename_component(name ${path} NAME)
  if(path MATCHES "^arcos/")
    string(REPLACE "/" "_" name ${path})
  endif()
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${path})
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp ${folder}/*/*.cpp)
  foreach(module IN LISTS MODULE_WITHOUT)
    list(FILTER sources EXCLUDE REGEX "^${folder}/${module}/")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY ROBOSIM_MODULES ${name})
  set_property(GLOBAL PROPERTY ROBOSIM_MODULE_${name} "${folder};${path}")
  set_property(GLOBAL PROPERTY ROBOSIM_USES_${name} "${MODULE_USES}")
  set_property(GLOBAL PROPERTY ROBOSIM_WITHOUT_${name} "${MODULE_WITHOUT}")
  set(testing ${sources})
  list(FILTER testing INCLUDE REGEX "/testing/")
  list(FILTER sources EXCLUDE REGEX "/testing/")
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")

  set(target robosim_${name})
  set(kind PUBLIC)
  if(sources)
    add_library(${target} STATIC ${sources})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)  # part of shared libraries, too
    if(MODULE_COMPUTING)
      target_compile_options(${target} PRIVATE ${ROBOSIM_COMPUTING_OPTIONS})
    elseif(MODULE_SERVICE)
      target_compile_options(${target} PRIVATE ${ROBOSIM_SERVICE_OPTIONS})
    endif()
  else()
    add_library(${target} INTERFACE)
    set(kind INTERFACE)
  endif()
  add_library(robosim::${name} ALIAS ${target})
  target_include_directories(${target} ${kind} ${CMAKE_CURRENT_SOURCE_DIR})
  list(TRANSFORM MODULE_USES PREPEND robosim:: OUTPUT_VARIABLE used_modules)
  target_link_libraries(${target} ${kind} ${used_modules} ${MODULE_LINKS})
  if(testing)
    add_library(${target}_testing STATIC ${testing})
    add_library(robosim::${name}_testing ALIAS ${target}_testing)
    target_link_libraries(${target}_testing PUBLIC ${target})
  endif()

  if(MODULE_PORTABLE AND ROBOSIM_TESTS STREQUAL ALL)
    add_test(NAME portable.${name}
      COMMAND ${CMAKE_COMMAND} -DLIBRARY=$<TARGET_FILE:${target}> -DNM=${CMAKE_NM}
              -P ${PROJECT_SOURCE_DIR}/lib/check_portable.cmake)
  endif()
  robosim_tests_module(${name} are_tested)
  if(tests AND are_tested)
    add_executable(${target}_test ${tests})
    target_link_libraries(${target}_test PRIVATE ${target} GTest::gtest GTest::gtest_main)
    foreach(module ${name} ${MODULE_USES})
      if(TARGET robosim_${module}_testing)
        target_link_libraries(${target}_test PRIVATE robosim_${module}_testing)
      endif()
    endforeach()
    target_compile_options(${target}_test PRIVATE ${ROBOSIM_TEST_OPTIONS})
    if(NOT MODULE_COMPUTING_TESTS)
      target_compile_options(${target}_test PRIVATE ${ROBOSIM_SCENARIO_OPTIONS})
    endif()
    target_compile_definitions(${target}_test PRIVATE ROBOSIM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    robosim_add_suites(${target}_test ${name})
  endif()
endfunction()

# The tests includes.NAME of all modules.
function(robosim_test_includes)
  if(NOT ROBOSIM_TESTS STREQUAL ALL)
    return()
  endif()
  get_property(modules GLOBAL PROPERTY ROBOSIM_MODULES)
  set(paths "")
  foreach(name IN LISTS modules)
    get_property(module GLOBAL PROPERTY ROBOSIM_MODULE_${name})
    list(GET module 1 path)
    list(APPEND paths ${name}=${path})
  endforeach()
  foreach(name IN LISTS modules)
    get_property(module GLOBAL PROPERTY ROBOSIM_MODULE_${name})
    list(GET module 0 folder)
    get_property(uses GLOBAL PROPERTY ROBOSIM_USES_${name})
    add_test(NAME includes.${name}
      COMMAND ${CMAKE_COMMAND} -DMODULE=${name} -DFOLDER=${folder} "-DUSES=${uses}" "-DMODULES=${paths}"
              -P ${PROJECT_SOURCE_DIR}/lib/check_includes.cmake)
  endforeach()
endfunction()
