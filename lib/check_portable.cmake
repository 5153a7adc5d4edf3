# Rejects functions whose results differ from one processor or C library to another, in modules that a run's digest
# depends on: libm's elementary functions, distributions of <random>, and MRPT's poses, which call libm.
# base/portable_math.h and base/portable_pose.h have the same functions with the same bits everywhere.
#
#   cmake "-DFILES=lib/foundation/geometry/ray.cpp;…" -P check_portable.cmake               searches sources: quick, for ./dev lint
#   cmake -DLIBRARY=librobosim_geometry.a -DNM=nm -P check_portable.cmake        searches a library for calls: complete
#
# std::sqrt, fmod, remainder, floor, ceil, round and similar functions are exactly specified, and therefore allowed.
cmake_minimum_required(VERSION 3.25)

# Files that may call libm, with the reason.
set(allowed
  random_scene.cpp)  # scenes of tests and benchmarks

set(elementary
    "(a?(sin|cos|tan)h?|atan2|sincos|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|hypot|cbrt|erfc?|[lt]gamma)")
set(how "use base/portable_math.h or base/portable_pose.h, which return the same bits on every processor "
        "(doc/decisions/portable_math.md)")
set(faults 0)

foreach(file IN LISTS FILES)
  cmake_path(GET file FILENAME name)
  if(name IN_LIST allowed OR file MATCHES "_test\\.cpp$|/testing/|/fake_[a-z]+\\.h$")
    continue()
  endif()
  file(READ ${file} text)
  string(REPLACE ";" "" text "${text}")  # a list would be split there
  string(REPLACE "\n" ";" lines "${text}")
  set(number 0)
  foreach(line IN LISTS lines)
    math(EXPR number "${number} + 1")
    if(NOT line MATCHES "^ *//" AND line MATCHES "(std::${elementary}[fl]?\\(|std::[a-z_]+_distribution|\\.composePoint\\(|\\.inverseComposePoint\\(|CPose[23]D)")
      message(SEND_ERROR "${file}:${number}: ${CMAKE_MATCH_1}: " ${how})
      math(EXPR faults "${faults} + 1")
    endif()
  endforeach()
endforeach()

if(LIBRARY)
  execute_process(COMMAND ${NM} --demangle --undefined-only ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ";" "" symbols "${symbols}")
  string(REPLACE "\n" ";" lines "${symbols}")
  foreach(line IN LISTS lines)
    if(line MATCHES "^([a-z0-9_]+\\.cpp)\\.o:$")
      set(member ${CMAKE_MATCH_1})
    elseif(line MATCHES " U (${elementary}[fl]?|_ZGV.*|mrpt::(math|poses)::.*)$" AND NOT member IN_LIST allowed)
      message(SEND_ERROR "${LIBRARY}: ${member} calls ${CMAKE_MATCH_1}: " ${how})
      math(EXPR faults "${faults} + 1")
    endif()
  endforeach()
endif()
if(faults EQUAL 0)
  message(STATUS "no function whose bits differ from one processor to another")
endif()
