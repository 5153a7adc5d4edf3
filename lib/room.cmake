# robosim_room(NAME USES room… LINKS target…)
#
# Makes lib/NAME the target robosim::NAME from all its *.cpp, and its *_test.cpp the program robosim_NAME_test.
# USES are the rooms that NAME may include, all further down the list in CMakeLists.txt; the test includes.NAME fails on
# an #include of any other. LINKS are libraries from outside.
function(robosim_room name)
  cmake_parse_arguments(ROOM "" "" "USES;LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")

  set(target robosim_${name})
  set(kind PUBLIC)
  if(sources)
    add_library(${target} STATIC ${sources})
  else()
    add_library(${target} INTERFACE)
    set(kind INTERFACE)
  endif()
  add_library(robosim::${name} ALIAS ${target})
  target_include_directories(${target} ${kind} ${PROJECT_SOURCE_DIR}/lib)
  list(TRANSFORM ROOM_USES PREPEND robosim:: OUTPUT_VARIABLE used_rooms)
  target_link_libraries(${target} ${kind} ${used_rooms} ${ROOM_LINKS})

  add_test(NAME includes.${name}
    COMMAND ${CMAKE_COMMAND} -DROOM=${name} "-DUSES=${ROOM_USES}" -DLIB=${PROJECT_SOURCE_DIR}/lib
            -P ${PROJECT_SOURCE_DIR}/lib/check_includes.cmake)
  if(tests)
    add_executable(${target}_test ${tests})
    target_link_libraries(${target}_test PRIVATE ${target} GTest::gtest GTest::gtest_main)
    target_compile_definitions(${target}_test PRIVATE ROBOSIM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    gtest_discover_tests(${target}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60)
  endif()
endfunction()
