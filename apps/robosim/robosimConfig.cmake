# find_package(robosim) defines robosim::robosim and robosim_add_plugin() (doc/sdk.md of RoboSim).
include(CMakeFindDependencyMacro)
find_dependency(mrpt-obs)
include(${CMAKE_CURRENT_LIST_DIR}/robosimTargets.cmake)

# robosim_add_plugin(NAME source…): a plugin, the shared library libNAME.so. Where it is installed, it finds RoboSim's libraries at
# the place at which it was linked: `robosim run` loads only some of them itself.
function(robosim_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES PREFIX lib INSTALL_RPATH_USE_LINK_PATH ON)
  target_link_libraries(${name} PRIVATE robosim::robosim)
endfunction()
