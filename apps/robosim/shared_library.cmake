# robosim_shared_library(NAME MODULES module… [SOURCES file…] [USES library…] [PACKAGE component] [INTERNAL])
#
# Defines the shared library libNAME.so from the object files of modules, as the target robosim_shared, or robosim_shared_PART for
# NAME robosim-PART; installed with its headers and exported as robosim::robosim or robosim::PART. USES are the shared libraries that
# it depends on. The static modules are linked after them, for their external libraries only: their object files are in a shared
# library already, so that the linker takes none from the archives (tests Libraries.*). An INTERNAL library is loaded by
# robosimMain() only: it has no headers for users. PACKAGE is the component in which it is packaged (apps/packaging); without
# packages, all libraries are in the component robosim.
set(ROBOSIM_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/robosim)

function(robosim_shared_library name)
  cmake_parse_arguments(LIBRARY "INTERNAL" "PACKAGE" "MODULES;SOURCES;USES" ${ARGN})
  set(component robosim)
  if(ROBOSIM_PACKAGES AND LIBRARY_PACKAGE)
    set(component ${LIBRARY_PACKAGE})
  endif()
  string(REGEX REPLACE "^robosim-?" "" part ${name})
  if(part)
    set(target robosim_shared_${part})
    set(export ${part})
  else()
    set(target robosim_shared)
    set(export robosim)
  endif()
  list(TRANSFORM LIBRARY_MODULES PREPEND robosim_ OUTPUT_VARIABLE modules)
  set(used ${LIBRARY_USES})
  list(TRANSFORM used REPLACE "^robosim-" "robosim_shared_")
  list(TRANSFORM used REPLACE "^robosim$" "robosim_shared")

  add_library(${target} SHARED ${LIBRARY_SOURCES})
  foreach(module ${modules})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${module}>)
  endforeach()
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION ${ROBOSIM_SOVERSION}
                        EXPORT_NAME ${export} LINKER_LANGUAGE CXX INSTALL_RPATH "$ORIGIN;$ORIGIN/robosim")
  # A wheel copies the libraries from the build tree, where they lie together, too. Those of packages have no path.
  if(NOT CMAKE_SKIP_INSTALL_RPATH)
    set_target_properties(${target} PROPERTIES BUILD_WITH_INSTALL_RPATH ON)
  endif()
  # Without --no-as-needed, the linker would drop a library that only another shared library uses, and then take its functions from
  # the archives.
  target_link_libraries(${target} INTERFACE ${used}
                        PRIVATE -Wl,--no-as-needed ${used} -Wl,--as-needed ${modules})
  # Calls within the library are direct, as in a program.
  target_link_options(${target} PRIVATE -Wl,--as-needed -Wl,-Bsymbolic-functions
                      $<$<CXX_COMPILER_ID:GNU>:-Wl,--no-undefined>)  # clang links the sanitizers to programs only

  if(LIBRARY_INTERNAL)
    install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component} NAMELINK_SKIP)
    return()
  endif()
  # For programs and plugins of users (doc/sdk.md): #include <robosim/run/plugin.h>, with find_package(robosim).
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS ${target} EXPORT robosim LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
          NAMELINK_COMPONENT robosim-dev)
  foreach(module ${LIBRARY_MODULES})
    get_property(is_module GLOBAL PROPERTY ROBOSIM_MODULE_${module} SET)
    if(is_module)
      get_property(found GLOBAL PROPERTY ROBOSIM_MODULE_${module})
      list(GET found 0 folder)
      list(GET found 1 path)
      get_property(without GLOBAL PROPERTY ROBOSIM_WITHOUT_${module})
      install(CODE "
        set(from \"${folder}\")
        set(to \"${ROBOSIM_INCLUDE_DIR}/${path}\")
        set(without \"testing;${without}\")
        include(\"${PROJECT_SOURCE_DIR}/apps/robosim/install_headers.cmake\")" COMPONENT robosim-dev)
    endif()
  endforeach()
endfunction()
