# find_package(robosim) defines robosim::robosim and robosim_add_plugin() (doc/sdk.md of RoboSim).
include(CMakeFindDependencyMacro)
find_dependency(mrpt-obs)
include(${CMAKE_CURRENT_LIST_DIR}/robosimTargets.cmake)

# robosim_add_plugin(NAME source…): a plugin, the shared library libNAME.so
function(robosim_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES PREFIX lib)
  target_link_libraries(${name} PRIVATE robosim::robosim)
endfunction()
