# robosim_module(NAME [PORTABLE] USES module… LINKS target…)
#
# Defines the target robosim::NAME from the sources in lib/NAME and its folders, and the program robosim_NAME_test from the
# *_test.cpp among them. Sources in lib/NAME/testing, such as brute-force references, are the target robosim::NAME_testing,
# which only the tests of NAME and of the modules that use it are linked to, and benchmarks that need it.
# USES are the modules that NAME may include, all further down the list in CMakeLists.txt; the test includes.NAME fails on
# an #include of any other. LINKS are external libraries. PORTABLE: a run's digest depends on what the module
# computes; the test portable.NAME fails when it calls a function whose results differ between processors or C libraries.
function(robosim_module name)
  cmake_parse_arguments(MODULE "PORTABLE" "" "USES;LINKS" ${ARGN})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${name})
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp ${folder}/*/*.cpp)
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
    if(name IN_LIST ROBOSIM_COMPUTING_MODULES)
      target_compile_options(${target} PRIVATE ${ROBOSIM_COMPUTING_OPTIONS})
    elseif(name IN_LIST ROBOSIM_SERVICE_MODULES)
      target_compile_options(${target} PRIVATE ${ROBOSIM_SERVICE_OPTIONS})
    endif()
  else()
    add_library(${target} INTERFACE)
    set(kind INTERFACE)
  endif()
  add_library(robosim::${name} ALIAS ${target})
  target_include_directories(${target} ${kind} ${PROJECT_SOURCE_DIR}/lib)
  list(TRANSFORM MODULE_USES PREPEND robosim:: OUTPUT_VARIABLE used_modules)
  target_link_libraries(${target} ${kind} ${used_modules} ${MODULE_LINKS})
  if(testing)
    add_library(${target}_testing STATIC ${testing})
    add_library(robosim::${name}_testing ALIAS ${target}_testing)
    target_link_libraries(${target}_testing PUBLIC ${target})
  endif()

  if(ROBOSIM_TESTS STREQUAL ALL)
    add_test(NAME includes.${name}
      COMMAND ${CMAKE_COMMAND} -DMODULE=${name} "-DUSES=${MODULE_USES}" -DLIB=${PROJECT_SOURCE_DIR}/lib
              -P ${PROJECT_SOURCE_DIR}/lib/check_includes.cmake)
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
    if(NOT name IN_LIST ROBOSIM_COMPUTING_TESTS)
      target_compile_options(${target}_test PRIVATE ${ROBOSIM_SCENARIO_OPTIONS})
    endif()
    target_compile_definitions(${target}_test PRIVATE ROBOSIM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    robosim_add_suites(${target}_test ${name})
  endif()
endfunction()
