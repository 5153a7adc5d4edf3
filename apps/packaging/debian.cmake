# The Debian packages, one per install component.
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "CMAKE_INSTALL_PREFIX is ${CMAKE_INSTALL_PREFIX}: Debian packages install to /usr; use the preset package")
endif()
if(NOT HELP2MAN)
  message(FATAL_ERROR "help2man is not installed: the packages contain manual pages; apt-get install help2man")
endif()

get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
list(FILTER CPACK_COMPONENTS_ALL INCLUDE REGEX "^(librobosim|librobosim-extra|robosim|robosim-data|robosim-dev|robosim-mpi|robosim-dds|python3-robosim)$")

# 0.1.0-1~deb12 for Debian 12, so that an upgrade of Debian replaces the package by that of the next release.
file(STRINGS /etc/os-release release REGEX "^(VERSION_ID|VERSION_CODENAME)=")
list(TRANSFORM release REPLACE "^[A-Z_]+=\"?([^\"]*)\"?$" "\\1")
list(SORT release)  # the number first
list(GET release 0 debian_number)
list(GET release -1 debian_name)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/packages)
set(CPACK_PACKAGE_NAME robosim)
set(CPACK_PACKAGE_VENDOR "RoboSim developers")
# Builders of packages for others set their own address.
set(CPACK_PACKAGE_CONTACT "RoboSim developers <robosim@example.org>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each component has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1~deb${debian_number})
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# CPack does not evaluate generator expressions.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/apps/robosim)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(full_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

set(about "RoboSim simulates teams of cooperating mobile robots with sonars, lasers,
cameras, heat and other sensors, and with radio messages, in a common world
and in fixed time steps. A run is reproducible bit for bit. It is recorded as
a rawlog for the Mobile Robot Programming Toolkit (MRPT).")

# What each package needs from Debian decides the division (doc/decisions/shared_library.md).
set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(engine_package librobosim${soversion})
set(extra_package librobosim-extra${soversion})

set(CPACK_COMPONENT_LIBROBOSIM_DESCRIPTION "simulator of cooperating mobile robots - engine
${about}

This package contains the library librobosim: the engine, sensors, controllers
and runs, without maps, recordings, pictures and networks.")
set(CPACK_DEBIAN_LIBROBOSIM_PACKAGE_NAME ${engine_package})
set(CPACK_DEBIAN_LIBROBOSIM_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBROBOSIM_PACKAGE_RECOMMENDS "robosim-data")

set(CPACK_COMPONENT_LIBROBOSIM-EXTRA_DESCRIPTION "simulator of cooperating mobile robots - maps, recordings, pictures
${about}

This package contains the libraries for maps, recordings, pictures and the
subcommands of robosim that need no network.")
set(CPACK_DEBIAN_LIBROBOSIM-EXTRA_PACKAGE_NAME ${extra_package})
set(CPACK_DEBIAN_LIBROBOSIM-EXTRA_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBROBOSIM-EXTRA_PACKAGE_DEPENDS "${engine_package} (= ${full_version})")
# Fonts for names on pictures, and software rendering for cameras and views.
set(CPACK_DEBIAN_LIBROBOSIM-EXTRA_PACKAGE_RECOMMENDS "fonts-dejavu-core, libegl1, libgl1-mesa-dri, robosim-data")

set(CPACK_COMPONENT_ROBOSIM-DATA_DESCRIPTION "simulator of cooperating mobile robots - data
${about}

This package contains worlds, robot types, maps and recordings.")
set(CPACK_DEBIAN_ROBOSIM-DATA_PACKAGE_NAME robosim-data)
set(CPACK_DEBIAN_ROBOSIM-DATA_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ROBOSIM-DATA_PACKAGE_ARCHITECTURE all)

set(CPACK_COMPONENT_ROBOSIM_DESCRIPTION "simulator of cooperating mobile robots
${about}

This package contains the program robosim, the libraries of its subcommands
with a network or windows, and the documentation.")
set(CPACK_DEBIAN_ROBOSIM_PACKAGE_NAME robosim)
set(CPACK_DEBIAN_ROBOSIM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ROBOSIM_PACKAGE_DEPENDS
    "${extra_package} (= ${full_version}), robosim-data (= ${full_version})")
set(CPACK_DEBIAN_ROBOSIM_PACKAGE_SUGGESTS "librobosim-dev, mrpt-apps, python3-robosim, robosim-dds, robosim-mpi")

set(CPACK_COMPONENT_ROBOSIM-MPI_DESCRIPTION "simulator of cooperating mobile robots - runs on several machines
${about}

This package contains the library with which mpirun distributes one run over
several processes and machines.")
set(CPACK_DEBIAN_ROBOSIM-MPI_PACKAGE_NAME robosim-mpi)
set(CPACK_DEBIAN_ROBOSIM-MPI_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ROBOSIM-MPI_PACKAGE_DEPENDS "${engine_package} (= ${full_version})")
set(CPACK_DEBIAN_ROBOSIM-MPI_PACKAGE_RECOMMENDS "openmpi-bin, robosim")

set(CPACK_COMPONENT_ROBOSIM-DDS_DESCRIPTION "simulator of cooperating mobile robots - connection to ROS 2
${about}

This package contains the library with which robosim publishes to ROS 2 and
is driven by it over DDS. It needs no ROS.")
set(CPACK_DEBIAN_ROBOSIM-DDS_PACKAGE_NAME robosim-dds)
set(CPACK_DEBIAN_ROBOSIM-DDS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ROBOSIM-DDS_PACKAGE_DEPENDS "${engine_package} (= ${full_version}), ${extra_package} (= ${full_version})")
set(CPACK_DEBIAN_ROBOSIM-DDS_PACKAGE_RECOMMENDS "robosim")
# CPack runs ldconfig in maintainer scripts only; Debian's tools expect a trigger.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
foreach(component ROBOSIM ROBOSIM-MPI ROBOSIM-DDS LIBROBOSIM LIBROBOSIM-EXTRA)
  set(CPACK_DEBIAN_${component}_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_BINARY_DIR}/triggers)
endforeach()
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")

set(CPACK_COMPONENT_ROBOSIM-DEV_DESCRIPTION "simulator of cooperating mobile robots - development files
${about}

This package contains the headers of the libraries, their CMake package and
an example, for controllers, sensors and observers in projects of your own.")
set(CPACK_DEBIAN_ROBOSIM-DEV_PACKAGE_NAME librobosim-dev)
set(CPACK_DEBIAN_ROBOSIM-DEV_PACKAGE_SECTION libdevel)
# robosimConfig.cmake finds mrpt-obs. The headers of rendering include those of OpenCV.
set(CPACK_DEBIAN_ROBOSIM-DEV_PACKAGE_DEPENDS
    "${engine_package} (= ${full_version}), ${extra_package} (= ${full_version}), libmrpt-obs-dev")
set(CPACK_DEBIAN_ROBOSIM-DEV_PACKAGE_RECOMMENDS "robosim")
set(CPACK_DEBIAN_ROBOSIM-DEV_PACKAGE_SUGGESTS "cmake, g++")

set(CPACK_COMPONENT_PYTHON3-ROBOSIM_DESCRIPTION "simulator of cooperating mobile robots - Python module
${about}

This package contains the Python module robosim, which runs simulations in
the process of Python and provides readings as NumPy arrays.")
set(CPACK_DEBIAN_PYTHON3-ROBOSIM_PACKAGE_NAME python3-robosim)
set(CPACK_DEBIAN_PYTHON3-ROBOSIM_PACKAGE_SECTION python)
# The extension is built for one version of Python.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON3-ROBOSIM_PACKAGE_DEPENDS
    "${extra_package} (= ${full_version}), robosim-data (= ${full_version}), python3 (>= 3.${Python3_VERSION_MINOR}), \
python3 (<< 3.${next_minor}), python3-numpy")
# Of robosim.RemoteRobots and robosim.v1.
set(CPACK_DEBIAN_PYTHON3-ROBOSIM_PACKAGE_RECOMMENDS "python3-grpcio, python3-protobuf")

# SOURCE_DATE_EPOCH, which ./dev package sets to the date of the last commit, replaces the present time.
string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)

# Copyright, changelog and lintian's overrides of each package.
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${package})
  file(MAKE_DIRECTORY ${folder})
  configure_file(copyright.in ${folder}/copyright @ONLY)
  configure_file(changelog.in ${folder}/changelog.Debian @ONLY)
  execute_process(COMMAND gzip -9nf ${folder}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${folder}/copyright ${folder}/changelog.Debian.gz DESTINATION share/doc/${package} COMPONENT ${component})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${package}.lintian-overrides)
    install(FILES ${package}.lintian-overrides DESTINATION share/lintian/overrides RENAME ${package} COMPONENT ${component})
  endif()
endforeach()

include(CPack)
