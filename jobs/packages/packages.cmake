# Debian packages, one a component of install(): `jobs/package.sh`, or the target `packages`.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pbmpi)
set(CPACK_PACKAGE_CONTACT "${PBMPI_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${PBMPI_PACKAGE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)

set(packaged "")
set(built pbmpi pbstudy pbreport package_texts)
if(PBMPI_HAS_PBVALUE)
  list(APPEND built pbvalue)
endif()

# pbmpi_package(COMPONENT PACKAGE SECTION DESCRIPTION): what of install(COMPONENT) becomes the package. The first line of the
# description is its short form; the others have less than 80 letters.
macro(pbmpi_package component package section description)
  string(TOUPPER ${component} upper)
  list(APPEND packaged ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}")
  install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/copyright ${texts}/changelog.Debian.gz ${texts}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endmacro()

pbmpi_package(programs pbmpi science "simulation of many rigid-body worlds over MPI ranks
pbmpi simulates many rigid-body worlds, or one world cut into spaces, over
MPI ranks, and measures what accuracy costs in time. A run has the same bits
on any number of ranks, and writes one HDF5 file that survives a kill.
.
This package has the programs pbmpi, pbstudy and pbreport.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "openmpi-bin, python3, python3-numpy, python3-h5py")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "slurm-client, valgrind, paraview, python3-pbmpi")

if(TARGET pbmpi_shared)
  pbmpi_package(library libpbmpi${PROJECT_VERSION_MAJOR} libs "rigid-body worlds in batches (library)
pbmpi steps batches of rigid-body worlds, in threads and over MPI ranks, to
the same bits.
.
This package has the shared library.")
  file(CONFIGURE OUTPUT ${texts}/shlibs
    CONTENT "libpbmpi @PROJECT_VERSION_MAJOR@ libpbmpi@PROJECT_VERSION_MAJOR@ (>= @PROJECT_VERSION@)\n" @ONLY)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${texts}/shlibs)

  pbmpi_package(dev libpbmpi-dev libdevel "rigid-body worlds in batches (development files)
pbmpi steps batches of rigid-body worlds, in threads and over MPI ranks, to
the same bits.
.
This package has the headers, and what find_package(pbmpi) and pkg-config
need.")
  set(CPACK_COMPONENT_DEV_DEPENDS library)
  list(APPEND built pbmpi_shared)
endif()

if(TARGET pbmpi_python)
  pbmpi_package(python python3-pbmpi python "rigid-body worlds in batches (Python module)
pbmpi steps batches of rigid-body worlds, in threads and over MPI ranks, to
the same bits, and reads the files of its runs as arrays and tables.
.
This package has the module for Python 3.")
  # The extension is of one version of Python.
  get_directory_property(minor DIRECTORY ${PROJECT_SOURCE_DIR}/src/api/python DEFINITION Python_VERSION_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy, python3-h5py, python3-pandas")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${CMAKE_CURRENT_SOURCE_DIR}/python/postinst ${CMAKE_CURRENT_SOURCE_DIR}/python/prerm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-mpi4py")
  set(CPACK_COMPONENT_PYTHON_DEPENDS library)
  list(APPEND built pbmpi_python)
endif()

set(CPACK_COMPONENTS_ALL ${packaged})
include(CPack)

# Builds what is installed, tests not among it, and packs it.
add_custom_target(packages DEPENDS ${built}
  COMMAND ${CMAKE_CPACK_COMMAND} -B ${PROJECT_SOURCE_DIR}/build/packages
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_SOURCE_DIR}/build/packages/_CPack_Packages
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} USES_TERMINAL)
